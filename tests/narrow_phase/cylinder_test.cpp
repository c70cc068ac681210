#include <cmath>

#include "geometry/geometry.h"
#include "narrow_phase/convex.h"
#include "narrow_phase/manifold_check.h"
#include "narrow_phase/pair_random.h"

namespace cairn::testing {
namespace {

const HalfSpace ground{};

/// The corners of a rim at a height, scaled about the axis.
std::vector<Vec3> rim(double radius, double height) {
    std::vector<Vec3> points;
    for (int i = 0; i < rim_corners; ++i) {
        const Eigen::Vector2d at = radius * rimDirection(i);
        points.emplace_back(at.x(), at.y(), height);
    }
    return points;
}

TEST(CylinderContact, StandsOnEightPointsOfItsRim) {
    const Cylinder cylinder{0.5, 2};
    const Manifold plane = contactOf(cylinder, at({0, 0, 0.99}), ground, at({0, 0, 0}));
    EXPECT_TRUE(touches(plane, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(plane, rim(0.5, -0.005)));
    const Manifold box = contactOf(cylinder, at({0, 0, 1.49}), Box{{3, 3, 1}}, at({0, 0, 0}));
    EXPECT_TRUE(touches(box, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(box, rim(0.5, 0.495)));
    const Manifold other = contactOf(cylinder, at({0, 0, 1.99}), cylinder, at({0, 0, 0}));
    EXPECT_TRUE(touches(other, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(other, rim(0.5, 0.995)));
    const Manifold thinner = contactOf(Cylinder{0.3, 2}, at({0, 0, 1.99}), cylinder, at({0, 0, 0}));
    EXPECT_TRUE(hasPoints(thinner, rim(0.3, 0.995)));
    const Manifold thicker = contactOf(Cylinder{0.7, 2}, at({0, 0, 1.99}), cylinder, at({0, 0, 0}));
    EXPECT_TRUE(hasPoints(thicker, rim(0.5, 0.995)));
}

TEST(CylinderContact, ATiltedOneTouchesWithTheLowestPointOfItsRim) {
    const Cylinder cylinder{0.5, 2};
    for (const double degrees : {0.02, 1.0, 20.0, 44.0, 46.0, 80.0}) {
        const double angle = degrees / 180 * std::numbers::pi;
        for (const double turn : {0.0, 10.0, 22.5, 100.0}) {
            const Vec3 axis(std::cos(turn), std::sin(turn), 0);
            const double lowest = -std::cos(angle) - 0.5 * std::sin(angle);
            const Pose pose = at({0, 0, -lowest - 0.001}, axis, degrees);
            const Manifold plane = contactOf(cylinder, pose, ground, at({0, 0, 0}), 0);
            EXPECT_NEAR(deepest(plane), -0.001, 1e-12) << degrees;
            const Manifold box = contactOf(cylinder, pose, Box{{9, 9, 1}}, at({0, 0, -0.5}), 0);
            EXPECT_NEAR(deepest(box), -0.001, 1e-12) << degrees;
            EXPECT_LE((box.normal - Vec3::UnitZ()).norm(), 1e-12);
        }
    }
}

TEST(CylinderContact, LiesOnTwoPoints) {
    const Cylinder cylinder{0.5, 2};
    const Pose lying = at({0, 0, 0.49}, Vec3::UnitX(), 90);
    const std::vector<Vec3> ends = {{0, -1, -0.005}, {0, 1, -0.005}};
    const Manifold plane = contactOf(cylinder, lying, ground, at({0, 0, 0}));
    EXPECT_TRUE(touches(plane, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(plane, ends));
    const Manifold box = contactOf(cylinder, lying, Box{{3, 3, 1}}, at({0, 0, -0.5}));
    EXPECT_TRUE(touches(box, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(box, ends));
    const Manifold narrow = contactOf(cylinder, lying, Box{{3, 0.6, 1}}, at({0, 0, -0.5}));
    EXPECT_TRUE(touches(narrow, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(narrow, {{0, -0.3, -0.005}, {0, 0.3, -0.005}}));
}

TEST(CylinderContact, RollsWithoutAStep) {
    const Cylinder cylinder{0.5, 2};
    for (int i = 0; i < 360; ++i) {
        const Quat turned = Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX())) *
                            Quat(Eigen::AngleAxisd(i * std::numbers::pi / 180, Vec3::UnitZ()));
        for (const Manifold& m : {contactOf(cylinder, {{0, 0, 0.5}, turned}, ground, at({0, 0, 0})),
                                  contactOf(cylinder, {{0, 0, 0.5}, turned}, Box{{9, 9, 1}}, at({0, 0, -0.5}))}) {
            EXPECT_TRUE(touches(m, Vec3::UnitZ(), 0, 1e-13));
            EXPECT_TRUE(hasPoints(m, {{0, -1, 0}, {0, 1, 0}}, 1e-12)) << i;
        }
    }
}

TEST(CylinderContact, ParallelOnesTouchAlongTheirCommonPart) {
    const Cylinder cylinder{0.5, 2};
    const Manifold m = contactOf(cylinder, at({0.99, 0, 0.5}), cylinder, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitX(), -0.01, 1e-9));
    EXPECT_TRUE(hasPoints(m, {{0.495, 0, 1}, {0.495, 0, -0.5}}, 1e-6));
    const Manifold capsule = contactOf(Capsule{0.25, 1}, at({0.74, 0, 0.1}), cylinder, at({0, 0, 0}));
    EXPECT_TRUE(touches(capsule, Vec3::UnitX(), -0.01, 1e-9));
    EXPECT_TRUE(hasPoints(capsule, {{0.495, 0, 0.6}, {0.495, 0, -0.4}}, 1e-6));
}

TEST(CylinderContact, CrossedOnesTouchInOnePoint) {
    const Cylinder cylinder{0.5, 2};
    const Manifold m =
        contactOf(cylinder, at({0, 0, 0.995}, Vec3::UnitX(), 90), cylinder, at({0, 0, 0}, Vec3::UnitY(), 90));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.005, 1e-5));
    EXPECT_TRUE(hasPoints(m, {{0, 0, 0.4975}}, 1e-4));
}

TEST(CylinderContact, OneThatReachesOverAnEdgeIsCutThere) {
    const Manifold m = contactOf(Cylinder{0.5, 1}, at({0.2, 0, 0.5}), Box{{4, 4, 1}}, at({-2, 0, -0.5}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), 0));
    double farthest = -1;
    for (std::size_t i = 0; i < m.size; ++i) farthest = std::max(farthest, m.points[i].point.x());
    EXPECT_NEAR(farthest, 0, 1e-12);
    EXPECT_GE(m.size, 4U);
}

TEST(CylinderContact, OneThatOverhangsAnotherTouchesWhereBothAre) {
    const Cylinder cylinder{0.5, 1};
    const Manifold m = contactOf(cylinder, at({0.6, 0, 1}), cylinder, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), 0, 1e-12));
    EXPECT_GE(m.size, 4U);
    double lower = 1;
    double upper = -1;
    double widest = 0;
    for (std::size_t i = 0; i < m.size; ++i) {
        const Vec3& p = m.points[i].point;
        EXPECT_LE(p.head<2>().norm(), 0.5 + 1e-3);
        EXPECT_LE((p - Vec3(0.6, 0, 0)).head<2>().norm(), 0.5 + 1e-3);
        lower = std::min(lower, p.x());
        upper = std::max(upper, p.x());
        widest = std::max(widest, p.y());
    }
    EXPECT_NEAR(lower, 0.1, 1e-3);
    EXPECT_NEAR(upper, 0.5, 1e-3);
    EXPECT_NEAR(widest, 0.4, 1e-3) << "the rims cross at y = ±0.4";
}

TEST(SphereCylinder, LeavesThroughCapSideOrRim) {
    const Cylinder cylinder{0.5, 2};
    const auto ball = [&](const Vec3& centre) { return contactOf(Sphere{0.25}, at(centre), cylinder, at({0, 0, 0})); };
    EXPECT_TRUE(touches(ball({0.1, 0.1, 1.24}), Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(touches(ball({0, -0.74, 0.3}), -Vec3::UnitY(), -0.01));
    EXPECT_TRUE(touches(ball({0.5 + 0.6 * 0.24, 0, 1 + 0.8 * 0.24}), Vec3(0.6, 0, 0.8), -0.01));
    EXPECT_TRUE(touches(ball({0, 0, 0.9}), Vec3::UnitZ(), -0.35));
    EXPECT_TRUE(touches(ball({0.45, 0, 0}), Vec3::UnitX(), -0.3));
    EXPECT_TRUE(touches(ball({0, 0, 0}), Vec3::UnitX(), -0.75));
    EXPECT_EQ(ball({0.7, 0, 1.2}).size, 0U);
}

/// The gap between the shadows of two shapes on a line.
double gapAlong(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, const Vec3& n) {
    const Vec3 on_a = pose_a.toOuter(support(a, pose_a.orientation.conjugate() * Vec3(-n)));
    const Vec3 on_b = pose_b.toOuter(support(b, pose_b.orientation.conjugate() * n));
    return (on_a - on_b).dot(n);
}

/// The widest gap that is found from a direction uphill.
double climb(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, Vec3 n, Random& random) {
    double gap = gapAlong(a, pose_a, b, pose_b, n);
    for (double step = 0.3; step > 1e-5;) {
        bool better = false;
        for (int i = 0; i < 12; ++i) {
            const Vec3 other = (n + step * random.direction()).normalized();
            const double wider = gapAlong(a, pose_a, b, pose_b, other);
            if (!(wider > gap)) continue;
            gap = wider;
            n = other;
            better = true;
        }
        if (!better) step *= 0.5;
    }
    return gap;
}

/// The widest gap there is, from some starts.
double widestGap(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, const Vec3& guess,
                 Random& random) {
    double widest = climb(a, pose_a, b, pose_b, guess, random);
    for (int k = 0; k < 5; ++k) widest = std::max(widest, climb(a, pose_a, b, pose_b, random.direction(), random));
    return widest;
}

TEST(CylinderContact, HasTheDepthOfTheLeastTranslation) {
    Random random(41);
    int contacts = 0;
    for (int i = 0; i < 500; ++i) {
        const Cylinder a{random.length(0.5), random.length(1)};
        const Shape b = random.below(2) == 0 ? Shape(Cylinder{random.length(0.5), random.length(1)}) : random.solid(1);
        Pose pose_a{random.vector(0.4), random.orientation()};
        const Pose pose_b{random.vector(0.4),
                          random.below(2) == 0 ? random.orientation() : random.alignedOrientation()};
        const Manifold m = contactOf(a, pose_a, b, pose_b, 0.01);
        if (m.size == 0) continue;
        ++contacts;
        const double gap = widestGap(a, pose_a, b, pose_b, m.normal, random);
        ASSERT_NEAR(gap, deepest(m), 2.5e-3 + 0.05 * std::abs(gap)) << shapeName(b) << ", pose " << i;
        pose_a.position -= deepest(m) * m.normal;
        const double left = widestGap(a, pose_a, b, pose_b, m.normal, random);
        ASSERT_NEAR(left, 0, gap < -0.05 ? 8e-3 : 3e-3) << shapeName(b) << ", pose " << i;
    }
    EXPECT_GT(contacts, 200);
}

TEST(CylinderContact, CapsInEachOtherTouchNowhereDeeperThanAlongTheNormal) {
    Random random(77);
    int several = 0;
    for (int i = 0; i < 20000; ++i) {
        const Cylinder a{random.uniform(0.3, 0.6), random.uniform(0.2, 1)};
        const Cylinder b{random.uniform(0.3, 0.6), random.uniform(0.2, 1)};
        const Pose pose_a = at({0, 0, 0});
        const Vec3 axis = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0).normalized();
        const double depth = random.uniform(0, 0.4) * (a.length + b.length);
        const Pose pose_b =
            at({random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), 0.5 * (a.length + b.length) - depth}, axis,
               random.uniform(0, 6));
        const Manifold found = contactOf(a, pose_a, b, pose_b);
        const bool caps = found.size > 0 && std::abs(found.normal.z()) > 0.9;
        if (!caps) continue;
        several += found.size > 2 ? 1 : 0;
        const auto lowest = [&](const Shape& shape, const Pose& pose, const Vec3& down) {
            return down.dot(pose.position + pose.orientation * support(shape, pose.orientation.conjugate() * down));
        };
        const double along = -lowest(a, pose_a, -found.normal) - lowest(b, pose_b, found.normal);
        // Rims are taken for circles, also seen at the angle between the caps.
        EXPECT_GE(deepest(found), along - 1e-3 * std::max(a.radius, b.radius)) << i;
    }
    EXPECT_GT(several, 10000);
}

TEST(CylinderContact, KeepsTheDistanceOfSeparatedOnes) {
    Random random(42);
    for (int i = 0; i < 500; ++i) {
        const Cylinder a{random.length(0.5), random.length(1)};
        const Shape b = random.solid(1);
        const Pose pose_a{random.vector(0.4), random.orientation()};
        Pose pose_b{pose_a.position + 3 * random.direction(), random.orientation()};
        const double wished = random.uniform(1e-4, 1e-2);
        for (int k = 0; k < 8; ++k) {  // closer and closer along the direction of the contact
            const Manifold m = contactOf(a, pose_a, b, pose_b, 10);
            ASSERT_GT(m.size, 0U);
            pose_b.position += (deepest(m) - wished) * m.normal;
        }
        const Manifold m = contactOf(a, pose_a, b, pose_b, 0.02);
        ASSERT_GT(m.size, 0U);
        ASSERT_NEAR(widestGap(a, pose_a, b, pose_b, -m.normal, random), wished, 3e-3) << shapeName(b) << " " << i;
        ASSERT_NEAR(deepest(m), wished, 3e-3) << shapeName(b) << ", pose " << i;
    }
}

}  // namespace
}  // namespace cairn::testing
