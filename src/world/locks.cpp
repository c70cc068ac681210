#include "world/locks.h"

#include <fmt/core.h>

#include "cairn/world.h"
#include "joints/joint_kinds.h"
#include "world/stillness.h"

namespace cairn {

namespace {

/// The locks of a body, or null.
Joint* findLocks(WorldState& world, BodyIndex i) {
    if (world.joints.empty()) return nullptr;
    world.ties.list(world.springs, world.joints, world.bodies.slots());
    for (const std::uint32_t slot : world.ties.jointsOf(i)) {
        Joint& joint = world.joints[slot];
        if (joint.present && joint.kind == body_locks && joint.a == i) return &joint;
    }
    return nullptr;
}

Joint& newLocks(WorldState& world, BodyIndex i) {
    std::size_t slot = 0;
    while (slot < world.joints.size() && world.joints[slot].present) ++slot;
    if (slot == world.joints.size()) world.joints.emplace_back();
    Joint joint;
    joint.present = true;
    joint.generation = world.joints[slot].generation;
    joint.kind = body_locks;
    joint.a = i;
    joint.collide = true;
    world.joints[slot] = joint;
    world.ties.forget();
    return world.joints[slot];
}

}  // namespace

void moveLocks(WorldState& world, BodyIndex i) {
    Joint* const locks = findLocks(world, i);
    if (locks == nullptr) return;
    locks->anchor_b = world.bodies.position[i];
    locks->rest = world.bodies.orientation[i];
}

std::uint8_t lockMaskOf(std::span<const JointAlong> axes) {
    unsigned mask = 0;
    for (const JointAlong along : axes) {
        if (along > JointAlong::turn_z) throw InputError("a locked axis is none of JointAlong");
        const unsigned bit = 1U << static_cast<unsigned>(along);
        if ((mask & bit) != 0) throw InputError("a locked axis is given twice; give it once");
        mask |= bit;
    }
    return static_cast<std::uint8_t>(mask);
}

void setLocks(WorldState& world, BodyIndex i, std::uint8_t mask) {
    Joint* locks = findLocks(world, i);
    if (locks == nullptr && mask == 0) return;
    if (locks == nullptr) locks = &newLocks(world, i);
    locks->locked = mask;
    if (mask == 0) {
        locks->present = false;
        ++locks->generation;
    }
    moveLocks(world, i);
    world.bodies.state().wake(i, WakeReason::changed);
}

std::uint8_t locksOf(WorldState& world, BodyIndex i) {
    const Joint* const locks = findLocks(world, i);
    return locks == nullptr ? std::uint8_t{0} : locks->locked;
}

void World::setLocked(BodyId id, std::span<const JointAlong> axes) {
    beginChange(*state_, "World::setLocked");
    const BodyIndex i = state_->bodies.indexOf(id);
    const std::uint8_t mask = lockMaskOf(axes);
    if (mask != 0 && state_->bodies.kind[i] == BodyKind::fixed) {
        throw InputError(fmt::format("body {} is fixed, so it moves along no axis; lock axes of dynamic bodies", i));
    }
    setLocks(*state_, i, mask);
}

std::vector<JointAlong> World::locked(BodyId id) const {
    const std::uint8_t mask = locksOf(*state_, state_->bodies.indexOf(id));
    std::vector<JointAlong> axes;
    for (unsigned along = 0; along < 6; ++along) {
        if (((mask >> along) & 1U) != 0) axes.push_back(static_cast<JointAlong>(along));
    }
    return axes;
}

}  // namespace cairn
