#include "world/joints.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "activity/sleeping.h"
#include "joints/joint_kinds.h"
#include "world/couplings.h"
#include "world/parts.h"

namespace cairn {

namespace {

/// Pairs that joints keep from touching.
void listExcluded(const WorldState& world, std::vector<BodyPair>& excluded) {
    excluded.clear();
    for (const Joint& joint : world.joints) {
        if (!joint.present || joint.collide || joint.b == Joint::world) continue;
        excluded.push_back({std::min(joint.a, joint.b), std::max(joint.a, joint.b)});
    }
    std::ranges::sort(excluded);
}

bool isRunning(const FreeAxis& axis) {
    return (axis.hasMotor() && axis.motor_speed != 0) || (axis.hasServo() && axis.servo_speed != 0);
}

/// A motor that runs keeps its bodies awake, however slowly it moves them, and so does a law that carries them.
bool isDriven(const WorldState& world, std::size_t group) {
    const std::vector<Carried>& carried = world.data.carried;
    const auto isCarried = [&](BodyIndex body) { return carried[body] != Carried::not_at_all; };
    if (!carried.empty() && std::ranges::any_of(world.data.joint_groups.bodiesOf(group), isCarried)) return true;
    return std::ranges::any_of(world.data.joint_groups.jointsOf(group),
                               [&](std::uint32_t j) { return std::ranges::any_of(world.joints[j].free, isRunning); });
}

/// Whether the bodies of a joint slept through the resolution. One that overflowed in this step can no longer move.
bool isAsleep(const BodyStorage& bodies, const Joint& joint) {
    const auto sleeps = [&](BodyIndex body) { return isMovable(bodies.kind, body) && bodies.asleep[body] != 0; };
    return sleeps(joint.a) || sleeps(joint.b);
}

/// From which turns are counted in the next step.
void savePositions(const JointBlock& block, Joint& joint) {
    for (std::size_t i = 0; i < joint.free.size(); ++i) joint.free[i].position = block.position[i];
}

/// Whether a joint is loaded too much in this step.
bool isOverloaded(const Joint& joint, double time_step) {
    const double force = joint.break_force * time_step;
    const double torque = joint.break_torque * time_step;
    // A coupling has the one that its second axis is about.
    if (entryOf(joint.kind).uses.couples) return std::abs(joint.coupled_impulse) > std::min(force, torque);
    return joint.impulse.norm() > force || joint.angular_impulse.norm() > torque;
}

void removeBroken(WorldState& world, std::uint32_t slot) {
    Joint& joint = world.joints[slot];
    const BodyState bodies = world.bodies.state();
    const bool has_b = joint.b != Joint::world;
    world.data.broken.push_back({{slot, joint.generation},
                                 world.bodies.idOf(joint.a),
                                 has_b ? world.bodies.idOf(joint.b) : BodyId{},
                                 joint.impulse});
    for (const BodyIndex body : {joint.a, joint.b}) {
        if (isMovable(world.bodies.kind, body)) bodies.wake(body, WakeReason::changed);
    }
    joint.present = false;
    ++joint.generation;
}

}  // namespace

void beginJointImpulses(WorldState& world) {
    for (Joint& joint : world.joints) {
        joint.last_impulse = std::exchange(joint.impulse, Vec3::Zero());
        joint.last_angular_impulse = std::exchange(joint.angular_impulse, Vec3::Zero());
        joint.coupled_impulse = 0;
        joint.booked_impulse.setZero();
        joint.booked_angular_impulse.setZero();
        joint.fixed_impulse.setZero();
        joint.fixed_angular_impulse.setZero();
    }
}

void prepareJoints(WorldState& world) {
    StepData& data = world.data;
    data.broken.clear();
    placeCouplings(world);
    world.joint_grouping.build(world.joints, world.bodies.kind, data.joint_groups);
    listExcluded(world, data.excluded);
    data.jointed.assign(data.joint_groups.size() > 0 ? world.bodies.slots() : 0, 0);
    for (const BodyIndex body : data.joint_groups.bodies) data.jointed[body] = 1;
    wakeJointed(world);
}

void wakeJointed(WorldState& world) {
    const JointGroups& groups = world.data.joint_groups;
    const BodyState bodies = world.bodies.state();
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::span<const BodyIndex> group = groups.bodiesOf(g);
        const bool awake = std::ranges::any_of(group, [&](BodyIndex i) { return bodies.asleep[i] == 0; });
        if (!awake && !isDriven(world, g)) continue;
        for (const BodyIndex body : group) bodies.wake(body, WakeReason::changed);
    }
}

void buildJointBlocks(WorldState& world) {
    StepData& data = world.data;
    const JointGroups& groups = data.joint_groups;
    data.joint_begin.assign(data.batches.size() + 1, 0);
    data.joint_blocks.resize(groups.joints.size());
    if (groups.size() == 0) return;
    // Forces act for this part, and limits are reached in the next. What users launched is resolved for that alone.
    const double time = world.part.units > 0 ? world.part.length : nextPartLength(world);
    const double ahead = nextPartLength(world) / time;
    const auto batchOfGroup = [&](std::size_t g) { return data.batch_scratch.batch_of_body[groups.bodiesOf(g)[0]]; };
    for (std::size_t g = 0; g < groups.size(); ++g) {
        data.joint_begin[batchOfGroup(g)] += static_cast<std::uint32_t>(groups.jointsOf(g).size());
    }
    std::exclusive_scan(data.joint_begin.begin(), data.joint_begin.end(), data.joint_begin.begin(), std::uint32_t{0});
    data.joint_cursor.assign(data.joint_begin.begin(), data.joint_begin.end());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        for (const std::uint32_t slot : groups.jointsOf(g)) {
            JointBlock& block = data.joint_blocks[data.joint_cursor[batchOfGroup(g)]++];
            block.group = static_cast<std::uint32_t>(g);
            evaluate(world.joints, slot, world.bodies, time, block);
            for (BoundRow& bound : block.bound) {
                if (bound.isLimit() && ahead != 1) {
                    bound.lowest /= ahead;
                    bound.highest /= ahead;
                }
                const double per_metre = unitOf(block, bound) / block.reach;
                bound.slowest = world.settings.resolution.restitution_threshold * per_metre;
            }
            savePositions(block, world.joints[slot]);
        }
    }
    for (std::size_t i = 0; i < data.views.size(); ++i) {
        data.views[i].joints =
            std::span(data.joint_blocks).subspan(data.joint_begin[i], data.joint_begin[i + 1] - data.joint_begin[i]);
    }
}

void keepImpactsOnly(WorldState& world) {
    for (JointBlock& block : world.data.joint_blocks) {
        std::erase_if(block.bound, [](const BoundRow& bound) { return bound.is_motor; });
        block.bounds = static_cast<std::uint32_t>(block.bound.size());
    }
}

void addJointImpulses(WorldState& world, std::span<const JointBlock> blocks) {
    for (const JointBlock& block : blocks) reportImpulses(block, world.bodies, world.joints[block.joint]);
}

void bookJointImpulses(WorldState& world) {
    for (Joint& joint : world.joints) {
        joint.booked_impulse = joint.impulse;
        joint.booked_angular_impulse = joint.angular_impulse;
        joint.fixed_impulse.setZero();
        joint.fixed_angular_impulse.setZero();
    }
}

void countJointSupports(const WorldState& world, std::span<std::int32_t> supports) {
    for (const std::uint32_t slot : world.data.joint_groups.joints) {
        for (const BodyIndex body : {world.joints[slot].a, world.joints[slot].b}) {
            if (isMovable(world.bodies.kind, body)) ++supports[body];
        }
    }
}

void letJointedSleep(WorldState& world) {
    BodyStorage& b = world.bodies;
    const JointGroups& groups = world.data.joint_groups;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (isDriven(world, g)) continue;
        fallAsleepTogether(b.state(), {b.motion, b.r_max, b.constant_force, b.constant_torque}, world.settings.sleep,
                           world.settings.timeStep(), groups.bodiesOf(g));
    }
}

void finishJoints(WorldState& world) {
    for (const JointBlock& block : world.data.joint_blocks) {
        Joint& joint = world.joints[block.joint];
        if (isAsleep(world.bodies, joint)) {
            joint.impulse = joint.last_impulse;
            joint.angular_impulse = joint.last_angular_impulse;
        } else {
            reportImpulses(block, world.bodies, joint);
        }
        joint.redundant = block.redundant;
    }
    if (!world.part.isLast()) return;
    const double time_step = world.settings.timeStep();
    for (std::uint32_t slot = 0; slot < world.joints.size(); ++slot) {
        if (world.joints[slot].present && isOverloaded(world.joints[slot], time_step)) removeBroken(world, slot);
    }
    if (!world.data.broken.empty()) removeLooseCouplings(world);
}

bool hasMotors(const WorldState& world) {
    const auto mayDrive = [](const FreeAxis& axis) { return axis.mayDrive(); };
    return std::ranges::any_of(
        world.joints, [&](const Joint& joint) { return joint.present && std::ranges::any_of(joint.free, mayDrive); });
}

}  // namespace cairn
