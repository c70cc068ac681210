#include <cmath>

#include "math/tolerances.h"
#include "narrow_phase/features.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

void sphereCapsule(const Sphere& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b, double margin,
                   Manifold& manifold) {
    const Vec3 from_b = pose_a.position - pose_b.position;
    const Vec3 axis = pose_b.orientation * Vec3::UnitZ();
    const Segment segment{Vec3::Zero(), 0.5 * b.length * axis};
    const Vec3 outward = from_b - segment.at(closestOnSegment(segment, from_b));
    const double reach = a.radius + b.radius + margin;
    const double squared = outward.squaredNorm();
    if (!(squared <= reach * reach)) return;
    const double outside = std::sqrt(squared);
    // A centre on the axis leaves sideways.
    const bool on_axis = outside <= tiny_part * (b.radius + b.length);
    manifold.normal = on_axis ? axis.unitOrthogonal() : Vec3(outward / outside);
    const double distance = outside - a.radius - b.radius;
    manifold.add(pose_a.position - (a.radius + 0.5 * distance) * manifold.normal, distance);
}

}  // namespace cairn
