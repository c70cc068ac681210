/// @file Invariants of a step that can be checked while it runs.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// @throws InvariantError unless the batches split the contacts as they must
void checkBatches(const WorldState& world);

/// Whether the resolution of this step, which is still to come, must not add energy: no motor drives, and no skew
/// impact bounces by Newton's law, which together with friction gives more than it takes at times. @pre the contacts
/// are detected
bool mustKeepEnergy(WorldState& world);

/// Contacts take energy away; they give no more than the error of their resolution. @param before kinetic energy before
/// the resolution [J]
/// @throws InvariantError if it rose
void checkEnergy(const WorldState& world, double before);

/// The state after a step. @throws InvariantError naming step, body and what is wrong
void checkState(const WorldState& world);

}  // namespace cairn
