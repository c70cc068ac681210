/// The part of World that ranks share.
#include "cairn/world.h"
#include "world/division.h"
#include "world/world_state.h"

namespace cairn {

void World::share(Ranks& ranks, const Partition& partition) {
    requireWhole(*state_, "World::share");
    state_->shared = std::make_unique<SharedBodies>(ranks, partition);
}

void World::gather() {
    gatherShared(*state_);
}

Ranks* World::ranks() const noexcept {
    return state_->shared != nullptr ? &state_->shared->ranks() : nullptr;
}

bool World::isDivided() const noexcept {
    return state_->shared != nullptr && !state_->shared->isWhole();
}

}  // namespace cairn
