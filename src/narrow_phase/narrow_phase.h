/// @file Where two shapes touch: the contact manifold of a pair, from a table of one tester per pair of shapes.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "cairn/shape.h"
#include "geometry/geometry.h"
#include "narrow_phase/near_parts.h"
#include "parallel/function_ref.h"

namespace cairn {

/// One point of a manifold.
struct ManifoldPoint {
    Vec3 point;                  ///< halfway between the two surfaces [m, W]
    double distance;             ///< along the normal [m]; negative = overlap
    std::uint32_t triangle = 0;  ///< that it is on, where one shape is a surface
};

/// All points in which two convex shapes touch; they share one normal.
struct Manifold {
    static constexpr std::size_t capacity = 16;

    Vec3 normal = Vec3::UnitX();  ///< unit, from B to A, W
    std::size_t size = 0;
    std::array<ManifoldPoint, capacity> points;

    /// @pre size < capacity
    void add(const Vec3& point, double distance, std::uint32_t triangle = 0) {
        assert(size < capacity);
        points[size++] = {point, distance, triangle};
    }
};

/// Finds the contact of two posed shapes.
/// @param shape_a, pose_a body A and its frame in W; @param shape_b, pose_b body B
/// @param margin points are reported up to this distance [m], ≥ 0
/// @param manifold its size is 0 where the shapes are farther apart than the margin
/// Swapping A and B gives the same points with the opposite normal. Any pose gives finite numbers.
/// Two half-spaces never touch (both are fixed).
/// @pre neither is a compound, whose parts meet others one by one, or a surface (forEachManifold)
void collide(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b, const Pose& pose_b, double margin,
             Manifold& manifold);

/// A shape and a surface, in this order.
struct SurfacePair {
    const Shape& shape;  ///< solid and no compound
    Pose pose;
    const SurfaceData& surface;
    Pose surface_pose;
};

/// Finds all contacts of a solid shape with a surface: one manifold per face of coplanar triangles, as with the plane
/// of the face, and those with edges and corners that stand out. Inner edges that are flat or concave touch nothing.
/// @param use is called with each manifold; its normal points to the shape
void collideSurface(const SurfacePair& pair, double margin, FunctionRef<void(Manifold&)> use);

/// As collideSurface() for each part of a compound that has a tree, in the order of the parts, of which only those near
/// triangles are looked at.
/// @param pose of the compound's frame in W @param surface_pose likewise
void collideParts(const Compound& compound, const Pose& pose, const SurfaceData& surface, const Pose& surface_pose,
                  double margin, FunctionRef<void(Manifold&)> use);

/// As collide(), for any two shapes: finds the contacts of all parts of compounds and with surfaces. Two surfaces, and
/// surfaces and half-spaces, never touch.
/// @param manifold for use in between @param use is called with each manifold that is not empty
template <class Use>
void forEachManifold(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b, const Pose& pose_b, double margin,
                     Manifold& manifold, const Use& use) {
    const SurfaceData* surface_a = surfaceOf(shape_a);
    const SurfaceData* surface_b = surfaceOf(shape_b);
    const auto useTurned = [&](Manifold& found) {
        found.normal = -found.normal;
        use(std::as_const(found));
    };
    const auto useAsFound = [&](Manifold& found) { use(std::as_const(found)); };
    if (std::holds_alternative<Compound>(shape_a)) {
        const Compound& compound = *std::get_if<Compound>(&shape_a);
        if (surface_b != nullptr && compound.tree) {
            return collideParts(compound, pose_a, *surface_b, pose_b, margin, useAsFound);
        }
        const Bounds other = boundsOf(shape_b, pose_b);
        const NearParts near(compound, pose_a, shape_b, pose_b, other, margin);
        for (std::size_t i = 0; i < near.count(); ++i) {
            const CompoundPart& part = compound.parts[near[i]];
            const Pose pose = pose_a.toOuter(part.pose);
            if (!boundsOf(part.shape, pose).grown(margin).overlaps(other)) continue;
            forEachManifold(part.shape, pose, shape_b, pose_b, margin, manifold, use);
        }
    } else if (std::holds_alternative<Compound>(shape_b)) {
        const Compound& compound = *std::get_if<Compound>(&shape_b);
        if (surface_a != nullptr && compound.tree) {
            return collideParts(compound, pose_b, *surface_a, pose_a, margin, useTurned);
        }
        const Bounds other = boundsOf(shape_a, pose_a).grown(margin);
        const NearParts near(compound, pose_b, shape_a, pose_a, other, margin);
        for (std::size_t i = 0; i < near.count(); ++i) {
            const CompoundPart& part = compound.parts[near[i]];
            const Pose pose = pose_b.toOuter(part.pose);
            if (!boundsOf(part.shape, pose).overlaps(other)) continue;
            forEachManifold(shape_a, pose_a, part.shape, pose, margin, manifold, use);
        }
    } else if (surface_b != nullptr) {
        if (isSolid(shape_a)) collideSurface({shape_a, pose_a, *surface_b, pose_b}, margin, useAsFound);
    } else if (surface_a != nullptr) {
        if (isSolid(shape_b)) collideSurface({shape_b, pose_b, *surface_a, pose_a}, margin, useTurned);
    } else {
        collide(shape_a, pose_a, shape_b, pose_b, margin, manifold);
        if (manifold.size > 0) use(manifold);
    }
}

}  // namespace cairn
