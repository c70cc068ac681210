/// The part of World that ranks share.
#include "cairn/world.h"
#include "world/division.h"
#include "world/limits.h"
#include "world/requirements.h"
#include "world/world_state.h"

namespace cairn {

void World::share(Ranks& ranks, const Partition& partition) {
    requireWhole(*state_, "World::share");
    state_->shared = std::make_unique<SharedBodies>(ranks, partition);
}

void World::share(Ranks& ranks, const Partition& partition, std::span<const Vec3> places) {
    if (state_->bodies.slots() > 0) {
        throw InputError(
            "World::share with places is for a world without bodies; add them afterwards, or leave the "
            "places out");
    }
    for (const Vec3& place : places) requireWithin(place, distance_limit, "a place", "m");
    share(ranks, partition);
    state_->shared->deal(state_->bodies, {places.begin(), places.end()});
}

void World::gather() {
    gatherShared(*state_);
}

Ranks* World::ranks() const noexcept {
    return state_->shared != nullptr ? &state_->shared->ranks() : nullptr;
}

bool World::isOwn(BodyId id) const noexcept {
    if (!contains(id)) return false;
    const SharedBodies* shared = state_->shared.get();
    if (shared == nullptr) return true;
    return shared->isWhole() ? shared->ranks().rank() == 0
                             : shared->isTold(state_->bodies, state_->bodies.slotOf(id.index));
}

bool World::isOwn(JointId id) const noexcept {
    if (!contains(id)) return false;
    const SharedBodies* shared = state_->shared.get();
    if (shared == nullptr) return true;
    return shared->isWhole() ? shared->ranks().rank() == 0
                             : shared->tellsJoint(state_->bodies, state_->joints[id.index]);
}

bool World::isDivided() const noexcept {
    return state_->shared != nullptr && !state_->shared->isWhole();
}

}  // namespace cairn
