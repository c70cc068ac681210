#include "narrow_phase/manifold_check.h"

namespace cairn::testing {
namespace {

const Capsule capsule{0.5, 2};
const Box box{{6, 4, 2}};

TEST(CapsuleHalfSpace, LyingTouchesWithBothEndsAndStandingWithOne) {
    const Manifold lying = contactOf(capsule, at({0, 0, 0.49}, Vec3::UnitY(), 90), HalfSpace{}, at({0, 0, 0}));
    EXPECT_TRUE(touches(lying, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(lying, {{-1, 0, -0.005}, {1, 0, -0.005}}));
    const Manifold standing = contactOf(capsule, at({0, 0, 1.49}), HalfSpace{}, at({0, 0, 0}));
    EXPECT_TRUE(touches(standing, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(standing, {{0, 0, -0.005}}));
    EXPECT_EQ(contactOf(capsule, at({0, 0, 1.6}), HalfSpace{}, at({0, 0, 0})).size, 0U);
}

TEST(CapsuleCapsule, CrossingTouchesInOnePoint) {
    const Manifold m =
        contactOf(capsule, at({0, 0, 0.98}, Vec3::UnitX(), 90), capsule, at({0.2, 0.3, 0}, Vec3::UnitY(), 90));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.02));
    EXPECT_TRUE(hasPoints(m, {{0, 0.3, 0.49}}));
}

TEST(CapsuleCapsule, ParallelTouchesAtBothEndsOfTheCommonPart) {
    const Manifold m = contactOf(Capsule{0.25, 2}, at({0.74, 0, 0.5}), Capsule{0.5, 3}, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitX(), -0.01));
    EXPECT_TRUE(hasPoints(m, {{0.495, 0, -0.5}, {0.495, 0, 1.5}}));
}

TEST(CapsuleCapsule, AlmostParallelRestingOnesKeepBothPoints) {
    for (const double degrees : {1e-12, 1e-9, 1e-6, 1e-4, 1e-3}) {
        const Manifold m = contactOf(capsule, at({0, 0, 0.9999}, Vec3(1, 0.01, 0), 90 + degrees), capsule,
                                     at({0, 0, 0}, Vec3::UnitX(), 90));
        EXPECT_EQ(m.size, 2U) << degrees;
        EXPECT_NEAR(m.normal.z(), 1, 1e-5);
    }
}

TEST(CapsuleCapsule, EndToEndTouchesInOnePoint) {
    const Manifold m = contactOf(capsule, at({0, 0, 2.99}), capsule, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(m, {{0, 0, 1.495}}));
}

TEST(CapsuleCapsule, CrossingAxesPartPerpendicularToBoth) {
    const Manifold m = contactOf(capsule, at({0, 0, 0}, Vec3::UnitX(), 90), capsule, at({0, 0, 0}, Vec3::UnitY(), 90));
    ASSERT_EQ(m.size, 1U);
    EXPECT_NEAR(std::abs(m.normal.z()), 1, 1e-15);
    EXPECT_NEAR(m.points[0].distance, -1, 1e-15);
}

TEST(CapsuleCapsule, IdenticalPosesPartSideways) {
    const Pose pose = at({1, 2, 3}, Vec3(1, 2, 3), 40);
    const Manifold m = contactOf(capsule, pose, capsule, pose);
    ASSERT_EQ(m.size, 2U);
    EXPECT_NEAR(m.normal.dot(pose.orientation * Vec3::UnitZ()), 0, 1e-14);
    EXPECT_NEAR(m.normal.norm(), 1, 1e-14);
    EXPECT_NEAR(deepest(m), -1, 1e-14);
}

TEST(CapsuleBox, LyingOnAFaceTouchesWithBothEnds) {
    const Manifold m = contactOf(capsule, at({0.5, 0.3, 1.49}, Vec3::UnitY(), 90), box, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(m, {{-0.5, 0.3, 0.995}, {1.5, 0.3, 0.995}}));
}

TEST(CapsuleBox, LyingOverTheBordersOfAFaceIsCutToIt) {
    const Manifold m = contactOf(Capsule{0.5, 10}, at({0, 0.3, 1.49}, Vec3::UnitY(), 90), box, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(m, {{-3, 0.3, 0.995}, {3, 0.3, 0.995}}));
}

TEST(CapsuleBox, RestingOnesKeepBothPointsWhenTheyTiltALittle) {
    for (const double degrees : {1e-12, 1e-9, 1e-6, 1e-4, 1e-3}) {
        for (const double sign : {-1.0, 1.0}) {
            const Pose pose = at({2.5, 0.3, 1.49999}, Vec3(0.01, 1, 0), 90 + sign * degrees);
            const Manifold m = contactOf(capsule, pose, box, at({0, 0, 0}));
            EXPECT_EQ(m.size, 2U) << degrees;
            EXPECT_NEAR(m.normal.z(), 1, 1e-5);
        }
    }
}

TEST(CapsuleBox, StandingOnAFaceTouchesWithOneEnd) {
    const Manifold m = contactOf(capsule, at({0.5, 0.3, 2.49}), box, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(m, {{0.5, 0.3, 0.995}}));
}

TEST(CapsuleBox, ParallelToAnEdgeTouchesWithBothEnds) {
    const Manifold m = contactOf(capsule, at({0, 2.3, 1.4}, Vec3::UnitY(), 90), box, at({0, 0, 0}), 0.01);
    EXPECT_TRUE(touches(m, Vec3(0, 0.6, 0.8), 0));
    EXPECT_TRUE(hasPoints(m, {{-1, 2, 1}, {1, 2, 1}}));
}

TEST(CapsuleBox, CrossingAnEdgeTouchesInOnePoint) {
    // the axis lies in the plane x = 0.2 at 45° over the edge y = 2, z = 1
    const Vec3 out = Vec3(0, 1, 1).normalized();
    const Manifold m = contactOf(capsule, at(Vec3(0.2, 2, 1) + 0.49 * out, Vec3::UnitX(), 45), box, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, out, -0.01));
    EXPECT_TRUE(hasPoints(m, {Vec3(0.2, 2, 1) - 0.005 * out}));
}

TEST(CapsuleBox, TouchesACornerInOnePoint) {
    const Vec3 out = Vec3(1, 2, 2) / 3;
    const Vec3 end = Vec3(3, 2, 1) + 0.49 * out;
    const Quat along = Quat::FromTwoVectors(Vec3::UnitZ(), out);
    const Manifold m = contactOf(capsule, {end + out, along}, box, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, out, -0.01));
    EXPECT_TRUE(hasPoints(m, {Vec3(3, 2, 1) - 0.005 * out}));
}

TEST(CapsuleBox, AnAxisThroughTheBoxLeavesByTheShortestWay) {
    // along x through the middle, longer than the box: up or down is 1 + radius, sideways 2 + radius
    const Manifold through = contactOf(Capsule{0.5, 20}, at({0, 0.1, 0.2}, Vec3::UnitY(), 90), box, at({0, 0, 0}));
    EXPECT_TRUE(touches(through, Vec3::UnitZ(), -1.3));
    EXPECT_EQ(through.size, 2U);
    // along z through the middle: sideways along y is the shortest
    const Manifold across = contactOf(Capsule{0.5, 20}, at({0.1, -0.2, 0}), box, at({0, 0, 0}));
    EXPECT_NEAR(across.normal.y(), -1, 1e-12);
    EXPECT_NEAR(deepest(across), -2.3, 1e-12);
}

TEST(CapsuleBox, AnEndInsideLeavesThroughTheNearestFace) {
    const Manifold m = contactOf(capsule, at({0.5, 0.3, 1.9}), box, at({0, 0, 0}));
    EXPECT_NEAR(m.normal.z(), 1, 1e-12);
    EXPECT_NEAR(deepest(m), -0.6, 1e-12);
}

TEST(CapsuleBox, CoincidentCentresGiveAFiniteContact) {
    const Manifold m = contactOf(capsule, at({1, 1, 1}, Vec3::UnitX(), 30), box, at({1, 1, 1}));
    ASSERT_GE(m.size, 1U);
    EXPECT_NEAR(m.normal.norm(), 1, 1e-14);
    EXPECT_TRUE(m.points[0].point.allFinite());
}

}  // namespace
}  // namespace cairn::testing
