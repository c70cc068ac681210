#include "narrow_phase/features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "narrow_phase/pair_random.h"

namespace cairn::testing {
namespace {

ConvexPolygon square(double half) {
    ConvexPolygon polygon;
    polygon.add({-half, -half, 0});
    polygon.add({half, -half, 0});
    polygon.add({half, half, 0});
    polygon.add({-half, half, 0});
    return polygon;
}

/// By a grid over both parameters that shrinks around its best point.
double closestByGrid(const Segment& a, const Segment& b) {
    double s = 0;
    double t = 0;
    double best = (a.at(s) - b.at(t)).norm();
    for (double step = 0.25; step > 1e-12; step *= 0.7) {
        const double centre_s = s;
        const double centre_t = t;
        for (int i = -4; i <= 4; ++i) {
            for (int k = -4; k <= 4; ++k) {
                const double p = std::clamp(centre_s + i * step, -1.0, 1.0);
                const double q = std::clamp(centre_t + k * step, -1.0, 1.0);
                const double distance = (a.at(p) - b.at(q)).norm();
                if (distance >= best) continue;
                best = distance;
                s = p;
                t = q;
            }
        }
    }
    return best;
}

TEST(Features, ClosestPointsOfSegmentsAreThoseOfASearch) {
    Random random(31);
    for (int i = 0; i < 300; ++i) {
        const Segment a{random.vector(1), random.vector(1)};
        Segment b{random.vector(1), random.vector(1)};
        if (random.below(3) == 0) b.half = random.uniform(-1, 1) * a.half;
        const SegmentParameters closest = closestOnSegments(a, b);
        ASSERT_LE(std::abs(closest.a), 1);
        ASSERT_LE(std::abs(closest.b), 1);
        ASSERT_NEAR((a.at(closest.a) - b.at(closest.b)).norm(), closestByGrid(a, b), 1e-6) << i;
    }
}

TEST(Features, TheClosestPointOfASegmentIsClampedToItsEnds) {
    const Segment segment{{1, 0, 0}, {2, 0, 0}};
    EXPECT_EQ(closestOnSegment(segment, {2, 5, 0}), 0.5);
    EXPECT_EQ(closestOnSegment(segment, {9, 5, 0}), 1);
    EXPECT_EQ(closestOnSegment(segment, {-9, 5, 0}), -1);
    EXPECT_EQ(closestOnSegment({{1, 0, 0}, {0, 0, 0}}, {2, 5, 0}), 0);
}

TEST(Features, ClippingCutsCornersAndKeepsWhatIsInside) {
    ConvexPolygon polygon = square(1);
    clip(polygon, {Vec3::UnitX(), 2}, 0);
    EXPECT_EQ(polygon.size, 4U);
    clip(polygon, {Vec3(1, 1, 0).normalized(), 1 / std::sqrt(2.0)}, 0);
    ASSERT_EQ(polygon.size, 5U);
    EXPECT_TRUE(polygon.corners[2].isApprox(Vec3(1, 0, 0)));
    EXPECT_TRUE(polygon.corners[3].isApprox(Vec3(0, 1, 0)));
    clip(polygon, {Vec3::UnitX(), -2}, 0);
    EXPECT_EQ(polygon.size, 0U);
}

TEST(Features, ClippingDoesNotSplitACornerWithinTheSlack) {
    ConvexPolygon polygon = square(1);
    clip(polygon, {Vec3(1, 1, 0).normalized(), std::sqrt(2.0) - 1e-12}, 1e-9);
    EXPECT_EQ(polygon.size, 4U);
}

TEST(Features, SimplifyingDropsCornersOfStraightEdgesOnly) {
    ConvexPolygon polygon = square(1);
    polygon.add({-1 - 1e-7, 0, 0});
    simplify(polygon, {Vec3::UnitZ(), 0}, 1e-6);
    EXPECT_EQ(polygon.size, 4U);
    polygon.add({-1.1, 0, 0});
    simplify(polygon, {Vec3::UnitZ(), 0}, 1e-6);
    EXPECT_EQ(polygon.size, 5U);
}

TEST(Features, TheLowerOfTwoPointsOnTopOfEachOtherIsKept) {
    FacePoints points;
    const FaceCollector collector{{Vec3::UnitZ(), 0}, 0.1, 1e-3};
    collector.add({0, 0, -0.1}, points);
    collector.add({5e-4, 0, -0.2}, points);
    collector.add({2e-3, 0, -0.1}, points);
    collector.add({1, 0, 0.2}, points);
    ASSERT_EQ(points.size, 2U);
    EXPECT_EQ(points.points[0].height, -0.2);
    EXPECT_EQ(points.points[1].point.x(), 2e-3);
}

}  // namespace
}  // namespace cairn::testing
