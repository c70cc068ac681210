/// @file The half-space in the form its users need.
#pragma once

#include "cairn/shape.h"

namespace cairn {

/// The outward unit normal of a half-space, whatever length the given one has. @return [B]
Vec3 unitNormal(const HalfSpace& half_space);

}  // namespace cairn
