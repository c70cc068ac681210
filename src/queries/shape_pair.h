/// @file Closest points and casts of two posed shapes, part by part.
#pragma once

#include <cstdint>
#include <optional>

#include "cairn/query.h"
#include "geometry/geometry.h"

namespace cairn {

/// A shape without parts, where it is.
struct Placed {
    const Shape& shape;
    Pose pose;  ///< of the shape's frame in W
};

/// How many parts a shape has: 1 unless it is a compound.
std::size_t partCount(const Shape& shape);
/// A part of a compound where it is, or any other shape itself. @pre part < partCount(shape)
Placed placedPart(const Shape& shape, const Pose& pose, std::size_t part);

/// Closest points of two shapes without parts. @param limit those farther apart are of no interest [m], ≥ 0
/// @return none beyond the limit, and for two half-spaces; the parts are 0
std::optional<ClosestPoints> closestOfParts(const Placed& a, const Placed& b, double limit);

/// Where a shape without parts that moves touches another. @param direction unit @param reach [m]
/// @return none beyond the reach @pre the moving one is no half-space
std::optional<ShapeHit> castPart(const Placed& moving, const Vec3& direction, double reach, const Placed& other);

}  // namespace cairn
