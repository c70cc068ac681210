/// @file The questions about one shape that stands somewhere and may have many parts.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cairn/query.h"
#include "geometry/bounds_tree.h"

namespace cairn {

/// A shape that is asked with.
struct AskedShape {
    const Shape& shape;
    Pose pose;  ///< of its frame in W
};

/// A shape that is asked about.
struct Target {
    const Shape& shape;
    Pose pose;  ///< of its frame in W
};

/// @param ray with a unit direction
std::optional<SurfaceHit> castRayAt(const Target& target, const Ray& ray);
/// Appends where a ray meets each part. @param ray as above
void castRayThrough(const Target& target, const Ray& ray, std::vector<SurfaceHit>& hits);
/// @param direction unit @param reach [m] @pre moving is bounded
std::optional<ShapeHit> castShapeAt(const AskedShape& moving, const Vec3& direction, double reach,
                                    const Target& target);
/// @param parts of the target that have points in common with the shape, ascending
void findOverlaps(const AskedShape& asked, const Target& target, std::vector<std::uint32_t>& parts);
/// @return none beyond the limit [m]
std::optional<ClosestPoints> closestAt(const AskedShape& asked, const Target& target, double limit);

/// @throws InputError for a half-space
void requireBounded(const Shape& moving);
/// @throws InputError for two half-spaces
void requireClosest(const Shape& a, const Shape& b);

}  // namespace cairn
