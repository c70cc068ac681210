#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "geometry/body_mass.h"
#include "geometry/geometry.h"
#include "geometry/hull_data.h"

namespace cairn {
namespace {

std::vector<Vec3> boxCorners(const Vec3& size) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        const Vec3 sign((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? 0.5 : -0.5);
        corners.emplace_back(sign.cwiseProduct(size));
    }
    return corners;
}

const std::vector<Vec3>& tetrahedron() {
    static const std::vector<Vec3> corners = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    return corners;
}

std::string refusal(const std::vector<Vec3>& points) {
    try {
        const ConvexHull hull(points);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Hull, OfABoxHasTheBoxsFacesAndMass) {
    const Box box{{1, 2, 3}};
    const ConvexHull hull(boxCorners(box.size));
    EXPECT_EQ(hull.data().faces.size(), 6U);
    for (const HullFace& face : hull.data().faces) EXPECT_EQ(face.end - face.begin, 4U);
    const UnitMassProperties expected = unitMassProperties(box);
    const UnitMassProperties mass = unitMassProperties(hull);
    EXPECT_NEAR(mass.volume, expected.volume, 1e-14);
    EXPECT_LE((mass.inertia_volume - expected.inertia_volume).norm(), 1e-13);
    EXPECT_LE(mass.centre.norm(), 1e-15);
    EXPECT_EQ(mass.axes.coeffs(), Quat::Identity().coeffs()) << "principal axes that are those given stay";
    EXPECT_NEAR(largestRadius(hull), largestRadius(box), 1e-15);
}

TEST(Hull, OfATetrahedronHasItsClosedForm) {
    // A regular tetrahedron with edge a = 2√2 has the volume a³/(6√2) = 8/3 and the inertia a²/20 per mass about any
    // axis.
    const UnitMassProperties mass = unitMassProperties(ConvexHull(tetrahedron()));
    EXPECT_NEAR(mass.volume, 8.0 / 3, 1e-14);
    EXPECT_LE((mass.inertia_volume - Vec3::Constant(8.0 / 3 * 8 / 20)).norm(), 1e-13);
}

TEST(Hull, CentreAndAxesFollowTheFrameOfThePoints) {
    const Box box{{1, 2, 3}};
    const Pose frame{{100, -200, 300}, Quat(0.5, 0.1, -0.7, 0.3).normalized()};
    std::vector<Vec3> points;
    for (const Vec3& corner : boxCorners(box.size)) points.push_back(frame.toOuter(corner));
    const UnitMassProperties mass = unitMassProperties(ConvexHull(points));
    EXPECT_NEAR(mass.volume, 6, 1e-10);
    EXPECT_LE((mass.centre - frame.position).norm(), 1e-10);
    const Mat3 axes = mass.axes.toRotationMatrix();
    const Mat3 expected = frame.orientation.toRotationMatrix();
    const Mat3 inertia = expected * unitMassProperties(box).inertia_volume.asDiagonal() * expected.transpose();
    EXPECT_LE((axes * mass.inertia_volume.asDiagonal() * axes.transpose() - inertia).norm(), 1e-9);
    EXPECT_NEAR(axes.determinant(), 1, 1e-12);
}

TEST(Hull, PointsInsideOnFacesOnEdgesAndGivenTwiceChangeNothing) {
    std::vector<Vec3> points = boxCorners({2, 2, 2});
    for (const Vec3& more : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(0.5, 0.5, -1)}) {
        points.push_back(more);
    }
    const ConvexHull hull(points);
    EXPECT_EQ(hull.points().size(), 13U);
    EXPECT_EQ(hull.corners().size(), 8U);
    EXPECT_EQ(hull.data().faces.size(), 6U);
    EXPECT_NEAR(unitMassProperties(hull).volume, 8, 1e-13);
}

TEST(Hull, RoundedCoordinatesOfAFlatFaceKeepItOneFace) {
    std::vector<Vec3> prism;
    for (int i = 0; i < 5; ++i) {
        const double turn = 0.3 + 2 * std::acos(-1.0) * i / 5;
        for (const double end : {-1.0, 1.0}) {
            const Vec3 p = Quat(0.9, 0.1, 0.3, 0.2).normalized() * Vec3(std::cos(turn), std::sin(turn), end);
            prism.emplace_back((1e9 * p).array().round() / 1e9);
        }
    }
    EXPECT_EQ(ConvexHull(prism).data().faces.size(), 7U);
}

TEST(Hull, EveryCornerIsBelowEveryFaceAndLoopsTurnLeft) {
    std::vector<Vec3> points;
    for (int i = 0; i < 60; ++i) {
        const double z = 1 - (2 * i + 1.0) / 60;
        points.emplace_back(std::sqrt(1 - z * z) * std::cos(2.4 * i), std::sqrt(1 - z * z) * std::sin(2.4 * i), z);
    }
    const ConvexHull solid(points);
    const HullData& hull = solid.data();
    EXPECT_EQ(hull.corners.size(), 60U);
    EXPECT_EQ(hull.faces.size(), 116U) << "Euler: 2·60 − 4 triangles";
    for (const HullFace& face : hull.faces) {
        for (const Vec3& corner : hull.corners) ASSERT_LE(face.normal.dot(corner), face.offset + 1e-12);
        const auto loop = hull.loop(face);
        const Vec3 turn =
            (hull.corners[loop[1]] - hull.corners[loop[0]]).cross(hull.corners[loop[2]] - hull.corners[loop[1]]);
        ASSERT_GT(turn.dot(face.normal), 0);
    }
}

TEST(Hull, BadPointsAreRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(refusal({}).find("has 0 points"), std::string::npos);
    EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).find("at least four"), std::string::npos);
    EXPECT_NE(refusal(std::vector<Vec3>(8, Vec3::Ones())).find("of which 1 differ"), std::string::npos);
    EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}}).find("in one plane"), std::string::npos);
    EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).find("in one plane or line"), std::string::npos);
    EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-9}}).find("in one plane"), std::string::npos);
    EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}, {0, nan, 0}, {0, 0, 1}}).find("point 2 of a hull"), std::string::npos);
    EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1e300, 0}, {0, 0, 1}}).find("point 2 of a hull"), std::string::npos);
}

std::string messageOf(const Compound& compound) {
    try {
        validateShape(compound);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Compound, OfTwoHalvesIsTheWhole) {
    const Compound halves{{{Box{{1, 2, 1.5}}, {{0, 0, 0.75}}, {}, {}}, {Box{{1, 2, 1.5}}, {{0, 0, -0.75}}, {}, {}}}};
    const BodyMass mass = bodyMass(halves, 500, {});
    const BodyMass whole = bodyMass(Box{{1, 2, 3}}, 500, {});
    EXPECT_NEAR(mass.mass, whole.mass, 1e-9);
    EXPECT_LE((mass.inertia - whole.inertia).norm(), 1e-9);
    EXPECT_LE(mass.body_in_shape.position.norm(), 1e-15);
    EXPECT_EQ(boundsOf(halves, {}).upper, Vec3(0.5, 1, 1.5));
}

TEST(Compound, PartsHaveTheirOwnMassOrDensity) {
    // A dumbbell of two balls of 1 and 3 kg, 4 m apart: the centre lies 1 m from the heavy one.
    const Compound dumbbell{{{Sphere{0.5}, {{0, 0, 0}}, 1.0, {}}, {Sphere{0.5}, {{0, 0, 4}}, 3.0, {}}}};
    const BodyMass mass = bodyMass(dumbbell, 800, {});
    EXPECT_DOUBLE_EQ(mass.mass, 4);
    EXPECT_NEAR(mass.body_in_shape.position.z(), 3, 1e-14);
    const double own = 0.4 * 4 * 0.25;
    EXPECT_NEAR(mass.inertia.x(), own + 1 * 9 + 3 * 1, 1e-13);
    EXPECT_NEAR(mass.inertia.z(), own, 1e-13);
    const Compound dense{{{Box{}, {{0, 0, 0}}, {}, 1000.0}, {Box{}, {{0, 0, 1}}, {}, {}}}};
    EXPECT_NEAR(bodyMass(dense, 500, {}).mass, 1500, 1e-9);
    EXPECT_NEAR(bodyMass(dense, 500, {}).body_in_shape.position.z(), 1.0 / 3, 1e-14);
    EXPECT_NEAR(bodyMass(dense, 500, {.mass = 3, .centre = {}, .inertia = {}}).mass, 3, 1e-14);
}

TEST(Compound, BadPartsAreRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(messageOf({}).find("has no mass"), std::string::npos);
    EXPECT_NE(messageOf({{{HalfSpace{}, {}, {}, {}}}}).find("part 0 of a compound is a plane"), std::string::npos);
    EXPECT_NE(messageOf({{{Compound{{{Box{}, {}, {}, {}}}}, {}, {}, {}}}}).find("is a compound"), std::string::npos);
    EXPECT_NE(messageOf({{{Box{}, {}, 0.0, {}}}}).find("has the mass 0"), std::string::npos);
    EXPECT_NE(messageOf({{{Box{}, {}, {}, nan}}}).find("has the density nan"), std::string::npos);
    EXPECT_NE(messageOf({{{Box{}, {}, 1.0, 1.0}}}).find("a mass and a density"), std::string::npos);
    EXPECT_NE(messageOf({{{Box{}, {{0, nan, 0}}, {}, {}}}}).find("part 0 of a compound is at"), std::string::npos);
    EXPECT_NE(messageOf({{{Box{}, {{0, 0, 0}, Quat(0, 0, 0, 0)}, {}, {}}}}).find("orientation of part 0"),
              std::string::npos);
    EXPECT_NE(messageOf({{{Sphere{-1}, {}, {}, {}}}}).find("radius of a sphere"), std::string::npos);
}

TEST(BodyMass, AnythingCanBeGivenByHand) {
    Mat3 inertia;
    inertia << 3, 0.5, 0, 0.5, 4, 0.2, 0, 0.2, 5;
    const BodyMass mass = bodyMass(Box{}, 800, {.mass = 7, .centre = Vec3(0.1, 0, -0.2), .inertia = inertia});
    EXPECT_EQ(mass.mass, 7);
    EXPECT_EQ(mass.body_in_shape.position, Vec3(0.1, 0, -0.2));
    const Mat3 axes = mass.body_in_shape.orientation.toRotationMatrix();
    EXPECT_LE((axes * mass.inertia.asDiagonal() * axes.transpose() - inertia).norm(), 1e-13);
}

TEST(BodyMass, AnInertiaOfNoBodyIsRefused) {
    const auto message = [](const Mat3& inertia) -> std::string {
        try {
            bodyMass(Box{}, 800, {.mass = {}, .centre = {}, .inertia = inertia});
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    Mat3 skewed = Mat3::Identity();
    skewed(0, 1) = 0.5;
    EXPECT_NE(message(skewed).find("symmetric"), std::string::npos);
    EXPECT_NE(message(Vec3(1, 1, 3).asDiagonal()).find("sum of the other two"), std::string::npos);
    EXPECT_NE(message(Vec3(1, 1, 0).asDiagonal()).find("above 0"), std::string::npos);
    EXPECT_NE(message(Mat3::Constant(std::numeric_limits<double>::infinity())).find("finite"), std::string::npos);
    EXPECT_EQ(message(Vec3(1, 1, 2).asDiagonal()), "") << "a flat body";
    EXPECT_THROW(bodyMass(Box{}, 1, {.mass = {}, .centre = Vec3(0, 1e300, 0), .inertia = {}}), InputError);
}

}  // namespace
}  // namespace cairn
