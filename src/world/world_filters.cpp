/// The part of World that says who touches whom, and what bodies feel of their own.
#include <fmt/core.h>

#include <cmath>

#include "cairn/world.h"
#include "world/limits.h"
#include "world/stillness.h"
#include "world/world_state.h"

namespace cairn {

GroupId World::addGroup(const std::string& name) {
    beginChange(*state_, "World::addGroup");
    state_->lasting.reset();
    return state_->bodies.filter.addGroup(name);
}

std::span<const std::string> World::groupNames() const {
    return state_->bodies.filter.groups();
}

void World::setGroupsTouch(GroupId a, GroupId b, Touch touch) {
    beginChange(*state_, "World::setGroupsTouch");
    WorldState& w = *state_;
    if (w.bodies.filter.ofGroups(a, b) == touch) return;
    w.lasting.reset();
    w.bodies.filter.setGroups(a, b, touch);
    w.wakeAll();
}

Touch World::groupsTouch(GroupId a, GroupId b) const {
    return state_->bodies.filter.ofGroups(a, b);
}

void World::setGroups(BodyId id, std::span<const GroupId> groups) {
    beginChange(*state_, "World::setGroups");
    WorldState& w = *state_;
    const BodyIndex i = w.bodies.indexOf(id);
    const std::uint64_t mask = w.bodies.filter.maskOf(groups);
    w.lasting.reset();
    w.bodies.groups[i] = mask;
    w.bodies.state().wake(i, WakeReason::changed);
}

std::vector<GroupId> World::groups(BodyId id) const {
    const std::uint64_t mask = state_->bodies.groups[state_->bodies.indexOf(id)];
    std::vector<GroupId> groups;
    for (std::uint32_t i = 0; i < most_groups; ++i) {
        if ((mask >> i & 1U) != 0) groups.push_back(static_cast<GroupId>(i));
    }
    return groups;
}

void World::setPairTouch(BodyId a, BodyId b, std::optional<Touch> touch) {
    beginChange(*state_, "World::setPairTouch");
    WorldState& w = *state_;
    const BodyIndex i = w.bodies.indexOf(a);
    const BodyIndex k = w.bodies.indexOf(b);
    if (i == k) throw InputError(fmt::format("body {} cannot touch itself; name two bodies", i));
    w.lasting.reset();
    w.bodies.filter.setPair(i, k, touch);
    w.bodies.state().wake(i, WakeReason::changed);
    w.bodies.state().wake(k, WakeReason::changed);
}

std::optional<Touch> World::pairTouch(BodyId a, BodyId b) const {
    return state_->bodies.filter.ofPair(state_->bodies.indexOf(a), state_->bodies.indexOf(b));
}

bool World::isSensor(BodyId id) const {
    return state_->bodies.sensor[state_->bodies.indexOf(id)] != 0;
}

std::span<const Sensed> World::sensed() const {
    return state_->data.sensed;
}

void World::setGravityFactor(BodyId id, double factor) {
    beginChange(*state_, "World::setGravityFactor");
    BodyStorage& b = state_->bodies;
    const BodyIndex i = b.indexOf(id);
    requireGravityFactor(factor);
    state_->lasting.reset();
    b.gravity_factor[i] = factor;
    b.state().wake(i, WakeReason::changed);
}

double World::gravityFactor(BodyId id) const {
    return state_->bodies.gravity_factor[state_->bodies.indexOf(id)];
}

void World::setDamping(BodyId id, double linear, double angular) {
    beginChange(*state_, "World::setDamping");
    BodyStorage& b = state_->bodies;
    const BodyIndex i = b.indexOf(id);
    requireDamping(linear, "linear");
    requireDamping(angular, "angular");
    state_->lasting.reset();
    b.linear_damping[i] = linear;
    b.angular_damping[i] = angular;
    b.state().wake(i, WakeReason::changed);
}

double World::linearDamping(BodyId id) const {
    return state_->bodies.linear_damping[state_->bodies.indexOf(id)];
}

double World::angularDamping(BodyId id) const {
    return state_->bodies.angular_damping[state_->bodies.indexOf(id)];
}

void World::setUserData(BodyId id, std::uint64_t data) {
    beginChange(*state_, "World::setUserData");
    const BodyIndex i = state_->bodies.indexOf(id);
    state_->lasting.reset();
    state_->bodies.user_data[i] = data;
}

std::uint64_t World::userData(BodyId id) const {
    return state_->bodies.user_data[state_->bodies.indexOf(id)];
}

}  // namespace cairn
