#include "geometry/half_space.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

void capsuleHalfSpace(const Capsule& a, const Pose& pose_a, const HalfSpace& b, const Pose& pose_b, double margin,
                      Manifold& manifold) {
    const Vec3 normal = pose_b.orientation * unitNormal(b);
    const double centre = normal.dot(pose_a.position - pose_b.position) - b.offset;
    const Vec3 half = 0.5 * a.length * (pose_a.orientation * Vec3::UnitZ());
    manifold.normal = normal;
    for (const double end : {-1.0, 1.0}) {
        const double distance = centre + end * normal.dot(half) - a.radius;
        if (!(distance <= margin)) continue;
        manifold.add(pose_a.position + (end * half - (a.radius + 0.5 * distance) * normal), distance);
    }
}

}  // namespace cairn
