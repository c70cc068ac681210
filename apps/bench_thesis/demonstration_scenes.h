/// @file Scenes of the demonstrations that are not built in.
#pragma once

#include "cairn/scene.h"

namespace cairn::thesis {

/// Balls in a row between two fixed walls, without gravity and friction and with e = 1; the first `moving` move.
Scene endlessCradleScene(int balls, int moving);

/// Index of the spinning ball in spinningBallScene().
inline constexpr std::size_t spinning_ball = 9;
/// A pyramid of 9, 4 and 1 oak balls in a frame; the middle ball of the lowest layer spins.
/// @param axis of the spin, unit
Scene spinningBallScene(const Vec3& axis);

}  // namespace cairn::thesis
