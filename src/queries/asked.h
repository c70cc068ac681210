/// @file Checks of what questions are asked with.
#pragma once

#include "cairn/query.h"

namespace cairn {

/// Farthest from the origin that something asked about may be [m].
inline constexpr double query_limit = 1e12;

/// A ray with a unit direction. @throws InputError for a ray that is not finite or has no direction
Ray checkedRay(const Ray& ray);
/// A way as a ray from the origin of W that is as long. @throws InputError if it is not finite or zero
Ray checkedWay(const Vec3& way);
/// A pose with a unit quaternion. @throws InputError
Pose checkedPose(const Pose& pose);
/// A shape whose parts have unit quaternions. @throws InputError as validateShape()
Shape checkedShape(const Shape& shape);
/// @param what names it @throws InputError unless it is ≥ 0 [m]
void requireReach(double reach, std::string_view what);

}  // namespace cairn
