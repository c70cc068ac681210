/// @file Stage 3, after the contacts: who is inside which sensor.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Lists the bodies that overlap sensors where they are now, by sensor and body. @pre the contacts of this step are
/// detected
void findSensed(WorldState& world);

}  // namespace cairn
