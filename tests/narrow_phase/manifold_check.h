/// @file What the tests of the narrow phase ask of a manifold.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "narrow_phase/narrow_phase.h"

namespace cairn::testing {

inline Manifold contactOf(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                          double margin = 1e-4) {
    Manifold manifold;
    collide(a, pose_a, b, pose_b, margin, manifold);
    return manifold;
}

inline Pose at(const Vec3& position) {
    return {position, Quat::Identity()};
}

inline Pose at(const Vec3& position, const Vec3& axis, double degrees) {
    return {position, Quat(Eigen::AngleAxisd(degrees / 180 * std::numbers::pi, axis.normalized()))};
}

inline double deepest(const Manifold& manifold) {
    double result = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < manifold.size; ++i) result = std::min(result, manifold.points[i].distance);
    return result;
}

/// Whether the points are those given, in any order, within a tolerance.
inline ::testing::AssertionResult hasPoints(const Manifold& manifold, std::vector<Vec3> expected,
                                            double tolerance = 1e-12) {
    if (manifold.size != expected.size()) {
        return ::testing::AssertionFailure() << manifold.size << " points in place of " << expected.size();
    }
    for (std::size_t i = 0; i < manifold.size; ++i) {
        const Vec3& p = manifold.points[i].point;
        const auto found =
            std::find_if(expected.begin(), expected.end(), [&](const Vec3& q) { return (p - q).norm() <= tolerance; });
        if (found == expected.end()) return ::testing::AssertionFailure() << "unexpected point " << p.transpose();
        expected.erase(found);
    }
    return ::testing::AssertionSuccess();
}

/// Whether a manifold has this normal and all its points this distance.
inline ::testing::AssertionResult touches(const Manifold& manifold, const Vec3& normal, double distance,
                                          double tolerance = 1e-12) {
    if (manifold.size == 0) return ::testing::AssertionFailure() << "no contact";
    if ((manifold.normal - normal).norm() > tolerance) {
        return ::testing::AssertionFailure() << "normal " << manifold.normal.transpose();
    }
    for (std::size_t i = 0; i < manifold.size; ++i) {
        if (std::abs(manifold.points[i].distance - distance) > tolerance) {
            return ::testing::AssertionFailure() << "distance " << manifold.points[i].distance << " of point " << i;
        }
    }
    return ::testing::AssertionSuccess();
}

}  // namespace cairn::testing
