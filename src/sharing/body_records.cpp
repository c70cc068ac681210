#include "sharing/body_records.h"

#include <string>
#include <type_traits>

namespace cairn {

namespace {

/// Calls visit(array) for the fields that a body takes along.
template <class Bodies, class Visit>
void forTakenFields(Bodies& bodies, const Visit& visit) {
    forEachBodyField([&](const auto& field) {
        auto& values = bodies.*field.array;
        using Type = typename std::remove_cvref_t<decltype(values)>::value_type;
        if constexpr (Sendable<Type>) {
            if (field.sync == Sync::always || field.sync == Sync::on_migration) visit(values);
        }
    });
}

/// Calls visit(member) for what a snapshot keeps of a contact, too.
template <class AnyContact, class Visit>
void forTakenMembers(AnyContact& contact, const Visit& visit) {
    visit(contact.a);
    visit(contact.b);
    visit(contact.point);
    visit(contact.normal);
    visit(contact.distance);
    visit(contact.reference_impulse);
    visit(contact.impulse);
    visit(contact.angular_impulse);
}

}  // namespace

void packBody(std::vector<std::byte>& message, const BodyStorage& bodies, BodyIndex i) {
    forTakenFields(bodies, [&](const auto& values) { pack(message, values[i]); });
}

void unpackBody(Unpacker& in, BodyStorage& bodies, BodyIndex i) {
    forTakenFields(bodies, [&](auto& values) {
        values[i] = in.get<typename std::remove_cvref_t<decltype(values)>::value_type>();
    });
}

void packContact(std::vector<std::byte>& message, const Contact& contact) {
    forTakenMembers(contact, [&](const auto& member) { pack(message, member); });
}

Contact unpackContact(Unpacker& in) {
    Contact contact;
    forTakenMembers(contact, [&](auto& member) { member = in.get<std::remove_cvref_t<decltype(member)>>(); });
    return contact;
}

}  // namespace cairn
