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
    Pose pose;                   ///< of the shape's frame in W
    std::uint32_t triangle = 0;  ///< of a surface, of which only this is meant
};

/// How many parts a shape has: those of a compound, the triangles of a surface, or 1.
std::size_t partCount(const Shape& shape);
/// A part where it is, or a shape without parts itself. @pre part < partCount(shape)
Placed placedPart(const Shape& shape, const Pose& pose, std::size_t part);
Bounds boundsOf(const Placed& placed);

/// Closest points of two shapes without parts. @param limit those farther apart are of no interest [m], ≥ 0
/// @return none beyond the limit, and for two half-spaces; the parts are 0
std::optional<ClosestPoints> closestOfParts(const Placed& a, const Placed& b, double limit);

/// Where a shape without parts that moves touches another. @param direction unit @param reach [m]
/// @return none beyond the reach @pre the moving one is solid
std::optional<ShapeHit> castPart(const Placed& moving, const Vec3& direction, double reach, const Placed& other);

}  // namespace cairn
