/// @file A world that ranks share, as its calls and its step see it.
#pragma once

#include <string_view>

#include "world/world_state.h"

namespace cairn {

/// Brings the bodies of a shared world to the ranks that will find their contacts; does nothing in other worlds.
/// @param range of the detection that follows @param speed no point of a body here is faster [m/s]; without foresight
///        nobody asks @param flown whether bodies have moved in this step
void settleShared(WorldState& world, const DetectionRange& range, double speed, bool flown);

/// Makes a shared world whole, on all ranks: bodies, contacts, batches, statistics and faults.
void gatherShared(WorldState& world);

/// Completes a world whose parts were put together: contacts and faults in their order, and what follows from them.
/// @pre bodies, joints, contacts, sensed, statistics and faults of all ranks, one after the other
void unite(WorldState& world);

/// Whether the bodies that are added to a world now are dealt out to the ranks.
bool isDealing(const WorldState& world);

/// The least number that any rank has that has a part of the world. To be called by all of them.
int leastOnAny(const WorldState& world, int here);

/// @param call that needs all bodies, such as "World::addBody" @throws InputError if the world is divided among ranks
void requireWhole(const WorldState& world, std::string_view call);

}  // namespace cairn
