/// @file The triangles of a mesh or height field, and how they lie beside each other.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/bounds_tree.h"
#include "geometry/geometry.h"

namespace cairn {

/// The plane of neighbouring triangles that lie in one.
struct SurfaceFace {
    Vec3 normal;    ///< unit, outward
    double offset;  ///< of the plane from the origin along the normal [m]

    double height(const Vec3& p) const { return normal.dot(p) - offset; }
};

/// A surface of triangles in its own frame; never changes once it is built.
struct SurfaceData {
    static constexpr std::uint32_t none = UINT32_MAX;

    std::vector<Vec3> vertices;              ///< all of them corners, at different places [m]
    std::vector<TriangleCorners> triangles;  ///< counter-clockwise seen from outside
    std::vector<TriangleCorners> across;     ///< the triangle beyond the edge from each corner to the next, or none
    std::vector<std::uint32_t> face_of;      ///< of each triangle, in faces
    std::vector<SurfaceFace> faces;
    std::vector<std::uint32_t> fan_begin;  ///< of each vertex in fans, and the end of the last
    std::vector<std::uint32_t> fans;       ///< triangles around each vertex, ascending
    BoundsTree tree;                       ///< over the triangles
    SurfaceSides sides = SurfaceSides::one;
    SurfaceRepairs repairs{};
    Vec3 lower, upper;  ///< of all vertices [m]
    double radius = 0;  ///< largest distance of a vertex from the origin [m]

    const Vec3& corner(std::uint32_t triangle, std::size_t k) const { return vertices[triangles[triangle][k]]; }
    std::array<Vec3, 3> corners(std::uint32_t triangle) const {
        return {corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)};
    }
    Bounds boundsOf(std::uint32_t triangle) const {
        const auto [a, b, c] = corners(triangle);
        return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
    }
    const SurfaceFace& face(std::uint32_t triangle) const { return faces[face_of[triangle]]; }
    std::span<const std::uint32_t> fan(std::uint32_t vertex) const {
        return std::span(fans).subspan(fan_begin[vertex], fan_begin[vertex + 1] - fan_begin[vertex]);
    }
    /// Whether the edge from corner k to the next bounds its face.
    bool isBorder(std::uint32_t triangle, std::size_t k) const {
        const std::uint32_t other = across[triangle][k];
        return other == none || face_of[other] != face_of[triangle];
    }
    std::size_t bytes() const;
};

/// @throws InputError as Mesh
SurfaceData buildSurface(std::vector<Vec3> vertices, std::vector<TriangleCorners> triangles, SurfaceSides sides);

/// The nearest triangle that a ray meets; of equally near ones the first. Edges have no gaps.
/// @source Woop, Benthin, Wald 2013, Watertight Ray/Triangle Intersection, jcgt.org/published/0002/01/05
std::optional<LocalHit> castRay(const SurfaceData& surface, const LocalRay& ray, double reach);
/// The same for one of its triangles.
std::optional<LocalHit> castRayAt(const SurfaceData& surface, std::uint32_t triangle, const LocalRay& ray);

/// A part of a triangle: its inside, the edge from corner `index` to the next, or that corner.
struct TriangleFeature {
    enum class Kind : std::uint8_t { inside, edge, corner };

    Kind kind = Kind::inside;
    std::uint8_t index = 0;
};

struct ClosestOnTriangle {
    Vec3 point;
    TriangleFeature feature;
};

/// @source Ericson 2005, Real-Time Collision Detection, §5.1.5
ClosestOnTriangle closestOnTriangle(const std::array<Vec3, 3>& corners, const Vec3& p);

/// Whether a feature lies within its face: no border of the face passes there.
bool isWithinFace(const SurfaceData& surface, std::uint32_t triangle, const TriangleFeature& feature);

/// Whether what touches an edge or a corner of a triangle in a direction is nearer to it than to the triangles beside
/// it: of contacts in other directions a neighbour knows the right one.
/// @param direction unit, from the surface to what touches it @pre no inside
/// @source Bærentzen, Aanæs 2005, doi:10.1109/TVCG.2005.49 (the side of a corner: angle-weighted normals)
bool isOutward(const SurfaceData& surface, std::uint32_t triangle, const TriangleFeature& feature,
               const Vec3& direction);

}  // namespace cairn
