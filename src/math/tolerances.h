/// @file Tolerances used in more than one room, with their units and why they have their size.
#pragma once

namespace cairn {

/// Directions closer to perpendicular than this count as perpendicular to gravity [1, cosine]: a wall beside a resting
/// body must not count as a support because of rounding.
inline constexpr double perpendicular_cosine = 1e-3;

/// Lengths below this part of the sizes of what is compared, and sines below it, are treated as zero when a direction
/// is normalised: rounding would decide on it.
inline constexpr double tiny_part = 1e-11;

}  // namespace cairn
