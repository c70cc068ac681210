#include <algorithm>
#include <cmath>

#include "math/tolerances.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

namespace {

/// The centre is inside the cylinder: out through the nearest of its side and caps.
void inside(const Vec3& centre, const Cylinder& b, double radius, const Pose& pose_b, Manifold& manifold) {
    const double across = centre.head<2>().norm();
    const double from_side = b.radius - across;
    const double from_cap = 0.5 * b.length - std::abs(centre.z());
    Vec3 normal = std::copysign(1.0, centre.z()) * Vec3::UnitZ();
    if (from_side < from_cap) {
        normal = across > 0 ? Vec3(centre.x() / across, centre.y() / across, 0) : Vec3(Vec3::UnitX());
    }
    const double depth = std::min(from_side, from_cap);
    manifold.normal = pose_b.orientation * normal;
    manifold.add(pose_b.toOuter(centre + 0.5 * (depth - radius) * normal), -depth - radius);
}

}  // namespace

void sphereCylinder(const Sphere& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b, double margin,
                    Manifold& manifold) {
    const double half = 0.5 * b.length;
    const Vec3 centre = pose_b.toInner(pose_a.position);
    if (!(centre.cwiseAbs().maxCoeff() <= a.radius + margin + b.radius + half)) return;
    const double across = centre.head<2>().norm();
    Vec3 nearest(centre.x(), centre.y(), std::clamp(centre.z(), -half, half));
    if (across > b.radius) nearest.head<2>() *= b.radius / across;
    const Vec3 outward = centre - nearest;
    const double squared = outward.squaredNorm();
    const double reach = a.radius + margin;
    if (!(squared <= reach * reach)) return;
    const double outside = std::sqrt(squared);
    // So close to the surface rounding decides on the direction.
    if (outside <= tiny_part * (b.radius + half)) return inside(centre, b, a.radius, pose_b, manifold);
    const Vec3 normal = outward / outside;
    const double distance = outside - a.radius;
    manifold.normal = pose_b.orientation * normal;
    manifold.add(pose_b.toOuter(nearest + 0.5 * distance * normal), distance);
}

}  // namespace cairn
