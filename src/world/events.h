/// @file Collects the events of a step.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Notes what the world is like before the step, since the stages overwrite it.
void beginEvents(WorldState& world);

/// Fills the events of the step: contacts by their pair, then what sensors hold, then bodies that woke and those that
/// fell asleep, each in ascending order of ids, then faults and broken joints likewise; of all ranks that share the
/// world. @pre the stages have run, the reasons of waking are not cleared yet
void collectEvents(WorldState& world);

}  // namespace cairn
