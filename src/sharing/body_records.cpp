#include "sharing/body_records.h"

#include <string>
#include <type_traits>
#include <variant>

namespace cairn {

namespace {

/// Says that a shape is not sent.
constexpr std::uint8_t known_shape = UINT8_MAX;

/// Calls visit(array) for the fields that are numbers.
template <class Bodies, class Visit>
void forPlainFields(Bodies& bodies, const Visit& visit) {
    forEachBodyField([&](const auto& field) {
        auto& values = bodies.*field.array;
        if constexpr (Sendable<typename std::remove_cvref_t<decltype(values)>::value_type>) visit(values);
    });
}

// What a shape that is sent consists of.
template <class Visit>
void forNumbers(Sphere& sphere, const Visit& visit) {
    visit(sphere.radius);
}
template <class Visit>
void forNumbers(Box& box, const Visit& visit) {
    visit(box.size);
}
template <class Visit>
void forNumbers(Capsule& capsule, const Visit& visit) {
    visit(capsule.radius);
    visit(capsule.length);
}
template <class Visit>
void forNumbers(Cylinder& cylinder, const Visit& visit) {
    visit(cylinder.radius);
    visit(cylinder.length);
}

/// Calls visit(solid) with one of each kind that is sent.
template <class Visit>
void forSentKinds(const Visit& visit) {
    visit(Sphere{});
    visit(Box{});
    visit(Capsule{});
    visit(Cylinder{});
}

void packShape(std::vector<std::byte>& message, const Shape& shape) {
    pack(message, isSent(shape) ? static_cast<std::uint8_t>(shape.index()) : known_shape);
    forSentKinds([&](auto solid) {
        if (!std::holds_alternative<decltype(solid)>(shape)) return;
        solid = std::get<decltype(solid)>(shape);
        forNumbers(solid, [&](const auto& number) { pack(message, number); });
    });
}

void unpackShape(Unpacker& in, Shape& shape) {
    const auto kind = in.get<std::uint8_t>();
    forSentKinds([&](auto solid) {
        if (Shape(solid).index() != kind) return;
        forNumbers(solid, [&](auto& number) { number = in.get<std::remove_cvref_t<decltype(number)>>(); });
        shape = solid;
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
    visit(joint.coupled_impulse);
    visit(joint.booked_impulse);
    visit(joint.booked_angular_impulse);
    visit(joint.fixed_impulse);
    visit(joint.fixed_angular_impulse);
    for (auto& axis : joint.free) visit(axis.position);
}

}  // namespace

bool isSent(const Shape& shape) {
    bool sent = false;
    forSentKinds(
        [&](const auto& solid) { sent = sent || std::holds_alternative<std::remove_cvref_t<decltype(solid)>>(shape); });
    return sent;
}

void packBounds(std::vector<std::byte>& message, const Bounds& bounds) {
    pack(message, bounds.lower);
    pack(message, bounds.upper);
}

Bounds unpackBounds(Unpacker& in) {
    const Vec3 lower = in.get<Vec3>();
    return {lower, in.get<Vec3>()};
}

void packBody(std::vector<std::byte>& message, const BodyStorage& bodies, BodyIndex i) {
    forPlainFields(bodies, [&](const auto& values) { pack(message, values[i]); });
    packShape(message, bodies.shape[i]);
    pack(message, static_cast<std::uint64_t>(bodies.name[i].size()));
    for (const char letter : bodies.name[i]) pack(message, letter);
}

void unpackBody(Unpacker& in, BodyStorage& bodies, BodyIndex i) {
    forPlainFields(bodies, [&](auto& values) {
        values[i] = in.get<typename std::remove_cvref_t<decltype(values)>::value_type>();
    });
    unpackShape(in, bodies.shape[i]);
    bodies.name[i].resize(in.get<std::uint64_t>());
    for (char& letter : bodies.name[i]) letter = in.get<char>();
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

void forgetLoad(Joint& joint) {
    joint.impulse.setZero();
    joint.angular_impulse.setZero();
}

void unpackJoint(Unpacker& in, Joint& joint) {
    forChangingMembers(joint, [&](auto& member) { member = in.get<std::remove_cvref_t<decltype(member)>>(); });
}

}  // namespace cairn
