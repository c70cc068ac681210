/// @file Points and features of triangles, for the contacts of surfaces.
#pragma once

#include <array>
#include <vector>

#include "geometry/surface_data.h"
#include "narrow_phase/narrow_phase.h"

namespace cairn {

using FacePointList = std::vector<ManifoldPoint>;

/// Whether a segment passes through a box.
bool meetsSegment(const Bounds& box, const Vec3& begin, const Vec3& end);

/// The corner or edge of a triangle that a point of it is at. @param tolerance [m]
TriangleFeature featureAt(const std::array<Vec3, 3>& corners, const Vec3& point, double tolerance);

/// Adds a point unless one of the others is as near as this [m]; of the two the deeper one stays.
void addApart(FacePointList& points, const ManifoldPoint& point, double together);

/// Keeps the corners of the polygon around points of one plane, and the deepest point, at most as many as a manifold
/// takes. @param tolerance by which a corner may stand out and is none [m]
void keepOutermost(FacePointList& points, const Vec3& normal, double tolerance);

}  // namespace cairn
