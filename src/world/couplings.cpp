#include "world/couplings.h"

#include <fmt/core.h>

#include <cmath>

#include "joints/joint_kinds.h"

namespace cairn {

namespace {

/// Largest ratio of two positions, and the inverse of the smallest.
constexpr double ratio_limit = 1e6;

const Joint& coupledJoint(const WorldState& world, JointId id, std::string_view what) {
    const bool exists = id.index < world.joints.size() && world.joints[id.index].present &&
                        world.joints[id.index].generation == id.generation;
    if (exists) return world.joints[id.index];
    throw StaleIdError(fmt::format("the {} joint {}:{} of a coupling is not in the world; add it first", what, id.index,
                                   id.generation));
}

void requireFreeAxis(const Joint& joint, std::size_t axis, std::string_view what) {
    if (axis < joint.free.size()) return;
    if (entryOf(joint.kind).uses.couples) {
        throw InputError(fmt::format("the {} joint of a coupling is a {} itself; couple the joints that it couples",
                                     what, entryOf(joint.kind).title));
    }
    throw InputError(fmt::format("the {} joint of a coupling, a {}, has no free axis {}; it has {}", what,
                                 entryOf(joint.kind).title, axis, joint.free.size()));
}

void requireAngles(JointKind kind, bool first_turns, bool second_turns) {
    if (kind == JointKind::gear && !(first_turns && second_turns)) {
        throw InputError("a gear couples two angles; take a rack or a mimic for displacements");
    }
    if (kind == JointKind::rack && !(first_turns && !second_turns)) {
        throw InputError(
            "a rack couples an angle of the first joint to a displacement of the second; swap them, or take a mimic");
    }
}

void requireNothingElse(const JointDescription& d, std::string_view title) {
    if (!d.axes.empty() || d.lower || d.upper || d.motor || d.servo || d.spring || d.anchor_b || d.length || d.lead ||
        d.cone || d.b || d.damping != 0 || d.friction != 0 || d.rotor_inertia != 0 || d.restitution != 0) {
        throw InputError(fmt::format(
            "a {} has two joints, their axes, a ratio and what it breaks at, nothing else; give the rest to the "
            "joints that it couples",
            title));
    }
}

void requireBreaking(const JointDescription& d, std::string_view title, bool second_turns) {
    const auto require = [&](double value, std::string_view what, bool fits, std::string_view other) {
        if (!(value > 0)) throw InputError(fmt::format("{} of a {} is {}; it must be above 0", what, title, value));
        if (fits || !std::isfinite(value)) return;
        throw InputError(fmt::format("a {} whose second axis is {} breaks at a {}; leave {} out", title,
                                     second_turns ? "an angle" : "a displacement", other, what));
    };
    require(d.break_force, "break_force", !second_turns, "break_torque");
    require(d.break_torque, "break_torque", second_turns, "break_force");
}

BodyIndex movableOf(const Joint& joint, std::span<const BodyKind> kind) {
    return isMovable(kind, joint.a) ? joint.a : joint.b;
}

}  // namespace

Joint couplingOf(const JointDescription& d, WorldState& world) {
    const JointKindEntry& kind = entryOf(d.kind);
    requireNothingElse(d, kind.title);
    const Joint& first = coupledJoint(world, d.first, "first");
    const Joint& second = coupledJoint(world, d.second, "second");
    requireFreeAxis(first, d.first_axis, "first");
    requireFreeAxis(second, d.second_axis, "second");
    const bool second_turns = isAngle(second.free[d.second_axis].along);
    requireAngles(d.kind, isAngle(first.free[d.first_axis].along), second_turns);
    requireBreaking(d, kind.title, second_turns);
    if (d.first == d.second && d.first_axis == d.second_axis) {
        throw InputError(fmt::format("a {} couples an axis to itself; give two joints, or two axes", kind.title));
    }
    const double size = std::abs(d.ratio);
    if (!(size <= ratio_limit && size >= 1 / ratio_limit)) {
        throw InputError(fmt::format("the ratio of a {} is {}; its size must be within {} and {}", kind.title, d.ratio,
                                     1 / ratio_limit, ratio_limit));
    }
    Joint joint;
    joint.first = d.first.index;
    joint.second = d.second.index;
    joint.first_axis = static_cast<std::uint32_t>(d.first_axis);
    joint.second_axis = static_cast<std::uint32_t>(d.second_axis);
    joint.ratio = d.kind == JointKind::gear ? -d.ratio : d.ratio;
    const auto positionOf = [&](const Joint& of, std::size_t axis) {
        return motionOf(of, axis, poseOf(world.bodies, of.a), poseOf(world.bodies, of.b)).position;
    };
    joint.offset = positionOf(second, d.second_axis) - joint.ratio * positionOf(first, d.first_axis);
    joint.a = movableOf(first, world.bodies.kind);
    joint.b = movableOf(second, world.bodies.kind);
    joint.break_force = d.break_force;
    joint.break_torque = d.break_torque;
    joint.collide = true;
    return joint;
}

void removeLooseCouplings(WorldState& world) {
    const BodyState bodies = world.bodies.state();
    for (Joint& joint : world.joints) {
        if (!joint.present || !entryOf(joint.kind).uses.couples) continue;
        const bool holds = world.joints[joint.first].present && world.joints[joint.second].present;
        if (holds) continue;
        for (const BodyIndex body : {joint.a, joint.b}) {
            if (isMovable(world.bodies.kind, body)) bodies.wake(body, WakeReason::changed);
        }
        joint.present = false;
        ++joint.generation;
    }
}

void placeCouplings(WorldState& world) {
    for (Joint& joint : world.joints) {
        if (!joint.present || !entryOf(joint.kind).uses.couples) continue;
        joint.a = movableOf(world.joints[joint.first], world.bodies.kind);
        joint.b = movableOf(world.joints[joint.second], world.bodies.kind);
    }
}

}  // namespace cairn
