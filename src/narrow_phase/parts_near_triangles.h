/// @file Which parts of a compound may touch which triangles of a surface.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "geometry/surface_data.h"

namespace cairn {

/// A part of a compound and a triangle of a surface.
struct PartNearTriangle {
    std::uint32_t part;
    std::uint32_t triangle;

    friend auto operator<=>(const PartNearTriangle&, const PartNearTriangle&) = default;
};

/// All parts with the triangles whose bounds theirs are near, and maybe more, ascending. Both trees are gone through at
/// once, so what is far from the other shape costs next to nothing.
/// @param pose of the compound in the frame of the surface @param margin up to which bounds are near [m]
/// @pre the compound has a tree
std::vector<PartNearTriangle> partsNearTriangles(const Compound& compound, const Pose& pose, const SurfaceData& surface,
                                                 double margin);

}  // namespace cairn
