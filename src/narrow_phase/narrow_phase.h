/// @file Where two shapes touch: the contact manifold of a pair, from a table of one tester per pair of shapes.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

#include "cairn/shape.h"

namespace cairn {

/// One point of a manifold.
struct ManifoldPoint {
    Vec3 point;       ///< halfway between the two surfaces [m, W]
    double distance;  ///< along the normal [m]; negative = overlap
};

/// All points in which two convex shapes touch; they share one normal.
struct Manifold {
    static constexpr std::size_t capacity = 16;

    Vec3 normal = Vec3::UnitX();  ///< unit, from B to A, W
    std::size_t size = 0;
    std::array<ManifoldPoint, capacity> points;

    /// @pre size < capacity
    void add(const Vec3& point, double distance) {
        assert(size < capacity);
        points[size++] = {point, distance};
    }
};

/// Finds the contact of two posed shapes.
/// @param shape_a, pose_a body A and its frame in W; @param shape_b, pose_b body B
/// @param margin points are reported up to this distance [m], ≥ 0
/// @param manifold its size is 0 where the shapes are farther apart than the margin
/// Swapping A and B gives the same points with the opposite normal. Any pose gives finite numbers.
/// Two half-spaces never touch (both are fixed).
void collide(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b, const Pose& pose_b, double margin,
             Manifold& manifold);

}  // namespace cairn
