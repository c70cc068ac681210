#include <cmath>
#include <numbers>

#include "geometry/half_space.h"
#include "narrow_phase/convex.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

void cylinderHalfSpace(const Cylinder& a, const Pose& pose_a, const HalfSpace& b, const Pose& pose_b, double margin,
                       Manifold& manifold) {
    const Vec3 normal = pose_b.orientation * unitNormal(b);
    const Convex cylinder(a, pose_a, pose_a.position);
    const double centre = normal.dot(pose_a.position - pose_b.position) - b.offset;
    if (!(centre + normal.dot(cylinder.support(-normal)) <= margin)) return;
    Feature feature;
    cylinder.findFeature(-normal, feature);
    manifold.normal = normal;
    for (std::size_t i = 0; i < feature.corners.size; ++i) {
        const Vec3& corner = feature.corners.corners[i];
        const double height = centre + normal.dot(corner);
        if (height <= margin) manifold.add(pose_a.position + (corner - 0.5 * height * normal), height);
    }
}

}  // namespace cairn
