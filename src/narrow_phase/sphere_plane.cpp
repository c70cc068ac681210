#include "geometry/half_space.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

void sphereHalfSpace(const Sphere& a, const Pose& pose_a, const HalfSpace& b, const Pose& pose_b, double margin,
                     Manifold& manifold) {
    const Vec3 normal = pose_b.orientation * unitNormal(b);
    const double distance = normal.dot(pose_a.position - pose_b.position) - b.offset - a.radius;
    if (!(distance <= margin)) return;
    manifold.normal = normal;
    manifold.add(pose_a.position - (a.radius + 0.5 * distance) * normal, distance);
}

}  // namespace cairn
