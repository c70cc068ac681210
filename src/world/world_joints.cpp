/// The part of World that manages joints.
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "cairn/world.h"
#include "math/tolerances.h"
#include "world/motions.h"
#include "world/quarantine.h"
#include "world/world_state.h"

namespace cairn {

namespace {

/// Shortest length of a distance or a rope [m].
constexpr double shortest_length = 1e-9;

constexpr std::string_view kindName(JointKind kind) {
    switch (kind) {
        case JointKind::distance:
            return "distance";
        case JointKind::rope:
            return "rope";
        case JointKind::ball:
            return "ball joint";
        case JointKind::hinge:
            return "hinge";
        case JointKind::slider:
            return "slider";
        case JointKind::fixed:
            return "fixed joint";
    }
    return "joint";
}

bool hasLength(JointKind kind) {
    return kind == JointKind::distance || kind == JointKind::rope;
}

bool hasAxis(JointKind kind) {
    return kind == JointKind::hinge || kind == JointKind::slider;
}

/// @throws InputError unless every component is finite and within the world
void requirePoint(const Vec3& point, std::string_view what, JointKind kind) {
    if (point.allFinite() && point.cwiseAbs().maxCoeff() <= distance_limit) return;
    throw InputError(fmt::format("{} of a {} is ({}, {}, {}) m; it must be finite and within ±{} m", what,
                                 kindName(kind), point.x(), point.y(), point.z(), distance_limit));
}

void requirePositive(double value, std::string_view what, JointKind kind, std::string_view unit) {
    if (value > 0) return;
    throw InputError(fmt::format("{} of a {} is {} {}; it must be above 0", what, kindName(kind), value, unit));
}

void requireLimits(JointKind kind, const std::optional<double>& lower, const std::optional<double>& upper) {
    if (!lower && !upper) return;
    if (!hasAxis(kind)) throw InputError(fmt::format("a {} has no limits; hinges and sliders have", kindName(kind)));
    const double limit = kind == JointKind::hinge ? std::numbers::pi : distance_limit;
    const std::string_view unit = kind == JointKind::hinge ? "rad" : "m";
    for (const auto& value : {lower, upper}) {
        if (!value || std::abs(*value) <= limit) continue;
        throw InputError(fmt::format("a limit of a {} is {} {}; it must be within ±{} {}", kindName(kind), *value, unit,
                                     limit, unit));
    }
    if (lower && upper && *lower > *upper) {
        throw InputError(fmt::format("the limits of a {} are reversed: lower {} {} is above upper {} {}; swap them",
                                     kindName(kind), *lower, unit, *upper, unit));
    }
    if (kind == JointKind::hinge && lower.has_value() != upper.has_value()) {
        throw InputError("a hinge has one limit only; its angle ends at ±π, so give both");
    }
}

void requireMotor(JointKind kind, const JointMotor& motor) {
    if (!hasAxis(kind)) throw InputError(fmt::format("a {} has no motor; hinges and sliders have", kindName(kind)));
    if (!(std::abs(motor.speed) <= speed_limit)) {
        throw InputError(
            fmt::format("the speed of a motor is {}; it must be finite and within ±{}", motor.speed, speed_limit));
    }
    if (!(motor.limit >= 0 && std::isfinite(motor.limit))) {
        throw InputError(
            fmt::format("the limit of a motor is {}; it must be finite and at least 0 [N or N·m]", motor.limit));
    }
}

void requireAxis(const Vec3& axis, JointKind kind) {
    const double length = axis.stableNorm();
    if (std::isfinite(length) && length > 1e-6) return;
    throw InputError(fmt::format("the axis of a {} is ({}, {}, {}); it must be finite and longer than 1e-6",
                                 kindName(kind), axis.x(), axis.y(), axis.z()));
}

void validateDescription(const JointDescription& d) {
    if (d.kind > JointKind::fixed) throw InputError("the kind of a joint is none of JointKind");
    requirePoint(d.anchor, "anchor", d.kind);
    if (hasLength(d.kind) && !d.anchor_b) {
        throw InputError(fmt::format("a {} needs two points; give anchor_b", kindName(d.kind)));
    }
    if (!hasLength(d.kind) && (d.anchor_b || d.length)) {
        throw InputError(
            fmt::format("a {} has one anchor and no length; leave anchor_b and length out, or make it a "
                        "distance or a rope",
                        kindName(d.kind)));
    }
    if (d.anchor_b) requirePoint(*d.anchor_b, "anchor_b", d.kind);
    if (d.length && !(*d.length >= shortest_length && *d.length <= distance_limit)) {
        throw InputError(fmt::format("length of a {} is {} m; it must be {} to {} m", kindName(d.kind), *d.length,
                                     shortest_length, distance_limit));
    }
    if (hasLength(d.kind) && !d.length && !((d.anchor - *d.anchor_b).norm() >= shortest_length)) {
        throw InputError(fmt::format("the points of a {} are on each other; give it a length or join them by a ball",
                                     kindName(d.kind)));
    }
    if (hasAxis(d.kind)) requireAxis(d.axis, d.kind);
    requireLimits(d.kind, d.lower, d.upper);
    if (d.motor) requireMotor(d.kind, *d.motor);
    requirePositive(d.break_force, "break_force", d.kind, "N");
    requirePositive(d.break_torque, "break_torque", d.kind, "N·m");
    const bool has_torque = hasAxis(d.kind) || d.kind == JointKind::fixed;
    if (!has_torque && std::isfinite(d.break_torque)) {
        throw InputError(fmt::format("a {} passes no torque; leave break_torque out", kindName(d.kind)));
    }
}

/// @throws StaleIdError
Joint& jointOf(std::vector<Joint>& joints, JointId id) {
    if (id.index < joints.size() && joints[id.index].present && joints[id.index].generation == id.generation) {
        return joints[id.index];
    }
    throw StaleIdError(
        fmt::format("joint id {}:{} is not in the world: it was removed, it broke, or one of its bodies "
                    "was removed",
                    id.index, id.generation));
}

void wakeEnds(BodyStorage& bodies, const Joint& joint) {
    const BodyState state = bodies.state();
    for (const BodyIndex body : {joint.a, joint.b}) {
        if (isMovable(bodies.kind, body)) state.wake(body, WakeReason::changed);
    }
}

/// Anchors, axes and rest as the bodies stand now.
void setFrames(const JointDescription& d, const BodyStorage& bodies, Joint& joint) {
    const Pose a = poseOf(bodies, joint.a);
    const Pose b = poseOf(bodies, joint.b);
    joint.anchor_a = a.toInner(d.anchor);
    joint.anchor_b = b.toInner(d.anchor_b.value_or(d.anchor));
    const Vec3 axis = hasAxis(d.kind) ? d.axis.stableNormalized() : Vec3(Vec3::UnitZ());
    joint.axis_a = (a.orientation.conjugate() * axis).normalized();
    joint.axis_b = (b.orientation.conjugate() * axis).normalized();
    joint.rest = (b.orientation.conjugate() * a.orientation).normalized();
    if (hasLength(d.kind)) joint.length = d.length.value_or((d.anchor - *d.anchor_b).norm());
}

}  // namespace

JointId World::addJoint(const JointDescription& d) {
    WorldState& w = *state_;
    const BodyIndex a = w.bodies.indexOf(d.a);
    const BodyIndex b = d.b ? w.bodies.indexOf(*d.b) : Joint::world;
    if (a == b) throw InputError("a joint needs two different bodies, or one body and the world");
    validateDescription(d);
    if (!isMovable(w.bodies.kind, a) && !isMovable(w.bodies.kind, b)) {
        throw InputError(fmt::format("a {} between bodies that cannot move has no effect; one of them must be dynamic",
                                     kindName(d.kind)));
    }
    requireNoLaw(w, a);
    if (d.b) requireNoLaw(w, b);
    std::uint32_t slot = 0;
    while (slot < w.joints.size() && w.joints[slot].present) ++slot;
    if (slot == w.joints.size()) w.joints.emplace_back();
    Joint joint;
    joint.present = true;
    joint.generation = w.joints[slot].generation;
    joint.kind = d.kind;
    joint.a = a;
    joint.b = b;
    setFrames(d, w.bodies, joint);
    joint.lower = d.lower.value_or(-Joint::infinite);
    joint.upper = d.upper.value_or(Joint::infinite);
    if (d.motor) joint.motor_speed = d.motor->speed;
    if (d.motor) joint.motor_limit = d.motor->limit;
    joint.break_force = d.break_force;
    joint.break_torque = d.break_torque;
    joint.collide = d.collide;
    w.joints[slot] = joint;
    w.ties.forget();
    wakeEnds(w.bodies, joint);
    return {slot, joint.generation};
}

void World::removeJoint(JointId id) {
    Joint& joint = jointOf(state_->joints, id);
    wakeEnds(state_->bodies, joint);
    joint.present = false;
    ++joint.generation;
}

bool World::contains(JointId id) const noexcept {
    const std::vector<Joint>& joints = state_->joints;
    return id.index < joints.size() && joints[id.index].present && joints[id.index].generation == id.generation;
}

std::vector<JointId> World::joints() const {
    std::vector<JointId> ids;
    for (std::uint32_t i = 0; i < state_->joints.size(); ++i) {
        if (state_->joints[i].present) ids.push_back({i, state_->joints[i].generation});
    }
    return ids;
}

JointInfo World::joint(JointId id) const {
    const Joint& joint = jointOf(state_->joints, id);
    const BodyStorage& bodies = state_->bodies;
    const Pose a = poseOf(bodies, joint.a);
    const Pose b = poseOf(bodies, joint.b);
    JointBlock block;
    evaluate(joint, a, b, state_->settings.timeStep(), block);
    double error = 0;
    for (std::uint32_t i = 0; i < block.size; ++i) error = std::max(error, std::abs(block.error[i]));
    for (std::uint32_t i = 0; i < block.bounds; ++i) {
        if (!block.bound[i].is_motor) error = std::max({error, -block.bound[i].to_upper, block.bound[i].to_lower});
    }
    const JointMotion motion = motionOf(joint, a, b);
    const bool two = joint.b != Joint::world;
    const Vec3 v_b = two ? bodies.v[joint.b] : Vec3(Vec3::Zero());
    const Vec3 w_b = two ? bodies.w[joint.b] : Vec3(Vec3::Zero());
    const double rate = state_->settings.steps_per_second;
    return {.kind = joint.kind,
            .a = bodies.idOf(joint.a),
            .b = two ? std::optional(bodies.idOf(joint.b)) : std::nullopt,
            .anchor_a = a.toOuter(joint.anchor_a),
            .anchor_b = b.toOuter(joint.anchor_b),
            .axis = b.orientation * joint.axis_b,
            .position = motion.position,
            .speed = motion.row.linear.dot(bodies.v[joint.a] - v_b) + motion.row.angular_a.dot(bodies.w[joint.a]) +
                     motion.row.angular_b.dot(w_b),
            .error = error,
            .impulse = joint.impulse,
            .angular_impulse = joint.angular_impulse,
            .force = rate * joint.impulse,
            .torque = rate * joint.angular_impulse};
}

void World::setJointMotor(JointId id, const JointMotor& motor) {
    Joint& joint = jointOf(state_->joints, id);
    requireMotor(joint.kind, motor);
    joint.motor_speed = motor.speed;
    joint.motor_limit = motor.limit;
    wakeEnds(state_->bodies, joint);
}

void World::setJointLimits(JointId id, std::optional<double> lower, std::optional<double> upper) {
    Joint& joint = jointOf(state_->joints, id);
    requireLimits(joint.kind, lower, upper);
    joint.lower = lower.value_or(-Joint::infinite);
    joint.upper = upper.value_or(Joint::infinite);
    wakeEnds(state_->bodies, joint);
}

}  // namespace cairn
