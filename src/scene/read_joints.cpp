#include <fmt/format.h>

#include <algorithm>

#include "scene/scene_reading.h"

namespace cairn {
namespace {

JointKind readKind(const JsonNode& node) {
    const JsonNode type = node.required("type", "the kind of the joint");
    const std::string name = type.text();
    constexpr auto names = jointNames();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) type.refuse(fmt::format("{}", fmt::join(names, ", ")));
    return static_cast<JointKind>(found - names.begin());
}

/// The members that a kind has.
void expectMembers(const JsonNode& node, JointKind kind) {
    if (kind == JointKind::distance || kind == JointKind::rope) {
        node.expectKeys({"type", "a", "b", "anchor", "anchor_b", "length", "break_force", "collide"});
    } else if (kind == JointKind::ball) {
        node.expectKeys({"type", "a", "b", "anchor", "break_force", "collide"});
    } else if (kind == JointKind::fixed) {
        node.expectKeys({"type", "a", "b", "anchor", "break_force", "break_torque", "collide"});
    } else {
        node.expectKeys(
            {"type", "a", "b", "anchor", "axis", "lower", "upper", "motor", "break_force", "break_torque", "collide"});
    }
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

void readLength(const JsonNode& node, JointDescription& joint) {
    const bool has_length = joint.kind == JointKind::distance || joint.kind == JointKind::rope;
    if (has_length) joint.anchor_b = node.required("anchor_b", "the point of b or of the world [m]").vector();
    if (const auto value = node.find("length")) joint.length = value->positive();
}

void readLimits(const JsonNode& node, JointDescription& joint) {
    if (const auto value = node.find("lower")) joint.lower = value->number();
    if (const auto value = node.find("upper")) joint.upper = value->number();
    if (joint.lower && joint.upper && *joint.lower > *joint.upper) {
        node.fail(fmt::format("has lower {} above upper {}; swap them", *joint.lower, *joint.upper));
    }
}

void readAxis(const JsonNode& node, JointDescription& joint) {
    const bool has_axis = joint.kind == JointKind::hinge || joint.kind == JointKind::slider;
    if (!has_axis) return;
    const JsonNode axis = node.required("axis", "a direction");
    joint.axis = axis.vector();
    if (!(joint.axis.squaredNorm() > 1e-12 && joint.axis.squaredNorm() < 1e12)) {
        axis.refuse("a direction of length 1e-6 to 1e6");
    }
    readLimits(node, joint);
    if (const auto motor = node.find("motor")) {
        motor->expectKeys({"speed", "limit"});
        joint.motor = JointMotor{motor->required("speed", "a number [rad/s or m/s]").number(),
                                 motor->required("limit", "a number, 0 or above [N·m or N]").nonNegative()};
    }
}

SceneJoint readJoint(const JsonNode& node, const SceneReading& reading) {
    if (!node.value().is_object()) node.refuse("an object with the keys type, a and what the type needs");
    SceneJoint joint;
    joint.joint.kind = readKind(node);
    expectMembers(node, joint.joint.kind);
    readBodiesOf(node, reading, joint);
    if (const auto value = node.find("anchor")) joint.joint.anchor = value->vector();
    readLength(node, joint.joint);
    readAxis(node, joint.joint);
    if (const auto value = node.find("break_force")) joint.joint.break_force = value->positive();
    if (const auto value = node.find("break_torque")) joint.joint.break_torque = value->positive();
    if (const auto value = node.find("collide")) joint.joint.collide = value->flag();
    return joint;
}

}  // namespace

void readJoints(const JsonNode& node, SceneReading& reading) {
    node.expectArray("an array of joints");
    for (std::size_t i = 0; i < node.size(); ++i) {
        reading.scene.joints.push_back(readJoint(node.element(i), reading));
    }
}

}  // namespace cairn
