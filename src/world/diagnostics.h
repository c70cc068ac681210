/// @file Measures what every stage of a step does with momentum and energy, and how well the contacts keep their laws.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Sums what happened since the last point; the last point puts it on the accounts in Statistics::diagnostics, of the
/// whole world on all ranks that share it. @pre settings.diagnostics; the points of a step in order, only
/// Measured::resolution also before the positions
void measure(WorldState& world, Measured point);

}  // namespace cairn
