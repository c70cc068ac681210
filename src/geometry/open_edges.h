/// @file Why a surface is not watertight.
#pragma once

#include <string>

#include "geometry/surface_data.h"

namespace cairn {

/// The edges of triangles that no triangle runs against.
struct OpenEdges {
    std::size_t open = 0;       ///< edges at a hole
    std::size_t holes = 0;      ///< groups of open edges that hang together
    std::size_t opposite = 0;   ///< edges whose triangles look to opposite sides
    Vec3 first = Vec3::Zero();  ///< the middle of the first of either [m]

    bool any() const { return open + opposite > 0; }
};

/// Edges between four triangles, where a surface touches itself, are not open if the triangles run in pairs.
OpenEdges openEdgesOf(const SurfaceData& surface);

/// For the user, with the remedy.
std::string describe(const OpenEdges& edges);

}  // namespace cairn
