/// @file Finite shapes as the corners of a core and a radius around it, in extended precision: slow answers, found
/// another way, to what the narrow phase says of two shapes.
#pragma once

#include <vector>

#include "cairn/shape.h"

namespace cairn::testing {

using Real = long double;
using Vec3L = Eigen::Matrix<Real, 3, 1>;

/// A posed sphere (core: a point), capsule (two points) or box (eight).
struct Solid {
    std::vector<Vec3L> corners;
    std::vector<Vec3L> face_normals;     ///< one of each opposite pair
    std::vector<Vec3L> edge_directions;  ///< one of each set of parallel edges
    Real radius = 0;

    Solid(const Shape& shape, const Pose& pose);
    void move(const Vec3L& by);
    /// Distance of a point from the surface, inside or outside.
    Real fromSurface(const Vec3L& p) const;
};

/// The vector from the closest point of B's core to that of A's by Gilbert, Johnson and Keerthi's algorithm, the
/// closest point of every simplex found by trying all of its faces; zero if the cores overlap.
Vec3L coreDistance(const Solid& a, const Solid& b);
/// The separation of the shadows of A and B on a line. @param n unit; A is moved along it to part them
Real separationAlong(const Solid& a, const Solid& b, const Vec3L& n);
/// The distance of the surfaces of A and B; if they overlap, minus the length of the least translation that parts them.
Real gapOf(const Solid& a, const Solid& b);

}  // namespace cairn::testing
