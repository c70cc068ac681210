/// @file Gears, racks and mimics: joints between two joints.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// @throws InputError for joints or a ratio that it cannot couple, StaleIdError
Joint couplingOf(const JointDescription& d, WorldState& world);

/// Removes the couplings of joints that are gone. They wake what they coupled.
void removeLooseCouplings(WorldState& world);

/// Lets couplings be between bodies that can move, if their joints have any, as these are now.
void placeCouplings(WorldState& world);

}  // namespace cairn
