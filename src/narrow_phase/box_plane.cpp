#include "geometry/half_space.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

void boxHalfSpace(const Box& a, const Pose& pose_a, const HalfSpace& b, const Pose& pose_b, double margin,
                  Manifold& manifold) {
    const Vec3 normal = pose_b.orientation * unitNormal(b);
    const double centre = normal.dot(pose_a.position - pose_b.position) - b.offset;
    const Mat3 edges = pose_a.orientation.toRotationMatrix() * (0.5 * a.size).asDiagonal();
    const Vec3 rise = edges.transpose() * normal;  // of each half edge
    if (!(centre - rise.cwiseAbs().sum() <= margin)) return;
    manifold.normal = normal;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            for (const double z : {-1.0, 1.0}) {
                const Vec3 corner(x, y, z);
                const double height = centre + rise.dot(corner);
                if (!(height <= margin)) continue;
                manifold.add(pose_a.position + (edges * corner - 0.5 * height * normal), height);
            }
        }
    }
}

}  // namespace cairn
