/// @file Tolerances used in more than one room, with their units and why they have their size.
#pragma once

namespace cairn {

/// Directions closer to perpendicular than this count as perpendicular to gravity [1, cosine]: a wall beside a resting
/// body must not count as a support because of rounding.
inline constexpr double perpendicular_cosine = 1e-3;

/// Lengths below this are treated as zero when a direction is normalised [m]; far below any shape (≥ 1 µm).
inline constexpr double tiny_length = 1e-12;

}  // namespace cairn
