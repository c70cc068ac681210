#include <algorithm>
#include <cmath>

#include "narrow_phase/features.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

namespace {

/// sin² of the largest angle between axes that can touch along a line.
constexpr double parallel_sine_squared = 0.01;

/// Two capsules about A's centre.
struct CapsulePair {
    Segment a;
    Segment b;
    double radius_a;
    double radius_b;
    double margin;
    Vec3 origin;  ///< [m, W]
};

/// The direction from B's axis to A's where they are closest.
Vec3 normalOf(const CapsulePair& pair, const Vec3& apart, double centres) {
    const double size = pair.a.half.norm() + pair.b.half.norm();
    // Crossing axes leave rounding only; the way out is then perpendicular to both.
    if (centres > 1e-10 * size) return apart / centres;
    const Vec3 across = pair.a.half.cross(pair.b.half);
    const double sine = across.norm();
    if (sine > 1e-7 * pair.a.half.norm() * pair.b.half.norm()) return across / sine;
    return pair.a.half.unitOrthogonal();
}

void addPoint(const CapsulePair& pair, const Vec3& on_a, const Vec3& on_b, Manifold& manifold) {
    const Vec3& n = manifold.normal;
    const double distance = (on_a - on_b).dot(n) - pair.radius_a - pair.radius_b;
    manifold.add(pair.origin + 0.5 * (on_a + on_b + (pair.radius_b - pair.radius_a) * n), distance);
}

/// Nearly parallel capsules touch at both ends of the part where they lie side by side, if both ends are within the
/// margin. @return whether they are
bool addParallel(const CapsulePair& pair, Manifold& manifold) {
    const double length_squared = pair.a.half.squaredNorm();
    const Vec3 across = pair.a.half.cross(pair.b.half);
    if (across.squaredNorm() > parallel_sine_squared * length_squared * pair.b.half.squaredNorm()) return false;
    const double middle = pair.a.half.dot(pair.b.centre - pair.a.centre) / length_squared;
    const double reach = std::abs(pair.a.half.dot(pair.b.half)) / length_squared;
    const double lower = std::max(-1.0, middle - reach);
    const double upper = std::min(1.0, middle + reach);
    const double shorter = std::min(pair.a.half.norm(), pair.b.half.norm());
    if ((upper - lower) * pair.a.half.norm() <= 2 * merge_part * shorter) return false;
    const Vec3 a[2] = {pair.a.at(lower), pair.a.at(upper)};
    const Vec3 b[2] = {pair.b.at(closestOnSegment(pair.b, a[0])), pair.b.at(closestOnSegment(pair.b, a[1]))};
    const double limit = pair.radius_a + pair.radius_b + pair.margin;
    if ((a[0] - b[0]).squaredNorm() > limit * limit || (a[1] - b[1]).squaredNorm() > limit * limit) return false;
    addPoint(pair, a[0], b[0], manifold);
    addPoint(pair, a[1], b[1], manifold);
    return true;
}

}  // namespace

void capsuleCapsule(const Capsule& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b, double margin,
                    Manifold& manifold) {
    const Vec3 from_a = pose_b.position - pose_a.position;
    const double limit = a.radius + b.radius + margin;
    const double farthest = limit + 0.5 * (a.length + b.length);
    if (!(from_a.squaredNorm() <= farthest * farthest)) return;
    const CapsulePair pair{{Vec3::Zero(), 0.5 * a.length * (pose_a.orientation * Vec3::UnitZ())},
                           {from_a, 0.5 * b.length * (pose_b.orientation * Vec3::UnitZ())},
                           a.radius,
                           b.radius,
                           margin,
                           pose_a.position};
    const SegmentParameters closest = closestOnSegments(pair.a, pair.b);
    const Vec3 on_a = pair.a.at(closest.a);
    const Vec3 on_b = pair.b.at(closest.b);
    const double squared = (on_a - on_b).squaredNorm();
    if (!(squared <= limit * limit)) return;
    manifold.normal = normalOf(pair, on_a - on_b, std::sqrt(squared));
    if (!addParallel(pair, manifold)) addPoint(pair, on_a, on_b, manifold);
}

}  // namespace cairn
