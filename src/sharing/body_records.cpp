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

/// Calls visit(member) for all that steps change of a joint.
template <class AnyJoint, class Visit>
void forChangingMembers(AnyJoint& joint, const Visit& visit) {
    visit(joint.present);
    visit(joint.generation);
    visit(joint.redundant);
    visit(joint.impulse);
    visit(joint.angular_impulse);
    visit(joint.last_impulse);
    visit(joint.last_angular_impulse);
    visit(joint.fixed_impulse);
    visit(joint.fixed_angular_impulse);
    for (auto& axis : joint.free) visit(axis.position);
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
    forLastingMembers(contact, [&](const auto& member) { pack(message, member); });
}

Contact unpackContact(Unpacker& in) {
    Contact contact;
    forLastingMembers(contact, [&](auto& member) { member = in.get<std::remove_cvref_t<decltype(member)>>(); });
    return contact;
}

void packJoint(std::vector<std::byte>& message, const Joint& joint) {
    forChangingMembers(joint, [&](const auto& member) { pack(message, member); });
}

void unpackJoint(Unpacker& in, Joint& joint) {
    forChangingMembers(joint, [&](auto& member) { member = in.get<std::remove_cvref_t<decltype(member)>>(); });
}

}  // namespace cairn
