/// @file Measures what every stage of a step does with momentum and energy, and how well the contacts keep their laws.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Between which parts of a step it is measured.
enum class Measured { begin, laws, positions, correction, forces, damping, resolution, completion, sleep };

/// Puts what happened since the last point on its account in Statistics::diagnostics.
/// @pre settings.diagnostics; every point once per step, in order
void measure(WorldState& world, Measured point);

}  // namespace cairn
