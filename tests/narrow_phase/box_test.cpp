#include "narrow_phase/manifold_check.h"
#include "narrow_phase/pair_random.h"
#include "narrow_phase/reference.h"

namespace cairn::testing {
namespace {

const Box cube{{2, 2, 2}};

TEST(BoxHalfSpace, LyingTouchesWithFourCornersAndDeepInsideWithAll) {
    const Manifold lying = contactOf(Box{{2, 4, 6}}, at({1, 1, 2.99}), HalfSpace{}, at({0, 0, 0}));
    EXPECT_TRUE(touches(lying, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(lying, {{0, -1, -0.005}, {2, -1, -0.005}, {0, 3, -0.005}, {2, 3, -0.005}}));
    EXPECT_EQ(contactOf(cube, at({0, 0, -5}), HalfSpace{}, at({0, 0, 0})).size, 8U);
    EXPECT_EQ(contactOf(cube, at({0, 0, 1.001}), HalfSpace{}, at({0, 0, 0})).size, 0U);
}

TEST(BoxHalfSpace, StandingOnAnEdgeTouchesWithTwoCornersAndOnACornerWithOne) {
    const double edge = std::sqrt(2.0);
    EXPECT_EQ(contactOf(cube, at({0, 0, edge}, Vec3::UnitX(), 45), HalfSpace{}, at({0, 0, 0})).size, 2U);
    const Quat upright = Quat::FromTwoVectors(Vec3(1, 1, 1), -Vec3::UnitZ());
    const Manifold m = contactOf(cube, {{0, 0, std::sqrt(3.0)}, upright}, HalfSpace{}, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), 0));
    EXPECT_TRUE(hasPoints(m, {{0, 0, 0}}));
}

TEST(BoxBox, EqualBoxesOnEachOtherTouchInTheirFourCorners) {
    const Manifold m = contactOf(cube, at({0, 0, 1.99}), cube, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(m, {{-1, -1, 0.995}, {1, -1, 0.995}, {-1, 1, 0.995}, {1, 1, 0.995}}));
}

TEST(BoxBox, UnequalBoxesTouchWhereBothFacesAre) {
    const Manifold small = contactOf(Box{{0.5, 0.25, 1}}, at({0.3, 0.2, 1.49}), cube, at({0, 0, 0}));
    EXPECT_TRUE(touches(small, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(
        hasPoints(small, {{0.05, 0.075, 0.995}, {0.55, 0.075, 0.995}, {0.05, 0.325, 0.995}, {0.55, 0.325, 0.995}}));
    const Manifold brick = contactOf(cube, at({1, 0.5, 1.99}), cube, at({0, 0, 0}));
    EXPECT_TRUE(hasPoints(brick, {{0, -0.5, 0.995}, {1, -0.5, 0.995}, {0, 1, 0.995}, {1, 1, 0.995}}));
    const Manifold crossed = contactOf(Box{{6, 1, 1}}, at({0, 0, 0.99}), Box{{1, 6, 1}}, at({0, 0, 0}));
    EXPECT_TRUE(hasPoints(crossed, {{-0.5, -0.5, 0.495}, {0.5, -0.5, 0.495}, {-0.5, 0.5, 0.495}, {0.5, 0.5, 0.495}}));
}

TEST(BoxBox, AFaceTurnedBy45DegreesGivesAllEightCorners) {
    const Manifold m = contactOf(cube, at({0, 0, 1.99}, Vec3::UnitZ(), 45), cube, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.01));
    const double t = std::sqrt(2.0) - 1;
    EXPECT_TRUE(hasPoints(m, {{t, 1, 0.995},
                              {-t, 1, 0.995},
                              {t, -1, 0.995},
                              {-t, -1, 0.995},
                              {1, t, 0.995},
                              {1, -t, 0.995},
                              {-1, t, 0.995},
                              {-1, -t, 0.995}}));
}

TEST(BoxBox, CrossingEdgesTouchInOnePoint) {
    const double reach = std::sqrt(2.0);
    const Manifold m =
        contactOf(cube, at({0.3, 0.2, 2 * reach - 0.01}, Vec3::UnitX(), 45), cube, at({0, 0, 0}, Vec3::UnitY(), 45));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(m, {{0, 0.2, reach - 0.005}}));
}

TEST(BoxBox, ACornerOnAFaceTouchesInOnePoint) {
    const Quat upright = Quat::FromTwoVectors(Vec3(1, 1, 1), -Vec3::UnitZ());
    const Manifold m = contactOf(cube, {{0.2, 0.1, 1 + std::sqrt(3.0) - 0.01}, upright}, cube, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.01));
    EXPECT_TRUE(hasPoints(m, {{0.2, 0.1, 0.995}}));
}

TEST(BoxBox, AnEdgeOnAFaceTouchesWithBothEnds) {
    const Manifold m =
        contactOf(cube, at({0, 0, 1 + std::sqrt(2.0)}, Vec3::UnitX(), 45), Box{{8, 8, 2}}, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), 0));
    EXPECT_TRUE(hasPoints(m, {{-1, 0, 1}, {1, 0, 1}}));
}

TEST(BoxBox, CornerToCornerIsFoundWithinTheMarginOnly) {
    const Vec3 corner(1, 1, 1);
    const Vec3 apart = Vec3(1, 2, 2) / 3;
    const Manifold near = contactOf(cube, at(2 * corner + 0.009 * apart), cube, at({0, 0, 0}), 0.01);
    EXPECT_TRUE(touches(near, apart, 0.009));
    EXPECT_TRUE(hasPoints(near, {corner + 0.0045 * apart}));
    // 6.3 mm along each axis, but more than 10 mm in all
    EXPECT_EQ(contactOf(cube, at(2 * corner + Vec3::Constant(0.0063)), cube, at({0, 0, 0}), 0.01).size, 0U);
}

TEST(BoxBox, ASmallBoxDeepInsideALargeOneLeavesByTheShortestWay) {
    const Box large{{20, 30, 40}};
    const Manifold m = contactOf(cube, at({1, -12, 3}), large, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, -Vec3::UnitY(), -4));
    EXPECT_EQ(m.size, 4U);
    const Manifold centred = contactOf(cube, at({0, 0, 0}), large, at({0, 0, 0}));
    EXPECT_TRUE(touches(centred, centred.normal, -11));
    EXPECT_NEAR(std::abs(centred.normal.x()), 1, 1e-15);
}

TEST(BoxBox, IdenticalPosesGiveTheLeastTranslation) {
    const Pose pose = at({1, 2, 3}, Vec3(3, 1, 2), 77);
    const Manifold m = contactOf(Box{{3, 1, 2}}, pose, Box{{3, 1, 2}}, pose);
    EXPECT_EQ(m.size, 4U);
    EXPECT_NEAR(deepest(m), -1, 1e-12);
    EXPECT_NEAR(std::abs(m.normal.dot(pose.orientation * Vec3::UnitY())), 1, 1e-12);
}

TEST(BoxBox, RestingBoxesKeepFourPointsUnderTinyPerturbations) {
    Random random(11);
    for (int i = 0; i < 20000; ++i) {
        const Box lower = random.below(2) == 0 ? Box{{0.1, 0.1, 0.1}} : random.box(0.3);
        const Box upper = random.below(2) == 0 ? lower : random.box(0.3);
        const double size = std::pow(10.0, -6 - random.below(9));
        const double overlap = random.uniform(-5e-5, 1.7e-3);
        const Quat turn(Eigen::AngleAxisd(size, random.direction()));
        const Vec3 shift = random.below(2) == 0 ? random.vector(size) : Vec3(Vec3::Zero());
        const Pose pose{Vec3(0, 0, 0.5 * (lower.size.z() + upper.size.z()) - overlap) + shift, turn};
        const Manifold m = contactOf(upper, pose, lower, at({0, 0, 0}));
        ASSERT_EQ(m.size, 4U) << "pose " << i << " perturbed by " << size;
        ASSERT_NEAR(m.normal.z(), 1, 1e-10);
        for (std::size_t k = 0; k < m.size; ++k) ASSERT_NEAR(m.points[k].distance, -overlap, 2e-6);
    }
}

TEST(BoxBox, StackedBoxesTiltedByTheirOverlapKeepAFaceContact) {
    Random random(12);
    for (int i = 0; i < 20000; ++i) {
        const Box box{{0.1, 0.1, 0.1}};
        const Quat turn = Quat(Eigen::AngleAxisd(random.uniform(0, 0.02), random.direction()));
        const Pose pose{Vec3(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), 0.0985), turn};
        const Manifold m = contactOf(box, pose, box, at({0, 0, 0}));
        ASSERT_GE(m.size, 2U) << "pose " << i;
        ASSERT_GT(m.normal.z(), std::cos(0.021)) << "pose " << i;
    }
}

TEST(BoxBox, SlenderBoxesThatCrossAreAsFarApartAsTheyAre) {
    // Their centres are up to a hundred times farther from the crossing than they are thick, so that along the normals
    // of their faces they seem to be far in each other, on this or that side.
    Random random(13);
    for (int i = 0; i < 3000; ++i) {
        const double thick = 0.005;
        const Box lower{{random.uniform(0.1, 0.5), random.uniform(1, 40) * thick, thick}};
        const Box upper{{random.uniform(0.1, 0.5), random.uniform(1, 40) * thick, thick}};
        const Quat tilt(Eigen::AngleAxisd(random.uniform(0, 0.1), random.direction()));
        const Quat turn(Eigen::AngleAxisd(random.uniform(0.1, std::numbers::pi - 0.1), Vec3::UnitZ()));
        // Somewhere one is above the other.
        const auto within = [&](const Box& box) {
            return Vec3(random.uniform(-0.48, 0.48) * box.size.x(), random.uniform(-0.48, 0.48) * box.size.y(), 0);
        };
        const Quat orientation = tilt * turn;
        const Pose pose_above{within(lower) - orientation * within(upper), orientation};
        const auto gapAt = [&](double height) {
            const Pose pose{pose_above.position + height * Vec3::UnitZ(), orientation};
            return static_cast<double>(gapOf(Solid(upper, pose), Solid(lower, at({0, 0, 0}))));
        };
        // At first far above, then so far down that little is left.
        double height = 0.2;
        for (int n = 0; n < 20; ++n) height -= gapAt(height) - random.uniform(-1e-4, 4e-4);
        const Pose pose{pose_above.position + height * Vec3::UnitZ(), orientation};
        const double gap = gapAt(height);
        const Manifold m = contactOf(upper, pose, lower, at({0, 0, 0}), 1e-3);
        ASSERT_GT(m.size, 0U) << "pose " << i << " with a gap of " << gap;
        ASSERT_NEAR(deepest(m), gap, 0.1 * thick) << "pose " << i;
    }
}

TEST(BoxBox, CornersThatNearlyCoincideAreOnePoint) {
    const Manifold m = contactOf(cube, at({0, 0, 1.9999}, Vec3::UnitZ(), 0.01), cube, at({0, 0, 0}));
    EXPECT_EQ(m.size, 4U);
    const Manifold apart = contactOf(cube, at({0, 0, 1.9999}, Vec3::UnitZ(), 1), cube, at({0, 0, 0}));
    EXPECT_EQ(apart.size, 8U);
}

}  // namespace
}  // namespace cairn::testing
