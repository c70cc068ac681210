#include "world/stillness.h"

#include "world/division.h"
#include "world/motions.h"

namespace cairn {

namespace {

/// What bodies fell asleep with is gone after so many steps: contacts that were foreseen in the next, and the impulses
/// that they passed on in the one after.
constexpr int enough_steps = 3;

bool isAnyoneAwake(const BodyStorage& bodies) {
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (bodies.kind[i] == BodyKind::dynamic && bodies.asleep[i] == 0) return true;
    }
    return false;
}

}  // namespace

bool isStill(const WorldState& world) {
    if (world.still_steps < enough_steps) return false;
    const bool watched = world.checks != Checks::off || world.trace.tracing != Tracing::off ||
                         world.settings.diagnostics.diagnostics || world.shared != nullptr;
    const bool led = !world.driven.empty() || world.frame || isGravityChanging(world);
    return !watched && !led && !isAnyoneAwake(world.bodies);
}

void countStillSteps(WorldState& world) {
    const bool still = world.statistics.woken == 0 && !isAnyoneAwake(world.bodies);
    world.still_steps = still ? world.still_steps + 1 : 0;
}

void beginChange(WorldState& world, std::string_view call) {
    requireWhole(world, call);
    world.still_steps = 0;
    world.data.pairs.askAll();
}

}  // namespace cairn
