/// @file What acts on bodies besides gravity.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Finds for each body whether in its batch other forces act than gravity: of users, springs and free axes of joints,
/// drag, a moving frame, or moving fixed bodies. Gravity is damped elsewhere only: what gravity alone holds together
/// holds as well with a part of it, all its forces being a part; beside other forces it would not, since friction would
/// hold less of them and a spring carry less. None with the presets of the thesis.
void findLoads(WorldState& world);

}  // namespace cairn
