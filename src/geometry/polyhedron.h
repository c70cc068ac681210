/// @file Solids with flat faces of any form, with holes and cavities, that planes cut apart.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cairn/types.h"

namespace cairn {

/// From one point to another, by their indices.
struct PolyhedronEdge {
    std::uint32_t from, to;
};

/// A flat face. Its border is all of its edges in any order, so it may have holes and several pieces.
struct PolyhedronFace {
    Vec3 normal;          ///< unit, outward
    std::uint32_t begin;  ///< of its edges in Polyhedron::edges
    std::uint32_t end;
};

/// A solid as its closed surface: each edge of a face has one that runs against it in another face.
struct Polyhedron {
    std::vector<PolyhedronFace> faces;
    std::vector<PolyhedronEdge> edges;  ///< face after face, counter-clockwise seen from outside

    std::span<const PolyhedronEdge> edgesOf(const PolyhedronFace& face) const {
        return std::span(edges).subspan(face.begin, face.end - face.begin);
    }
    void add(const Vec3& normal, std::span<const PolyhedronEdge> border);
    void add(const Polyhedron& other);
};

struct CuttingPlane {
    Vec3 normal;  ///< unit
    double offset;
};

using Points = std::vector<Vec3>;

/// Sum over the surface with the sign of the orientation, so that what it encloses twice counts twice.
double volumeOf(const Polyhedron& solid, const Points& points);

/// The points that a solid has, ascending.
std::vector<std::uint32_t> pointsOf(const Polyhedron& solid);

/// Cuts a solid; both sides are closed by new faces. @param points those of all solids, to which those of the cut are
/// added
/// @param tolerance points that are nearer to the plane are in it [m]
/// @return what is before the plane, and what is behind it, where the normal points; either may have no faces
std::pair<Polyhedron, Polyhedron> cut(const Polyhedron& solid, const CuttingPlane& plane, double tolerance,
                                      Points& points);

/// The pieces of a solid that hang together, each with its cavities, in the order of their first faces.
/// @param least volume of a shell; smaller ones are left out [m³]
/// @return none where a cavity is in no piece: the surface is inside out there
std::optional<std::vector<Polyhedron>> connectedPieces(const Polyhedron& solid, const Points& points, double least);

/// An edge that stands back, and its faces.
struct ReflexEdge {
    std::uint32_t from, to;
    Vec3 first, second;  ///< normals of the faces
};

/// The edges about which a solid is not convex, those between faces that lie nearly in one plane left out.
std::vector<ReflexEdge> reflexEdges(const Polyhedron& solid, const Points& points);

}  // namespace cairn
