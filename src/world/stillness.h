/// @file Steps of a world in which everybody sleeps.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Whether a step would leave everything as the last one did: everybody slept through the last steps, and since then
/// no call, law or frame has changed anything. Worlds that are checked, traced, measured or shared are never still, so
/// that all of their steps are computed.
bool isStill(const WorldState& world);

/// Counts the steps through which everybody sleeps. To be called at the end of a step that was computed.
void countStillSteps(WorldState& world);

/// To be called by whoever changes the world between two steps.
/// @param call such as "World::addBody" @throws InputError if the world is divided among ranks
void beginChange(WorldState& world, std::string_view call);

}  // namespace cairn
