/// @file Whose gravity may be damped.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Finds the bodies that feel all of their weight however slow they are: those in whose batch other forces act than
/// gravity, by users, springs, free axes of joints, drag, a moving frame or moving fixed bodies. What gravity alone
/// holds together holds as well with a part of it, all its forces being a part; beside other forces it would not:
/// friction would hold less of them, and a spring carry less. Nobody where the preset is one of the thesis.
void findAllWeight(WorldState& world);

}  // namespace cairn
