#include <cmath>

#include "math/tolerances.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

namespace {

/// The centre is inside the box: out through the nearest face.
void inside(const Vec3& centre, const Vec3& half, double radius, const Pose& pose_b, Manifold& manifold) {
    Eigen::Index axis = 0;
    const double depth = (half - centre.cwiseAbs()).minCoeff(&axis);
    Vec3 normal = Vec3::Zero();
    normal[axis] = centre[axis] < 0 ? -1 : 1;
    manifold.normal = pose_b.orientation * normal;
    manifold.add(pose_b.toOuter(centre + 0.5 * (depth - radius) * normal), -depth - radius);
}

}  // namespace

void sphereBox(const Sphere& a, const Pose& pose_a, const Box& b, const Pose& pose_b, double margin,
               Manifold& manifold) {
    const Vec3 half = 0.5 * b.size;
    const Vec3 centre = pose_b.toInner(pose_a.position);
    const Vec3 nearest = centre.cwiseMax(-half).cwiseMin(half);
    const Vec3 outward = centre - nearest;
    const double squared = outward.squaredNorm();
    const double reach = a.radius + margin;
    if (!(squared <= reach * reach)) return;
    const double outside = std::sqrt(squared);
    // So close to the surface rounding decides on the direction.
    if (outside <= tiny_part * half.maxCoeff()) return inside(centre, half, a.radius, pose_b, manifold);
    const Vec3 normal = outward / outside;
    const double distance = outside - a.radius;
    manifold.normal = pose_b.orientation * normal;
    manifold.add(pose_b.toOuter(nearest + 0.5 * distance * normal), distance);
}

}  // namespace cairn
