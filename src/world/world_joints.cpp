/// The part of World that manages joints.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "cairn/world.h"
#include "joints/joint_kinds.h"
#include "world/couplings.h"
#include "world/joint_axes.h"
#include "world/limits.h"
#include "world/motions.h"
#include "world/stillness.h"
#include "world/world_state.h"

namespace cairn {

namespace {

/// Shortest length of a distance or a rope [m].
constexpr double shortest_length = 1e-9;

/// @throws InputError unless every component is finite and within the world
void requirePoint(const Vec3& point, std::string_view what, std::string_view title) {
    if (point.allFinite() && point.cwiseAbs().maxCoeff() <= distance_limit) return;
    throw InputError(fmt::format("{} of a {} is ({}, {}, {}) m; it must be finite and within ±{} m", what, title,
                                 point.x(), point.y(), point.z(), distance_limit));
}

void requirePositive(double value, std::string_view what, std::string_view title, std::string_view unit) {
    if (value > 0) return;
    throw InputError(fmt::format("{} of a {} is {} {}; it must be above 0", what, title, value, unit));
}

void requireAxis(const Vec3& axis, std::string_view what, std::string_view title) {
    const double length = axis.stableNorm();
    if (std::isfinite(length) && length > 1e-6) return;
    throw InputError(fmt::format("{} of a {} is ({}, {}, {}); it must be finite and longer than 1e-6", what, title,
                                 axis.x(), axis.y(), axis.z()));
}

void requireAxes(const JointDescription& d, const JointKindEntry& kind) {
    if (kind.uses.axis || kind.uses.axes) requireAxis(d.axis, "axis", kind.title);
    if (!d.axis_2) return;
    if (!kind.uses.second_axis) {
        throw InputError(fmt::format("a {} has one axis only; leave axis_2 out", kind.title));
    }
    requireAxis(*d.axis_2, "axis_2", kind.title);
    if (d.axis.stableNormalized().cross(d.axis_2->stableNormalized()).norm() > 1e-6) return;
    throw InputError(fmt::format("axis_2 of a {} is along its axis; give another direction", kind.title));
}

void requireLengths(const JointDescription& d, const JointKindEntry& kind) {
    if (kind.uses.length && !d.anchor_b) {
        throw InputError(fmt::format("a {} needs two points; give anchor_b", kind.title));
    }
    if (!kind.uses.length && (d.anchor_b || d.length)) {
        throw InputError(
            fmt::format("a {} has one anchor and no length; leave anchor_b and length out, or make it a "
                        "distance or a rope",
                        kind.title));
    }
    if (d.anchor_b) requirePoint(*d.anchor_b, "anchor_b", kind.title);
    if (d.length && !(*d.length >= shortest_length && *d.length <= distance_limit)) {
        throw InputError(fmt::format("length of a {} is {} m; it must be {} to {} m", kind.title, *d.length,
                                     shortest_length, distance_limit));
    }
    if (kind.uses.length && !d.length && !((d.anchor - *d.anchor_b).norm() >= shortest_length)) {
        throw InputError(
            fmt::format("the points of a {} are on each other; give it a length or join them by a ball", kind.title));
    }
    if (kind.uses.lead != d.lead.has_value()) {
        throw InputError(kind.uses.lead ? "a screw needs its lead, the displacement per turn [m]"
                                        : fmt::format("a {} has no lead; screws have", kind.title));
    }
    if (d.lead && !(std::abs(*d.lead) <= distance_limit)) {
        throw InputError(fmt::format("lead of a screw is {} m; it must be finite", *d.lead));
    }
}

void requireCone(const JointDescription& d, const JointKindEntry& kind) {
    if (!d.cone) return;
    if (!kind.uses.cone) throw InputError(fmt::format("a {} has no cone; ball joints have", kind.title));
    if (*d.cone >= 0 && *d.cone <= std::numbers::pi) return;
    throw InputError(fmt::format("cone of a ball joint is {} rad; it must be 0 to π", *d.cone));
}

void validateDescription(const JointDescription& d, const JointKindEntry& kind) {
    requirePoint(d.anchor, "anchor", kind.title);
    requireLengths(d, kind);
    requireAxes(d, kind);
    requireCone(d, kind);
    requirePositive(d.break_force, "break_force", kind.title, "N");
    requirePositive(d.break_torque, "break_torque", kind.title, "N·m");
    if (!kind.uses.torque && std::isfinite(d.break_torque)) {
        throw InputError(fmt::format("a {} passes no torque; leave break_torque out", kind.title));
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

/// x along the axis, y along what the second axis has across it.
Mat3 frameOf(const JointDescription& d) {
    Mat3 frame;
    frame.col(0) = d.axis.stableNormalized();
    const Vec3 second = d.axis_2 ? d.axis_2->stableNormalized() : anyAcross(frame.col(0));
    frame.col(2) = frame.col(0).cross(second).normalized();
    frame.col(1) = frame.col(2).cross(frame.col(0));
    return frame;
}

/// Anchors, axes and rest as the bodies stand now.
void setFrames(const JointDescription& d, const BodyStorage& bodies, Joint& joint) {
    const JointUses& uses = entryOf(d.kind).uses;
    const Pose a = poseOf(bodies, joint.a);
    const Pose b = poseOf(bodies, joint.b);
    joint.anchor_a = a.toInner(d.anchor);
    joint.anchor_b = b.toInner(d.anchor_b.value_or(d.anchor));
    const bool has_axis = uses.axis || uses.axes;
    const Vec3 axis = has_axis ? d.axis.stableNormalized() : Vec3(Vec3::UnitZ());
    joint.axis_a = (a.orientation.conjugate() * axis).normalized();
    joint.axis_b = (b.orientation.conjugate() * axis).normalized();
    joint.rest = (b.orientation.conjugate() * a.orientation).normalized();
    if (has_axis) joint.frame = (b.orientation.conjugate() * Quat(frameOf(d))).normalized();
    if (uses.length) joint.length = d.length.value_or((d.anchor - *d.anchor_b).norm());
    if (d.lead) joint.lead = *d.lead / (2 * std::numbers::pi);
    joint.cone = d.cone.value_or(Joint::infinite);
}

/// @throws InputError for a body that a law leads
void requireUnled(const WorldState& w, BodyIndex body) {
    if (lawOf(w, body) == nullptr) return;
    throw InputError(fmt::format(
        "body {} moves by a law and takes no joints; lead a body on a slider or hinge by a servo in its place", body));
}

/// A joint between bodies. @throws InputError, StaleIdError
Joint jointBetween(const JointDescription& d, WorldState& w) {
    const JointKindEntry& kind = entryOf(d.kind);
    Joint joint;
    joint.a = w.bodies.indexOf(d.a);
    joint.b = d.b ? w.bodies.indexOf(*d.b) : Joint::world;
    if (joint.a == joint.b) throw InputError("a joint needs two different bodies, or one body and the world");
    validateDescription(d, kind);
    joint.free = freeAxesOf(d, kind);
    if (!isMovable(w.bodies.kind, joint.a) && !isMovable(w.bodies.kind, joint.b)) {
        throw InputError(
            fmt::format("a {} between bodies that cannot move has no effect; one of them must be dynamic", kind.title));
    }
    requireUnled(w, joint.a);
    if (d.b) requireUnled(w, joint.b);
    setFrames(d, w.bodies, joint);
    joint.break_force = d.break_force;
    joint.break_torque = d.break_torque;
    joint.collide = d.collide;
    return joint;
}

}  // namespace

JointId World::addJoint(const JointDescription& d) {
    beginChange(*state_, "World::addJoint");
    WorldState& w = *state_;
    if (static_cast<std::size_t>(d.kind) >= jointKinds().size()) {
        throw InputError("the kind of a joint is none of JointKind");
    }
    Joint joint = entryOf(d.kind).uses.couples ? couplingOf(d, w) : jointBetween(d, w);
    std::uint32_t slot = 0;
    while (slot < w.joints.size() && w.joints[slot].present) ++slot;
    if (slot == w.joints.size()) w.joints.emplace_back();
    joint.present = true;
    joint.kind = d.kind;
    joint.generation = w.joints[slot].generation;
    w.joints[slot] = std::move(joint);
    w.ties.forget();
    wakeEnds(w.bodies, w.joints[slot]);
    return {slot, w.joints[slot].generation};
}

void World::removeJoint(JointId id) {
    beginChange(*state_, "World::removeJoint");
    Joint& joint = jointOf(state_->joints, id);
    wakeEnds(state_->bodies, joint);
    joint.present = false;
    ++joint.generation;
    removeLooseCouplings(*state_);
}

bool World::contains(JointId id) const noexcept {
    const std::vector<Joint>& joints = state_->joints;
    return id.index < joints.size() && joints[id.index].present && joints[id.index].generation == id.generation;
}

std::vector<JointId> World::joints() const {
    std::vector<JointId> ids;
    for (std::uint32_t i = 0; i < state_->joints.size(); ++i) {
        const Joint& joint = state_->joints[i];
        if (joint.present && joint.kind != body_locks) ids.push_back({i, state_->joints[i].generation});
    }
    return ids;
}

JointInfo World::joint(JointId id) const {
    const Joint& joint = jointOf(state_->joints, id);
    const BodyStorage& bodies = state_->bodies;
    JointBlock block;
    evaluate(state_->joints, id.index, bodies, state_->settings.timeStep(), block);
    double error = 0;
    for (std::uint32_t i = 0; i < block.size; ++i) error = std::max(error, std::abs(block.error[i]));
    for (const BoundRow& bound : block.bound) {
        if (!bound.is_motor) error = std::max({error, -bound.to_upper, bound.to_lower});
    }
    const double rate = state_->settings.steps_per_second;
    JointInfo info{.kind = joint.kind,
                   .a = {},
                   .b = {},
                   .anchor_a = Vec3::Zero(),
                   .anchor_b = Vec3::Zero(),
                   .axis = Vec3::Zero(),
                   .position = 0,
                   .speed = 0,
                   .error = error,
                   .impulse = joint.impulse,
                   .angular_impulse = joint.angular_impulse,
                   .force = rate * joint.impulse,
                   .torque = rate * joint.angular_impulse,
                   .positions = {},
                   .speeds = {},
                   .redundant = joint.redundant};
    const bool couples = entryOf(joint.kind).uses.couples;
    // A coupling is seen between the joints that it couples, and is where the second of them is.
    const Joint& from = couples ? state_->joints[joint.first] : joint;
    const Joint& to = couples ? state_->joints[joint.second] : joint;
    const BodyIndex other = couples ? to.a : to.b;
    info.a = bodies.idOf(from.a);
    if (other != Joint::world) info.b = bodies.idOf(other);
    const Pose to_a = poseOf(bodies, to.a);
    const Pose to_b = poseOf(bodies, to.b);
    info.anchor_a = poseOf(bodies, from.a).toOuter(from.anchor_a);
    info.anchor_b = couples ? to_a.toOuter(to.anchor_a) : to_b.toOuter(to.anchor_b);
    info.axis = to_b.orientation * to.axis_b;
    const auto look = [&](std::size_t axis, double& position, double& speed) {
        const JointMotion motion = motionOf(to, axis, to_a, to_b);
        position = motion.position;
        speed = rateOf(motion.row, to.a, to.b, bodies);
    };
    look(couples ? joint.second_axis : 0, info.position, info.speed);
    info.positions.resize(joint.free.size());
    info.speeds.resize(joint.free.size());
    for (std::size_t i = 0; i < joint.free.size(); ++i) look(i, info.positions[i], info.speeds[i]);
    return info;
}

namespace {

/// The only axis of a hinge, a slider or a screw. @throws InputError for other kinds
FreeAxis& ownAxisOf(Joint& joint, std::string_view what) {
    const JointKindEntry& kind = entryOf(joint.kind);
    if (kind.uses.own_axis) return joint.free.front();
    throw InputError(fmt::format("a {} has no {} of its own; hinges, sliders and screws have{}", kind.title, what,
                                 kind.uses.axes ? ": use setJointAxis()" : ""));
}

}  // namespace

void World::setJointMotor(JointId id, const JointMotor& motor) {
    Joint& joint = jointOf(state_->joints, id);
    FreeAxis& axis = ownAxisOf(joint, "motor");
    requireMotor(motor);
    if (axis.hasServo() && motor.limit > 0) throw InputError("the joint has a servo, so it takes no motor");
    axis.motor_speed = motor.speed;
    axis.motor_limit = motor.limit;
    wakeEnds(state_->bodies, joint);
}

void World::setJointLimits(JointId id, std::optional<double> lower, std::optional<double> upper) {
    Joint& joint = jointOf(state_->joints, id);
    FreeAxis& axis = ownAxisOf(joint, "limits");
    requireLimits(lower, upper, axis.along, entryOf(joint.kind));
    axis.lower = lower.value_or(-Joint::infinite);
    axis.upper = upper.value_or(Joint::infinite);
    wakeEnds(state_->bodies, joint);
}

void World::setJointServo(JointId id, const JointServo& servo) {
    Joint& joint = jointOf(state_->joints, id);
    FreeAxis& axis = ownAxisOf(joint, "servo");
    if (axis.hasMotor()) throw InputError("the joint has a motor, so it takes no servo");
    setServo(servo, axis);
    wakeEnds(state_->bodies, joint);
}

void World::setJointAxis(JointId id, std::size_t index, const JointAxis& axis) {
    Joint& joint = jointOf(state_->joints, id);
    const JointKindEntry& kind = entryOf(joint.kind);
    if (index >= joint.free.size()) {
        throw InputError(
            fmt::format("axis {} of a {} does not exist; it has {} free axes", index, kind.title, joint.free.size()));
    }
    FreeAxis& free = joint.free[index];
    const FreeAxis before = std::exchange(free, freeAxisOf(axis, free.along, kind));
    free.position = before.position;
    free.rotor_speed = before.rotor_speed;
    wakeEnds(state_->bodies, joint);
}

}  // namespace cairn
