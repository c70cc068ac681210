/// @file Concave solids: a closed surface of triangles as a compound of convex parts.
#pragma once

#include "cairn/shape.h"
#include "cairn/types.h"

namespace cairn {

/// How finely a solid is divided.
struct DecompositionOptions {
    /// By how much the volumes of the parts together may exceed that of the mesh, as a part of it; 0 to 1. 0 divides
    /// until all parts are convex, which meshes with curved hollows are not before there are `most_parts`.
    double largest_error = 0.02;
    int most_parts = 64;        ///< which comes before the error; 1 to 1000
    bool hull_if_open = false;  ///< takes the hull of a mesh that is not watertight, which is refused otherwise
};

/// A solid in convex parts, and how well they fit.
struct Decomposition {
    Compound compound;        ///< of hulls, in the frame of the mesh, with the mass, centre and inertia of the mesh
    double volume = 0;        ///< of the mesh [m³]; where it is taken as its hull, that of the hull
    double parts_volume = 0;  ///< of all parts; where two overlap it counts twice [m³]
    double error = 0;         ///< parts_volume beyond the volume, as a part of it
    bool turned = false;      ///< the mesh was inside out: all of its triangles were turned
    bool took_hull = false;   ///< the mesh is not watertight
};

/// Divides the solid inside a mesh into convex parts, which leave out nothing of it. Planes cut it, through edges that
/// stand back and across its axes, each as it lowers the error most; then parts whose common hull fits are joined. The
/// same input gives the same parts. A surface that passes through itself counts what it encloses twice twice.
/// @param mesh its triangles counter-clockwise seen from outside, or all clockwise; cavities and several pieces are
/// allowed; `sides` do not matter
/// @throws InputError if the mesh is not watertight: it names the number of open edges, that of the holes and the place
/// of the first; for one that encloses no volume, or is inside out in parts; for options out of range
/// @source Chazelle 1984, doi:10.1137/0213031 (cuts through notches); Mamou 2016, Volumetric hierarchical approximate
/// convex decomposition (search over planes, balance, joining); Wei et al. 2022, doi:10.1145/3528223.3530103
/// (cutting the mesh itself). The measure, volumes of unions of edges without triangulation, is our own.
Decomposition decompose(const Mesh& mesh, const DecompositionOptions& options = {});

/// By how much the volumes of all parts exceed that of the solid they stand for, as a part of it.
/// @return 0 for a compound without `solid` @throws InputError as World::addBody for a wrong shape
double volumeErrorOf(const Compound& compound);

}  // namespace cairn
