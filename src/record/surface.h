/// @file The surface of a shape as polygons, for drawing.
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/shape.h"

namespace cairn {

/// Polygons with outward normals (counter-clockwise seen from outside).
struct Surface {
    std::vector<Vec3> points;           ///< [m, frame of the shape]
    std::vector<std::int32_t> corners;  ///< indices of points, polygon after polygon
    std::vector<std::int32_t> ends;     ///< where each polygon ends in corners
};

/// What a half-space is drawn as: a square of its plane about the point of the plane that is nearest to a centre.
struct PlaneExtent {
    Vec3 centre = Vec3::Zero();  ///< [m, frame of the shape]
    double half_edge = 1;        ///< [m], > 0
};

/// @param shape any @param extent of half-spaces
Surface makeSurface(const Shape& shape, const PlaneExtent& extent);

}  // namespace cairn
