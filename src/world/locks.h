/// @file Locked axes of bodies: joints to the world that nobody sees.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Puts the place that the locks of a body keep where it is now.
void moveLocks(WorldState& world, BodyIndex i);

/// @throws InputError for an axis that does not exist or is given twice
std::uint8_t lockMaskOf(std::span<const JointAlong> axes);

/// Locks these axes of a dynamic body and no others. @param mask a bit for each JointAlong
void setLocks(WorldState& world, BodyIndex i, std::uint8_t mask);

/// A bit for each JointAlong that is locked.
std::uint8_t locksOf(WorldState& world, BodyIndex i);

}  // namespace cairn
