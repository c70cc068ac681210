#include "narrow_phase/manifold_check.h"

namespace cairn::testing {
namespace {

TEST(SphereSphere, TouchesBetweenTheCentres) {
    const Manifold m = contactOf(Sphere{1}, at({3, 0, 0}), Sphere{0.5}, at({1.6, 0, 0}));
    EXPECT_TRUE(touches(m, Vec3::UnitX(), -0.1));
    EXPECT_TRUE(hasPoints(m, {{2.05, 0, 0}}));
}

TEST(SphereSphere, IsReportedUpToTheMarginAndNoFurther) {
    EXPECT_TRUE(touches(contactOf(Sphere{1}, at({0, 0, 2.009}), Sphere{1}, at({0, 0, 0}), 0.01), Vec3::UnitZ(), 0.009));
    EXPECT_EQ(contactOf(Sphere{1}, at({0, 0, 2.011}), Sphere{1}, at({0, 0, 0}), 0.01).size, 0U);
    EXPECT_EQ(contactOf(Sphere{1}, at({0, 0, 2.0001}), Sphere{1}, at({0, 0, 0}), 0).size, 0U);
}

TEST(SphereSphere, CoincidentCentresPartUpwards) {
    const Manifold m = contactOf(Sphere{1}, at({5, 6, 7}), Sphere{0.25}, at({5, 6, 7}));
    ASSERT_EQ(m.size, 1U);
    EXPECT_NEAR(std::abs(m.normal.z()), 1, 0);
    EXPECT_DOUBLE_EQ(m.points[0].distance, -1.25);
}

TEST(SphereHalfSpace, TouchesBelowTheCentre) {
    // normal (0, 0, 2), offset 0.5 along the unit normal: the surface is z = 1 + 0.5
    const Manifold m = contactOf(Sphere{0.25}, at({4, 5, 1.7}), HalfSpace{{0, 0, 2}, 0.5}, at({9, 9, 1}));
    EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.05));
    EXPECT_TRUE(hasPoints(m, {{4, 5, 1.475}}));
}

TEST(SphereHalfSpace, FarBelowTheSurfaceStillPointsOut) {
    EXPECT_TRUE(touches(contactOf(Sphere{1}, at({0, 0, -100}), HalfSpace{}, at({0, 0, 0})), Vec3::UnitZ(), -101));
}

TEST(SphereHalfSpace, TurnsWithItsBody) {
    const Manifold m = contactOf(HalfSpace{{0, 0, 1}, 1}, at({0, 0, 0}, Vec3::UnitY(), 90), Sphere{1}, at({1.9, 3, 4}));
    EXPECT_TRUE(touches(m, -Vec3::UnitX(), -0.1)) << "the half-space is A here";
    EXPECT_TRUE(hasPoints(m, {{0.95, 3, 4}}));
}

TEST(SphereBox, TouchesAFaceAnEdgeAndACorner) {
    const Box box{{2, 4, 6}};
    const Manifold face = contactOf(Sphere{0.5}, at({0.3, -0.2, 3.4}), box, at({0, 0, 0}));
    EXPECT_TRUE(touches(face, Vec3::UnitZ(), -0.1));
    EXPECT_TRUE(hasPoints(face, {{0.3, -0.2, 2.95}}));
    const Manifold edge = contactOf(Sphere{0.5}, at({1.3, 2.4, 1}), box, at({0, 0, 0}), 0.01);
    EXPECT_TRUE(touches(edge, Vec3(0.6, 0.8, 0), 0));
    EXPECT_TRUE(hasPoints(edge, {{1, 2, 1}}));
    const Manifold corner = contactOf(Sphere{3}, at({-2, -4, -5}), box, at({0, 0, 0}), 0.01);
    EXPECT_TRUE(touches(corner, Vec3(-1, -2, -2) / 3, 0));
    EXPECT_TRUE(hasPoints(corner, {{-1, -2, -3}}));
}

TEST(SphereBox, ACentreInsideLeavesThroughTheNearestFace) {
    const Manifold m = contactOf(Sphere{0.5}, at({0.2, -1.9, 0.3}), Box{{2, 4, 6}}, at({0, 0, 0}));
    EXPECT_TRUE(touches(m, -Vec3::UnitY(), -0.6));
    EXPECT_TRUE(hasPoints(m, {{0.2, -1.7, 0.3}}));
}

TEST(SphereBox, ACentreOnTheSurfaceOrAtTheCentreIsFine) {
    EXPECT_TRUE(touches(contactOf(Sphere{0.5}, at({0, 0, 3}), Box{{2, 4, 6}}, at({0, 0, 0})), Vec3::UnitZ(), -0.5));
    EXPECT_TRUE(touches(contactOf(Sphere{0.5}, at({0, 0, 0}), Box{{2, 4, 6}}, at({0, 0, 0})), Vec3::UnitX(), -1.5));
}

TEST(SphereBox, DepthIsContinuousWhereTheCentrePassesTheSurface) {
    for (const double height : {1e-3, 1e-6, 1e-9, 1e-13, 0.0, -1e-13, -1e-9, -1e-6, -1e-3}) {
        const Manifold m = contactOf(Sphere{0.5}, at({0.1, 0.2, 1 + height}), Box{{2, 2, 2}}, at({0, 0, 0}));
        EXPECT_TRUE(touches(m, Vec3::UnitZ(), height - 0.5)) << height;
    }
}

TEST(SphereCapsule, TouchesTheSideAndTheEnds) {
    const Capsule capsule{0.5, 2};
    const Manifold side = contactOf(Sphere{0.25}, at({0.7, 0, 0.8}), capsule, at({0, 0, 0}));
    EXPECT_TRUE(touches(side, Vec3::UnitX(), -0.05));
    EXPECT_TRUE(hasPoints(side, {{0.475, 0, 0.8}}));
    const Manifold end = contactOf(Sphere{0.25}, at({0, 0, -1.7}), capsule, at({0, 0, 0}));
    EXPECT_TRUE(touches(end, -Vec3::UnitZ(), -0.05));
    EXPECT_TRUE(hasPoints(end, {{0, 0, -1.475}}));
    EXPECT_EQ(contactOf(Sphere{0.25}, at({0.76, 0, 0}), capsule, at({0, 0, 0})).size, 0U);
}

TEST(SphereCapsule, ACentreOnTheAxisLeavesSideways) {
    const Manifold m = contactOf(Sphere{0.25}, at({0, 0, 0.3}), Capsule{0.5, 2}, at({0, 0, 0}));
    ASSERT_EQ(m.size, 1U);
    EXPECT_NEAR(m.normal.z(), 0, 1e-15);
    EXPECT_NEAR(m.normal.norm(), 1, 1e-15);
    EXPECT_DOUBLE_EQ(m.points[0].distance, -0.75);
}

TEST(HalfSpaces, NeverTouch) {
    EXPECT_EQ(contactOf(HalfSpace{}, at({0, 0, 0}), HalfSpace{{0, 0, -1}, 3}, at({0, 0, 0})).size, 0U);
}

}  // namespace
}  // namespace cairn::testing
