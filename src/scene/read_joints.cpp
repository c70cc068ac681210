#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "joints/joint_kinds.h"
#include "scene/joint_axis_names.h"
#include "scene/scene_reading.h"

namespace cairn {
namespace {

JointKind readKind(const JsonNode& node) {
    const JsonNode type = node.required("type", "the kind of the joint");
    const std::string name = type.text();
    const auto kinds = jointKinds();
    const auto found = std::ranges::find(kinds, name, &JointKindEntry::name);
    if (found != kinds.end()) return static_cast<JointKind>(found - kinds.begin());
    std::vector<std::string_view> names;
    for (const JointKindEntry& kind : kinds) names.push_back(kind.name);
    type.refuse(fmt::format("{}", fmt::join(names, ", ")));
}

constexpr std::array<std::string_view, 9> axis_keys = {"lower",  "upper",   "restitution", "motor",        "servo",
                                                       "spring", "damping", "friction",    "rotor_inertia"};

/// The members that a kind has.
void expectMembers(const JsonNode& node, const JointUses& uses) {
    if (uses.couples) {
        return node.expectKeys(
            {"type", "first", "second", "first_axis", "second_axis", "ratio", "break_force", "break_torque"});
    }
    std::vector<std::string_view> keys = {"type", "a", "b", "anchor", "break_force", "collide"};
    const auto allow = [&](bool has, std::initializer_list<std::string_view> more) {
        if (has) keys.insert(keys.end(), more);
    };
    allow(uses.length, {"anchor_b", "length"});
    allow(uses.axis || uses.axes, {"axis"});
    allow(uses.second_axis, {"axis_2"});
    allow(uses.lead, {"lead"});
    allow(uses.cone, {"cone"});
    allow(uses.axes, {"axes"});
    allow(uses.torque, {"break_torque"});
    if (uses.own_axis) keys.insert(keys.end(), axis_keys.begin(), axis_keys.end());
    node.expectKeys(std::span<const std::string_view>(keys));
}

void readBodiesOf(const JsonNode& node, const SceneReading& reading, SceneJoint& joint) {
    joint.a = readBodyReference(node.required("a", "the index or the name of a body"), reading);
    if (const auto b = node.find("b")) {
        joint.b = readBodyReference(*b, reading);
        if (*joint.b == joint.a) b->fail("is the same body as a; a joint joins two bodies, or one and the world");
    }
    const std::vector<SceneBody>& bodies = reading.scene.bodies;
    if (bodies[joint.a].fixed && (!joint.b || bodies[*joint.b].fixed)) {
        node.fail("joins nothing that can move; at least one of its bodies must not be fixed");
    }
}

void readLength(const JsonNode& node, const JointUses& uses, JointDescription& joint) {
    if (uses.length) joint.anchor_b = node.required("anchor_b", "the point of b or of the world [m]").vector();
    if (const auto value = node.find("length")) joint.length = value->positive();
    if (uses.lead) joint.lead = node.required("lead", "the displacement per turn [m]").number();
    if (const auto value = node.find("cone")) joint.cone = value->nonNegative();
}

/// What acts along an axis; the description of a joint and that of an axis call it by the same names.
template <class Axis>
void readAxisInto(const JsonNode& node, Axis& axis) {
    if (const auto value = node.find("lower")) axis.lower = value->number();
    if (const auto value = node.find("upper")) axis.upper = value->number();
    if (axis.lower && axis.upper && *axis.lower > *axis.upper) {
        node.fail(fmt::format("has lower {} above upper {}; swap them", *axis.lower, *axis.upper));
    }
    if (const auto value = node.find("restitution")) axis.restitution = value->nonNegative();
    if (const auto motor = node.find("motor")) {
        motor->expectKeys({"speed", "limit"});
        axis.motor = JointMotor{motor->required("speed", "a number [rad/s or m/s]").number(),
                                motor->required("limit", "a number, 0 or above [N·m or N]").nonNegative()};
    }
    if (const auto servo = node.find("servo")) {
        servo->expectKeys({"position", "speed", "stiffness", "damping", "limit"});
        JointServo& read = axis.servo.emplace();
        if (const auto value = servo->find("position")) read.position = value->number();
        if (const auto value = servo->find("speed")) read.speed = value->number();
        if (const auto value = servo->find("stiffness")) read.stiffness = value->nonNegative();
        if (const auto value = servo->find("damping")) read.damping = value->nonNegative();
        if (const auto value = servo->find("limit")) read.limit = value->nonNegative();
    }
    if (const auto spring = node.find("spring")) {
        spring->expectKeys({"stiffness", "rest"});
        JointSpring& read = axis.spring.emplace();
        read.stiffness = spring->required("stiffness", "a number, 0 or above [N·m/rad or N/m]").nonNegative();
        if (const auto value = spring->find("rest")) read.rest = value->number();
    }
    if (const auto value = node.find("damping")) axis.damping = value->nonNegative();
    if (const auto value = node.find("friction")) axis.friction = value->nonNegative();
    if (const auto value = node.find("rotor_inertia")) axis.rotor_inertia = value->nonNegative();
}

Vec3 readDirection(const JsonNode& node) {
    const Vec3 direction = node.vector();
    if (!(direction.squaredNorm() > 1e-12 && direction.squaredNorm() < 1e12)) {
        node.refuse("a direction of length 1e-6 to 1e6");
    }
    return direction;
}

JointAxis readFreeAxis(const JsonNode& node, const JointUses& uses) {
    std::vector<std::string_view> keys(axis_keys.begin(), axis_keys.end());
    if (uses.free_axes) keys.push_back("along");
    node.expectKeys(std::span<const std::string_view>(keys));
    JointAxis axis;
    if (uses.free_axes) {
        axis.along = readJointAlong(node.required("along", "which axis is free"));
    }
    readAxisInto(node, axis);
    return axis;
}

void readAxes(const JsonNode& node, const JointUses& uses, JointDescription& joint) {
    if (uses.axis) {
        joint.axis = readDirection(node.required("axis", "a direction"));
    } else if (const auto axis = node.find("axis")) {
        joint.axis = readDirection(*axis);
    }
    if (const auto axis = node.find("axis_2")) joint.axis_2 = readDirection(*axis);
    if (uses.own_axis) readAxisInto(node, joint);
    if (const auto axes = node.find("axes")) {
        axes->expectArray("an array with what acts along each free axis");
        for (std::size_t i = 0; i < axes->size(); ++i) joint.axes.push_back(readFreeAxis(axes->element(i), uses));
    }
}

std::size_t readIndex(const JsonNode& node, std::size_t count, std::string_view allowed) {
    const double value = node.nonNegative();
    if (!(value < static_cast<double>(count)) || value != std::floor(value)) node.refuse(allowed);
    return static_cast<std::size_t>(value);
}

/// A gear, a rack or a mimic names two joints before it.
void readCoupling(const JsonNode& node, const SceneReading& reading, SceneJoint& joint) {
    const auto readJointBefore = [&](std::string_view key) {
        constexpr std::string_view allowed = "the index of a joint that stands before this one";
        return readIndex(node.required(key, allowed), reading.scene.joints.size(), allowed);
    };
    joint.first = readJointBefore("first");
    joint.second = readJointBefore("second");
    constexpr std::string_view axis = "the index of a free axis, 0 to 5";
    if (const auto value = node.find("first_axis")) joint.joint.first_axis = readIndex(*value, 6, axis);
    if (const auto value = node.find("second_axis")) joint.joint.second_axis = readIndex(*value, 6, axis);
    joint.joint.ratio = node.required("ratio", "a number").number();
}

void readBreaking(const JsonNode& node, JointDescription& joint) {
    if (const auto value = node.find("break_force")) joint.break_force = value->positive();
    if (const auto value = node.find("break_torque")) joint.break_torque = value->positive();
}

SceneJoint readJoint(const JsonNode& node, const SceneReading& reading) {
    if (!node.value().is_object()) node.refuse("an object with the keys type, a and what the type needs");
    SceneJoint joint;
    joint.joint.kind = readKind(node);
    const JointUses& uses = entryOf(joint.joint.kind).uses;
    expectMembers(node, uses);
    if (uses.couples) {
        readCoupling(node, reading, joint);
        readBreaking(node, joint.joint);
        return joint;
    }
    readBodiesOf(node, reading, joint);
    if (const auto value = node.find("anchor")) joint.joint.anchor = value->vector();
    readLength(node, uses, joint.joint);
    readAxes(node, uses, joint.joint);
    readBreaking(node, joint.joint);
    if (const auto value = node.find("collide")) joint.joint.collide = value->flag();
    return joint;
}

}  // namespace

JointAlong readJointAlong(const JsonNode& node) {
    const std::string name = node.text();
    constexpr auto names = jointAxisNames();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) node.refuse(fmt::format("{}", fmt::join(names, ", ")));
    return static_cast<JointAlong>(found - names.begin());
}

void readJoints(const JsonNode& node, SceneReading& reading) {
    node.expectArray("an array of joints");
    for (std::size_t i = 0; i < node.size(); ++i) {
        reading.scene.joints.push_back(readJoint(node.element(i), reading));
    }
}

}  // namespace cairn
