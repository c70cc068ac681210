#include "narrow_phase/approach.h"

#include <algorithm>
#include <limits>

#include "math/rotation.h"

namespace cairn {

namespace {

/// Rounds after which two shapes count as overlapping.
constexpr int most_rounds = 24;

/// They are as deep as asked for when no more than this part of the depth is missing.
constexpr double depth_tolerance = 1e-2;

}  // namespace

Pose MovingShape::poseAfter(double time) const {
    if (time == 0) return pose;
    const Quat turn = fromRotationVector(w * time);
    return {centre + v * time + turn * (pose.position - centre), (turn * pose.orientation).normalized()};
}

std::optional<double> timeOfOverlap(const MovingShape& a, const MovingShape& b, double time, double depth) {
    const Vec3 approach = b.v - a.v;  // along the normal, which points from B to A, they close with n·approach
    const double turning = a.turning + b.turning;
    const double fastest = approach.norm() + turning;
    Manifold manifold;
    double now = 0;
    for (int round = 0; round < most_rounds; ++round) {
        const double left = time - now;
        double safe = std::numeric_limits<double>::infinity();
        bool deep = false;
        const auto look = [&](const Manifold& found) {
            double distance = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < found.size; ++i) distance = std::min(distance, found.points[i].distance);
            const double missing = distance + depth;
            deep = deep || missing <= depth_tolerance * depth;
            const double closing = found.normal.dot(approach) + turning;
            if (closing > 0) safe = std::min(safe, missing / closing);
        };
        forEachManifold(a.shape, a.poseAfter(now), b.shape, b.poseAfter(now), fastest * left, manifold, look);
        if (deep) return now;
        if (!(safe < left)) return {};
        now += safe;
    }
    return now;
}

}  // namespace cairn
