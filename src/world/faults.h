/// @file What becomes of bodies whose state is none.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Fixes every body whose state left the finite numbers or the limits, where it is, and adds the fault.
void fixNonFinite(WorldState& world);

}  // namespace cairn
