/// @file Stages 4 and 7 of the step: which contacts are of one batch, and their resolution.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Groups the contacts into batches, and lists those of each body.
void batchContacts(WorldState& world);

/// Resolves what is awake of all batches. Where that sends bodies elsewhere than the detection foresaw, so that they
/// would get into others before the next one, contacts are added, and their surroundings are resolved again.
/// @param bodies as for the resolution @param pairs as for the detection
void resolveContacts(WorldState& world, BodyState& bodies, const PairsInput& pairs);

/// Finds the bodies that bounced and lost less by that than the way is worth that forces gave them in the step before.
/// @param before out
void findBounced(const WorldState& world, const BodyState& bodies, VelocitiesBefore& before);

/// Resolves the impacts that bodies would make with the velocities that users gave them, which no resolution granted:
/// before they fly on with these for a step. @pre the contacts are those of the places and velocities of now
void resolveLaunched(WorldState& world, BodyState& bodies, const PairsInput& pairs);

}  // namespace cairn
