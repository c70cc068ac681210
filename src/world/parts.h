/// @file How a step is divided. What lies ahead of a body is foreseen along a straight way, with the sides that bodies
/// turn to each other now: that holds for short ways. Where what touches or is about to would turn or pass each other
/// too far, bodies fly for a part of the step only before the next detection. The parts are powers of two of a step,
/// the same for all bodies, so that results depend on nothing but the state.
#pragma once

#include "pairs/warm_start.h"
#include "world/world_state.h"

namespace cairn {

/// Whether contacts are foreseen: sweeps let bodies come just so close that they touch, rather than fly into or through
/// each other.
bool foresees(const Settings& settings);

/// Whether it is noted from where bodies fly.
bool notesWays(const Settings& settings);

/// Begins the next part of the step. @param done units of the step before it
void beginPart(WorldState& world, int done);

/// Chooses how far the next detection looks ahead: to the end of the step or of the next one, unless the last wanted
/// less than half of it.
void chooseNextPart(WorldState& world);

/// Makes the next part as short as the contacts there are want it. @return whether it became shorter
bool shortenNextPart(WorldState& world);

/// How long bodies fly after this part [s].
double nextPartLength(const WorldState& world);

/// What contacts begin this part with.
ContactsBegin contactsBegin(const WorldState& world, WarmStart warm_start);

/// Adds what this part gave contacts to what they received in the step, and shortens the next one where bodies were
/// struck.
void finishPart(WorldState& world);

}  // namespace cairn
