#include "geometry/geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/half_space.h"
#include "geometry/shape_entry.h"

namespace cairn {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A solid as a yes or no for each point of B, written without the library.
bool contains(const Shape& shape, const Vec3& p) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return p.norm() <= sphere->radius;
    if (const auto* box = std::get_if<Box>(&shape)) return (2 * p.cwiseAbs() - box->size).maxCoeff() <= 0;
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        return std::hypot(p.x(), p.y()) <= cylinder->radius && 2 * std::abs(p.z()) <= cylinder->length;
    }
    const auto& capsule = std::get<Capsule>(shape);
    const double beyond = std::max(0.0, std::abs(p.z()) - 0.5 * capsule.length);
    return std::hypot(p.x(), p.y(), beyond) <= capsule.radius;
}

struct Integrals {
    double volume = 0;
    Mat3 inertia = Mat3::Zero();
};

/// Sums over the cells of a regular grid whose centre is inside.
Integrals integrate(const Shape& shape, const Vec3& half, int cells) {
    Integrals result;
    const Vec3 cell = 2 * half / cells;
    for (int x = 0; x < cells; ++x) {
        for (int y = 0; y < cells; ++y) {
            for (int z = 0; z < cells; ++z) {
                const Vec3 p = (Vec3(x, y, z).array() + 0.5).matrix().cwiseProduct(cell) - half;
                if (!contains(shape, p)) continue;
                result.volume += cell.prod();
                result.inertia += cell.prod() * (p.squaredNorm() * Mat3::Identity() - p * p.transpose());
            }
        }
    }
    return result;
}

/// Directions spread over the sphere on a spiral of golden angles.
std::vector<Vec3> directions(int count) {
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1.0) / count;
        const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
        result.emplace_back(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
    }
    return result;
}

const std::vector<Shape>& solids() {
    static const std::vector<Shape> shapes = {Sphere{0.7},        Box{{0.3, 1.1, 2.0}}, Capsule{0.4, 1.3},
                                              Capsule{1.0, 0.01}, Capsule{0.01, 2.0},   Cylinder{0.4, 1.3},
                                              Cylinder{1, 0.02}};
    return shapes;
}

std::string refusalOf(const Shape& shape) {
    try {
        validateShape(shape);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Geometry, NamesAreThoseOfSceneFiles) {
    EXPECT_EQ(shapeName(Sphere{}), "sphere");
    EXPECT_EQ(shapeName(Box{}), "box");
    EXPECT_EQ(shapeName(Capsule{}), "capsule");
    EXPECT_EQ(shapeName(HalfSpace{}), "plane");
    EXPECT_EQ(shapeName(Cylinder{}), "cylinder");
}

TEST(Geometry, OnlyTheHalfSpaceIsInfinite) {
    for (const Shape& shape : solids()) EXPECT_FALSE(isInfinite(shape));
    EXPECT_TRUE(isInfinite(HalfSpace{}));
    EXPECT_EQ(unitMassProperties(HalfSpace{}).volume, infinity);
    EXPECT_EQ(largestRadius(HalfSpace{}), infinity);
    EXPECT_EQ(smallestRadius(HalfSpace{}), infinity);
}

TEST(Geometry, VolumesAndInertiasHaveTheirClosedForms) {
    const UnitMassProperties sphere = unitMassProperties(Sphere{2});
    EXPECT_NEAR(sphere.volume, 33.510321638291124, 1e-12);
    EXPECT_NEAR(sphere.inertia_volume.x(), 0.4 * 33.510321638291124 * 4, 1e-12);
    const UnitMassProperties box = unitMassProperties(Box{{1, 2, 3}});
    EXPECT_DOUBLE_EQ(box.volume, 6);
    EXPECT_TRUE(box.inertia_volume.isApprox(Vec3(6.5, 5, 2.5), 1e-15)) << box.inertia_volume.transpose();
    const UnitMassProperties capsule = unitMassProperties(Capsule{1, 2});
    EXPECT_NEAR(capsule.volume, std::numbers::pi * 10 / 3, 1e-12);
    EXPECT_NEAR(capsule.inertia_volume.z(), std::numbers::pi * (1 + 8.0 / 15), 1e-12);
    const UnitMassProperties cylinder = unitMassProperties(Cylinder{1, 2});
    EXPECT_NEAR(cylinder.volume, 2 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(cylinder.inertia_volume.x(), 2 * std::numbers::pi * 7 / 12, 1e-12);
    EXPECT_NEAR(cylinder.inertia_volume.z(), std::numbers::pi, 1e-12);
}

TEST(Geometry, VolumesAndInertiasAgreeWithSumsOverAGrid) {
    for (const Shape& shape :
         {Shape(Sphere{0.7}), Shape(Box{{0.3, 1.1, 2.0}}), Shape(Capsule{0.4, 1.3}), Shape(Cylinder{0.4, 1.3})}) {
        const Bounds bounds = boundsOf(shape, Pose{});
        const Integrals expected = integrate(shape, bounds.upper, 120);
        const UnitMassProperties actual = unitMassProperties(shape);
        EXPECT_NEAR(actual.volume / expected.volume, 1, 2e-3) << shapeName(shape);
        for (Eigen::Index i = 0; i < 3; ++i) {
            EXPECT_NEAR(actual.inertia_volume[i] / expected.inertia(i, i), 1, 2e-3) << shapeName(shape) << i;
            EXPECT_NEAR(expected.inertia(i, (i + 1) % 3), 0, 1e-9) << "the axes of B are principal";
        }
    }
}

TEST(Geometry, ALongThinCapsuleHasTheInertiaOfARod) {
    const UnitMassProperties rod = unitMassProperties(Capsule{1e-4, 10});
    EXPECT_NEAR(rod.inertia_volume.x() / (rod.volume * 100 / 12), 1, 1e-4);
}

TEST(Geometry, SupportIsOnTheSurfaceAndTheFarthestPoint) {
    for (const Shape& shape : solids()) {
        const std::vector<Vec3> all = directions(400);
        for (const Vec3& n : all) {
            const Vec3 p = support(shape, n);
            EXPECT_TRUE(contains(shape, (1 - 1e-12) * p)) << shapeName(shape);
            EXPECT_FALSE(contains(shape, p + 1e-9 * n)) << shapeName(shape);
            for (const Vec3& other : all) ASSERT_LE(support(shape, other).dot(n), p.dot(n) + 1e-12);
        }
    }
}

TEST(Geometry, SupportDoesNotDependOnTheLengthOfTheDirection) {
    for (const Shape& shape : solids()) {
        for (const Vec3& n : directions(50)) {
            for (const double length : {1e-250, 1e-3, 1e250}) {
                EXPECT_TRUE(support(shape, length * n).isApprox(support(shape, n), 1e-14)) << shapeName(shape);
            }
        }
    }
}

TEST(Geometry, LargestRadiusIsThatOfTheFarthestSurfacePoint) {
    for (const Shape& shape : solids()) {
        double farthest = 0;
        for (const Vec3& n : directions(20000)) farthest = std::max(farthest, support(shape, n).norm());
        EXPECT_NEAR(largestRadius(shape), farthest, 1e-3) << shapeName(shape);
        EXPECT_GE(largestRadius(shape), farthest - 1e-12) << shapeName(shape);
    }
}

TEST(Geometry, BoundsTouchTheShapeOnAllSixSides) {
    for (const Shape& shape : solids()) {
        int turn = 0;
        for (const Vec3& axis : directions(60)) {
            const Pose pose{{3, -5, 7}, Quat(Eigen::AngleAxisd(0.1 * ++turn, axis))};
            const Bounds bounds = boundsOf(shape, pose);
            for (Eigen::Index i = 0; i < 3; ++i) {
                const Vec3 up = pose.orientation.conjugate() * Vec3::Unit(i);
                EXPECT_NEAR(bounds.upper[i], pose.toOuter(support(shape, up))[i], 1e-13) << shapeName(shape);
                EXPECT_NEAR(bounds.lower[i], pose.toOuter(support(shape, -up))[i], 1e-13) << shapeName(shape);
            }
        }
    }
}

TEST(Geometry, AHalfSpaceIsBoundedOnlyAgainstAnAxisItIsPerpendicularTo) {
    const Pose pose{{1, 2, 3}, Quat::Identity()};
    const Bounds floor = boundsOf(HalfSpace{{0, 0, 5}, 0.5}, pose);
    EXPECT_EQ(floor.upper.z(), 3.5);
    EXPECT_EQ(floor.lower.z(), -infinity);
    EXPECT_EQ(floor.upper.x(), infinity);
    const Bounds wall = boundsOf(HalfSpace{{-2, 0, 0}, 0.5}, pose);
    EXPECT_EQ(wall.lower.x(), 0.5);
    EXPECT_EQ(wall.upper.x(), infinity);
    EXPECT_EQ(wall.lower.z(), -infinity);
    const Bounds slope = boundsOf(HalfSpace{{1, 0, 1e-9}, 0.5}, pose);
    EXPECT_EQ(slope.lower, Bounds{}.lower);
    EXPECT_EQ(slope.upper, Bounds{}.upper);
}

TEST(Geometry, TheNormalOfAHalfSpaceMayHaveAnyLength) {
    const Vec3 expected = Vec3(1, 2, -2) / 3;
    for (const double length : {1e-300, 1e-160, 1.0, 1e160, 1e300}) {
        const HalfSpace half_space{length * Vec3(1, 2, -2), 1};
        EXPECT_NO_THROW(validateShape(half_space));
        EXPECT_TRUE(unitNormal(half_space).isApprox(expected, 1e-15)) << length;
    }
}

TEST(Geometry, BoundsOverlapIncludesTouching) {
    const Bounds a{Vec3::Zero(), Vec3::Ones()};
    EXPECT_TRUE(a.overlaps({Vec3::Ones(), Vec3::Constant(2)}));
    EXPECT_FALSE(a.overlaps({Vec3(0, 0, 1.0001), Vec3::Constant(2)}));
    EXPECT_TRUE(a.overlaps(Bounds{}));
}

TEST(Geometry, GoodShapesAreAccepted) {
    for (const Shape& shape : solids()) EXPECT_EQ(refusalOf(shape), "");
    EXPECT_EQ(refusalOf(Sphere{smallest_dimension}), "");
    EXPECT_EQ(refusalOf(Sphere{largest_dimension}), "");
    EXPECT_EQ(refusalOf(HalfSpace{{0, 0, 1}, -1e6}), "");
}

TEST(Geometry, BadDimensionsAreRefusedByName) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -1.0, nan, infinity, -infinity, 1e-300, 1e300}) {
        EXPECT_NE(refusalOf(Sphere{bad}).find("radius of a sphere"), std::string::npos) << bad;
        EXPECT_NE(refusalOf(Box{{1, bad, 1}}).find("size y of a box"), std::string::npos) << bad;
        EXPECT_NE(refusalOf(Capsule{bad, 1}).find("radius of a capsule"), std::string::npos) << bad;
        EXPECT_NE(refusalOf(Capsule{1, bad}).find("length of a capsule"), std::string::npos) << bad;
        EXPECT_NE(refusalOf(Cylinder{bad, 1}).find("radius of a cylinder"), std::string::npos) << bad;
        EXPECT_NE(refusalOf(Cylinder{1, bad}).find("length of a cylinder"), std::string::npos) << bad;
    }
    EXPECT_NE(refusalOf(Sphere{-0.25}).find("-0.25"), std::string::npos) << "the text shows the value";
    EXPECT_NE(refusalOf(HalfSpace{Vec3::Zero(), 0}).find("normal of a plane"), std::string::npos);
    EXPECT_NE(refusalOf(HalfSpace{{0, nan, 1}, 0}).find("normal of a plane"), std::string::npos);
    EXPECT_NE(refusalOf(HalfSpace{{0, infinity, 1}, 0}).find("normal of a plane"), std::string::npos);
    for (const double bad : {nan, infinity, -infinity}) {
        EXPECT_NE(refusalOf(HalfSpace{{0, 0, 1}, bad}).find("offset of a plane"), std::string::npos) << bad;
    }
}

TEST(Geometry, TheSmallestAndLargestBodiesHaveAnInvertibleInertia) {
    for (const double length : {smallest_dimension, largest_dimension}) {
        for (const Shape& shape : {Shape(Sphere{length}), Shape(Box{Vec3::Constant(length)}),
                                   Shape(Capsule{length, length}), Shape(Cylinder{length, length})}) {
            const UnitMassProperties properties = unitMassProperties(shape);
            EXPECT_TRUE(std::isnormal(properties.volume));
            EXPECT_TRUE(properties.inertia_volume.cwiseInverse().allFinite());
            EXPECT_GT(properties.inertia_volume.cwiseInverse().minCoeff(), 0);
        }
    }
}

TEST(SmallestRadius, IsHalfOfTheSmallestExtent) {
    EXPECT_EQ(smallestRadius(Sphere{0.3}), 0.3);
    EXPECT_EQ(smallestRadius(Box{Vec3(1, 0.2, 3)}), 0.1);
    EXPECT_EQ(smallestRadius(Capsule{0.25, 4}), 0.25);
    EXPECT_EQ(smallestRadius(Cylinder{0.5, 0.4}), 0.2);
    EXPECT_EQ(smallestRadius(Cylinder{0.5, 4}), 0.5);
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 0.2 : -0.2, i & 4 ? 3 : -3);
    EXPECT_NEAR(smallestRadius(ConvexHull(corners)), 0.2, 1e-15);
    Compound both;
    both.parts.push_back({Box{Vec3(1, 1, 1)}, {}, {}, {}});
    both.parts.push_back({Sphere{0.1}, {Vec3(1, 0, 0), Quat::Identity()}, {}, {}});
    EXPECT_EQ(smallestRadius(both), 0.1);
}

}  // namespace
}  // namespace cairn
