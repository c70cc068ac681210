/// @file What is known of a convex hull once it is built.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/geometry.h"

namespace cairn {

/// A flat face; coplanar neighbours are one.
struct HullFace {
    Vec3 normal;          ///< unit, outward
    double offset;        ///< of its plane from the origin along the normal [m]
    std::uint32_t begin;  ///< of its corners in HullData::loops
    std::uint32_t end;
};

/// A solid with flat faces, in the frame of its points.
struct HullData {
    std::vector<Vec3> points;          ///< as given [m]
    std::vector<Vec3> corners;         ///< those of them that are corners, in the order given [m]
    std::vector<HullFace> faces;       ///< by their corners, so that the order does not depend on how they were found
    std::vector<std::uint32_t> loops;  ///< indices of corners, face after face, counter-clockwise seen from outside
    UnitMassProperties mass{};
    double radius = 0;    ///< largest distance of a corner from the centre of mass [m]
    double smallest = 0;  ///< smallest distance of a face from the centre of mass [m]

    std::span<const std::uint32_t> loop(const HullFace& face) const {
        return std::span(loops).subspan(face.begin, face.end - face.begin);
    }
};

/// @throws InputError as ConvexHull
HullData buildHull(std::vector<Vec3> points);

}  // namespace cairn
