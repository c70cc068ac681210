/// @file A piece of a solid that is divided into convex parts, and the hull that is to stand for it.
#pragma once

#include "geometry/hull_data.h"
#include "geometry/polyhedron.h"

namespace cairn {

/// Limits that depend on the size of the whole solid.
struct PartScale {
    double tolerance;  ///< points nearer to a plane are in it [m]
    double least;      ///< volume that is nothing [m³]
};

struct ConvexPart {
    Polyhedron solid;
    std::vector<Vec3> corners;  ///< of the hull [m]
    double volume = 0;          ///< of the solid [m³]
    double error = 0;           ///< by which the hull is larger [m³]
    bool is_final = false;      ///< no plane divides it
};

/// The hull of points, of which there may be more than a hull takes. @return none if they are flat
std::optional<HullData> hullOf(std::vector<Vec3> points);

/// Of many points those that are farthest out in a bin of directions, seen from their middle in a frame in which they
/// are as long as they are wide; a few all.
std::vector<Vec3> farthestOf(std::vector<Vec3> points);
/// The volume of a body in the hull of points, whose corners are those farthest along fixed directions: that of the
/// hull or, where it is round, some percent less, at a small part of the cost.
double volumeWithin(const std::vector<Vec3>& points);

/// @return none if the hull is flat: the piece is nothing
std::optional<ConvexPart> makePart(Polyhedron solid, const Points& points);

/// Cuts a part by the plane that leaves the least error.
/// @param points those of all solids, to which those of the cut are added
/// @return the pieces; none if no plane divides it
std::vector<ConvexPart> divide(const ConvexPart& part, const PartScale& scale, Points& points);

/// Joins parts whose common hull is hardly larger, the best pair first, as long as the error of all stays within a
/// limit or there are too many.
/// @param limit of the sum of errors [m³]
void joinParts(std::vector<ConvexPart>& parts, double limit, std::size_t most_parts);

}  // namespace cairn
