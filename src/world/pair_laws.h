/// @file Laws of pairs of materials, which depend on the velocity at a contact.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Gives the contacts of pairs with a law the restitution and friction of their velocities now. @param bodies with the
/// velocities that the resolution begins with
void applyPairLaws(WorldState& world, const BodyState& bodies);
/// The same for some contacts. @param some their indices
void applyPairLaws(WorldState& world, const BodyState& bodies, std::span<const std::uint32_t> some);

}  // namespace cairn
