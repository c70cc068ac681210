/// @file Tolerances used in more than one room, with their units and why they have their size.
#pragma once

namespace cairn {

/// Directions closer to perpendicular than this count as perpendicular to gravity [1, cosine]: a wall beside a resting
/// body must not count as a support because of rounding.
inline constexpr double perpendicular_cosine = 1e-3;

/// Lengths below this part of the sizes of what is compared, and sines below it, are treated as zero when a direction
/// is normalised: rounding would decide on it.
inline constexpr double tiny_part = 1e-11;

/// What stays below so much of a limit is below it however both are rounded: where that is told in a short way, it need
/// not be told in the exact one.
inline constexpr double surely_below = 0.99;

}  // namespace cairn
