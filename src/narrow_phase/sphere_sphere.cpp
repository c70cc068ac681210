#include <cmath>

#include "math/tolerances.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

void sphereSphere(const Sphere& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b, double margin,
                  Manifold& manifold) {
    const Vec3 from_b = pose_a.position - pose_b.position;
    const double reach = a.radius + b.radius + margin;
    const double squared = from_b.squaredNorm();
    if (!(squared <= reach * reach)) return;
    const double centres = std::sqrt(squared);
    // Coincident centres: every direction is as good, so up it is.
    manifold.normal = centres > tiny_part * (a.radius + b.radius) ? Vec3(from_b / centres) : Vec3::UnitZ();
    const double distance = centres - a.radius - b.radius;
    manifold.add(pose_a.position - (a.radius + 0.5 * distance) * manifold.normal, distance);
}

}  // namespace cairn
