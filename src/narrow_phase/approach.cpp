#include "narrow_phase/approach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/rotation.h"
#include "narrow_phase/convex.h"

namespace cairn {

namespace {

/// Rounds after which steps follow, and most of these.
constexpr int most_rounds = 24;
constexpr int most_steps = 64;

/// How often the step in which they get so deep is halved.
constexpr int most_halvings = 6;

/// They are as deep as asked for when no more than this part of the depth is missing.
constexpr double depth_tolerance = 1e-2;

double depthAfter(const MovingShape& a, const MovingShape& b, double time) {
    return overlapDepth(a.shape, a.poseAfter(time), b.shape, b.poseAfter(time));
}

/// As timeOfOverlap(), in steps. @param begin when they are not that deep [s]
std::optional<double> timeBySteps(const MovingShape& a, const MovingShape& b, double begin, double time, double depth) {
    const double way = ((b.v - a.v).norm() + a.turning + b.turning) * (time - begin);
    const double thick = std::min(smallestRadius(a.shape), smallestRadius(b.shape));
    const double steps = std::clamp(std::ceil(way / thick), 1.0, static_cast<double>(most_steps));
    double before = begin;
    for (double k = 1; k <= steps; ++k) {
        double after = begin + (time - begin) * k / steps;
        if (!(depthAfter(a, b, after) > depth)) {
            before = after;
            continue;
        }
        for (int n = 0; n < most_halvings; ++n) {
            const double between = (before + after) / 2;
            (depthAfter(a, b, between) > depth ? after : before) = between;
        }
        return before;
    }
    return {};
}

bool isConvexSolid(const Shape& shape) {
    return !std::holds_alternative<Compound>(shape) && !std::holds_alternative<HalfSpace>(shape) &&
           surfaceOf(shape) == nullptr;
}

/// How far apart two convex solids are along the unit direction from B to A after a time [m].
double gapAlong(const Vec3& normal, const MovingShape& a, const MovingShape& b, double time) {
    const Vec3 origin = a.centre;
    const Convex shape_a = convexOf(a.shape, a.poseAfter(time), origin);
    const Convex shape_b = convexOf(b.shape, b.poseAfter(time), origin);
    return normal.dot(shape_a.support(-normal) - shape_b.support(normal)) - shape_a.rounding() - shape_b.rounding();
}

/// For how long from a time on two convex solids surely are no deeper in each other than asked for, by how far apart
/// they are along a direction at the beginning and the end: points that turn leave the line between the two by no more
/// than an eighth of their largest acceleration times the square of the time.
/// @param left [s]
double safeAlong(const Vec3& normal, const MovingShape& a, const MovingShape& b, double now, double left,
                 double depth) {
    const double missing = gapAlong(normal, a, b, now) + depth;
    if (!(missing > 0)) return 0;
    const double bend = (a.w.norm() * a.turning + b.w.norm() * b.turning) / 8;
    const double time = bend * left * left > missing / 2 ? std::sqrt(missing / (2 * bend)) : left;
    const double aside = bend * time * time;
    const double missing_then = gapAlong(normal, a, b, now + time) + depth;
    if (missing_then >= aside) return time;
    return time * (missing - aside) / (missing - missing_then);
}

}  // namespace

Pose MovingShape::poseAfter(double time) const {
    if (time == 0) return pose;
    const Quat turn = fromRotationVector(w * time);
    return {centre + v * time + turn * (pose.position - centre), (turn * pose.orientation).normalized()};
}

double overlapDepth(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
    Manifold manifold;
    double depth = 0;
    const auto look = [&](const Manifold& found) {
        for (std::size_t i = 0; i < found.size; ++i) depth = std::max(depth, -found.points[i].distance);
    };
    forEachManifold(a, pose_a, b, pose_b, 0, manifold, look);
    return depth;
}

std::optional<double> timeOfOverlap(const MovingShape& a, const MovingShape& b, double time, double depth) {
    const Vec3 approach = b.v - a.v;  // along the normal, which points from B to A, they close with n·approach
    const double turning = a.turning + b.turning;
    const double fastest = approach.norm() + turning;
    const bool convex = isConvexSolid(a.shape) && isConvexSolid(b.shape);
    Vec3 normal = Vec3::UnitZ();
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
            normal = found.normal;
            const double closing = found.normal.dot(approach) + turning;
            if (closing > 0) safe = std::min(safe, missing / closing);
        };
        forEachManifold(a.shape, a.poseAfter(now), b.shape, b.poseAfter(now), fastest * left, manifold, look);
        if (deep) return now;
        if (!(safe < left)) return {};
        if (convex) safe = std::max(safe, safeAlong(normal, a, b, now, left, depth));
        if (!(safe < left)) return {};
        now += safe;
    }
    return timeBySteps(a, b, now, time, depth);
}

}  // namespace cairn
