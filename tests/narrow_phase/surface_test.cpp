/// Contacts with triangles: on a plane those of the plane, at edges those that no neighbour knows better.
#include <gtest/gtest.h>

#include <cmath>

#include "narrow_phase/manifold_check.h"
#include "samples.h"
#include "surface_maker.h"

namespace cairn::testing {
namespace {

std::vector<Manifold> manifoldsOf(const Shape& shape, const Pose& pose, const Shape& other, const Pose& other_pose,
                                  double margin = 1e-4) {
    std::vector<Manifold> found;
    Manifold manifold;
    forEachManifold(shape, pose, other, other_pose, margin, manifold, [&](const Manifold& m) { found.push_back(m); });
    return found;
}

std::vector<Manifold> on(const Shape& surface, const Shape& shape, const Pose& pose, double margin = 1e-4) {
    return manifoldsOf(shape, pose, surface, Pose{}, margin);
}

::testing::AssertionResult areSame(const std::vector<Manifold>& found, const std::vector<Manifold>& expected,
                                   double tolerance) {
    if (found.size() != expected.size()) {
        return ::testing::AssertionFailure() << found.size() << " manifolds in place of " << expected.size();
    }
    for (std::size_t k = 0; k < found.size(); ++k) {
        if (found[k].size != expected[k].size) {
            return ::testing::AssertionFailure() << found[k].size << " points in place of " << expected[k].size;
        }
        if ((found[k].normal - expected[k].normal).norm() > tolerance) {
            return ::testing::AssertionFailure() << "normal " << found[k].normal.transpose();
        }
        for (std::size_t i = 0; i < found[k].size; ++i) {
            const ManifoldPoint& p = found[k].points[i];
            const ManifoldPoint& q = expected[k].points[i];
            if ((p.point - q.point).norm() > tolerance || std::abs(p.distance - q.distance) > tolerance) {
                return ::testing::AssertionFailure() << "point " << p.point.transpose() << " at " << p.distance;
            }
        }
    }
    return ::testing::AssertionSuccess();
}

TEST(Surfaces, AreMetByWhateverIsDeepInThem) {
    // Triangles 20 cm wide, smaller than what gets into them.
    const auto height = [](double x, double y) { return 0.4 * std::sin(2 * x) * std::cos(3 * y); };
    const Mesh rough = irregularMesh(60, 12, 21, height);
    Random random(5);
    for (const auto& [name, shape] : solids()) {
        if (std::holds_alternative<Compound>(shape)) continue;  // whose middle may be in none of its parts
        for (int i = 0; i < samples(2000); ++i) {
            Vec3 at = random.vector(4);
            at.z() = height(at.x(), at.y()) + random.uniform(-0.02, 0.06);
            const Quat turn = random.orientation();
            const auto found = on(rough, shape, {at, turn});
            EXPECT_FALSE(found.empty()) << name << " " << i;
            // What is looked for farther away hides none of it.
            const auto ahead = on(rough, shape, {at, turn}, 0.3);
            EXPECT_TRUE(std::ranges::any_of(ahead,
                                            [](const Manifold& m) {
                                                return std::any_of(
                                                    m.points.begin(), m.points.begin() + m.size,
                                                    [](const ManifoldPoint& p) { return p.distance <= 0; });
                                            }))
                << name << " " << i;
            double upwards = -1;
            for (const Manifold& m : found) upwards = std::max(upwards, m.normal.z());
            EXPECT_GT(upwards, 0) << name << " " << i;
        }
    }
}

TEST(Surfaces, OfAPlaneTouchAsThePlaneDoes) {
    const Mesh mesh = flatMesh(40, 4);
    Random random(3);
    int touching = 0;
    for (const auto& [name, shape] : solids()) {
        for (int i = 0; i < 300; ++i) {
            const Quat turn = i % 2 == 0 ? random.orientation() : random.nearly(random.alignedOrientation());
            Pose pose{random.vector(1), turn};
            pose.position.z() = 0;
            pose.position.z() = random.uniform(-0.02, 0.002) - boundsOf(shape, pose).lower.z();
            const auto expected = manifoldsOf(shape, pose, HalfSpace{}, Pose{});
            EXPECT_TRUE(areSame(on(mesh, shape, pose), expected, 0)) << name << " " << i;
            touching += static_cast<int>(expected.size());
        }
    }
    EXPECT_GT(touching, 1000);
}

TEST(Surfaces, OfATiltedPlaneTouchAsThePlaneDoes) {
    const Mesh mesh = flatMesh(30, 4, 5);
    Random random(4);
    for (const auto& [name, shape] : solids()) {
        for (int i = 0; i < 100; ++i) {
            const Pose ground{random.vector(10), random.orientation()};
            Pose pose{random.vector(1), random.orientation()};
            pose.position.z() = 0;
            pose.position.z() = random.uniform(-0.02, 0.002) - boundsOf(shape, pose).lower.z();
            const Pose placed = ground.toOuter(pose);
            const auto found = manifoldsOf(shape, placed, mesh, ground);
            EXPECT_TRUE(areSame(found, manifoldsOf(shape, placed, HalfSpace{}, ground), 1e-13)) << name << " " << i;
        }
    }
}

TEST(Surfaces, AreTheSameForBothOrders) {
    const Mesh mesh = flatMesh(10, 4);
    const Pose pose = at({0.1, 0.2, 0.099});
    auto found = manifoldsOf(mesh, Pose{}, Box{{0.4, 0.3, 0.2}}, pose);
    for (Manifold& m : found) m.normal = -m.normal;
    EXPECT_TRUE(areSame(found, on(mesh, Box{{0.4, 0.3, 0.2}}, pose), 0));
}

TEST(Surfaces, WithinOneFaceABorderElsewhereChangesNothing) {
    // The top of a box of two triangles, on which all shapes stand away from its border.
    const Mesh table = boxMesh({4, 4, 1});
    Random random(8);
    for (const auto& [name, shape] : solids()) {
        for (int i = 0; i < 50; ++i) {
            Pose pose{random.vector(1.5), random.orientation()};
            pose.position.z() = 0;
            pose.position.z() = 0.5 + random.uniform(-0.01, 0.001) - boundsOf(shape, pose).lower.z();
            const auto expected = manifoldsOf(shape, pose, HalfSpace{Vec3::UnitZ(), 0.5}, Pose{});
            EXPECT_TRUE(areSame(on(table, shape, pose), expected, 1e-15)) << name << " " << i;
        }
    }
}

/// Triangles at the border are asked one by one: what they cut off within their face is no point of contact.
TEST(Surfaces, NearTheBorderOfAFaceTheyTouchWhereItsPlaneDoes) {
    const Mesh table = fineBoxMesh({4, 4, 1}, {30, 30, 6}, 2);
    constexpr double margin = 0.05;
    Random random(8);
    int several = 0;
    for (const auto& [name, shape] : solids()) {
        for (int i = 0; i < 200; ++i) {
            Pose pose{Vec3(0, random.uniform(-1, 1), 0), random.orientation()};
            const Bounds bounds = boundsOf(shape, pose);
            pose.position.x() = 2 - random.uniform(0, margin) - bounds.upper.x();
            pose.position.z() = 0.5 + random.uniform(-0.005, 0.005) - bounds.lower.z();
            const auto expected = manifoldsOf(shape, pose, HalfSpace{Vec3::UnitZ(), 0.5}, Pose{}, margin);
            for (const Manifold& m : on(table, shape, pose, margin)) {
                if (m.normal.z() < 1 - 1e-9) continue;
                several += m.size > 1 ? 1 : 0;
                for (std::size_t k = 0; k < m.size; ++k) {
                    double nearest = 1;
                    for (const Manifold& plane : expected) {
                        for (std::size_t l = 0; l < plane.size; ++l) {
                            nearest = std::min(nearest, (plane.points[l].point - m.points[k].point).norm());
                        }
                    }
                    EXPECT_LT(nearest, 1e-6) << name << " " << i << ", point " << m.points[k].point.transpose();
                }
            }
        }
    }
    EXPECT_GT(several, 100);
}

TEST(Surfaces, ABallOnARidgeTouchesTheEdgeInItsDirection) {
    const Mesh ridge = foldedMesh(-1, 7);
    for (const double degrees : {-44.0, -20.0, 0.0, 30.0, 44.0}) {
        const double turn = degrees / 180 * std::numbers::pi;
        const Vec3 up(std::sin(turn), 0, std::cos(turn));
        const auto found = on(ridge, Sphere{0.1}, at(Vec3(0, 0.013, 0) + 0.0995 * up));
        ASSERT_EQ(found.size(), 1U) << degrees;
        EXPECT_TRUE(touches(found[0], up, -0.0005, 1e-12));
    }
    // Beyond, the face has it.
    const auto found = on(ridge, Sphere{0.1}, at(Vec3(0.001, 0, -0.001) + 0.0995 * Vec3(1, 0, 1).normalized()));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(touches(found[0], Vec3(1, 0, 1).normalized(), found[0].points[0].distance, 1e-12));
}

TEST(Surfaces, ABallInAValleyTouchesBothSidesAndNotTheEdge) {
    const Mesh valley = foldedMesh(1, 9);
    const auto found = on(valley, Sphere{0.1}, at({0, 0.03, 0.0995 * std::sqrt(2)}));
    ASSERT_EQ(found.size(), 2U);
    for (const Manifold& m : found) {
        EXPECT_NEAR(std::abs(m.normal.x()), std::sqrt(0.5), 1e-12);
        EXPECT_NEAR(m.points[0].distance, -0.0005, 1e-12);
    }
}

/// In a narrow one it is over both sides at once: none of them is behind the other.
TEST(Surfaces, ACapsuleInANarrowValleyTouchesBothSides) {
    constexpr double slope = 3;
    const Mesh valley = foldedMesh(slope, 9);
    const Quat along(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));
    const double height = 0.1 * std::sqrt(1 + slope * slope);  // of an axis that is a radius from both
    for (const double aside : {0.0, 0.0005, -0.0005}) {
        const auto found = on(valley, Capsule{0.1, 0.3}, {{aside, 0.03, height - 0.01}, along});
        double least = 0;
        double most = 0;
        for (const Manifold& m : found) {
            least = std::min(least, m.normal.x());
            most = std::max(most, m.normal.x());
        }
        EXPECT_LT(least, -0.9) << aside;
        EXPECT_GT(most, 0.9) << aside;
    }
}

TEST(Surfaces, ABoxLiesOnARidgeWithTheEdgeAcrossItsFace) {
    for (const int cells : {1, 6, 50}) {
        const auto found = on(foldedMesh(-1, cells), Box{{0.4, 0.3, 0.2}}, at({0.05, 0.02, 0.0995}));
        double low = 1;
        double high = -1;
        for (const Manifold& m : found) {
            EXPECT_LT((m.normal - Vec3::UnitZ()).norm(), 1e-9);
            for (std::size_t i = 0; i < m.size; ++i) {
                EXPECT_NEAR(m.points[i].distance, -0.0005, 1e-9);
                EXPECT_NEAR(m.points[i].point.x(), 0, 1e-6);
                low = std::min(low, m.points[i].point.y());
                high = std::max(high, m.points[i].point.y());
            }
        }
        EXPECT_NEAR(low, -0.13, 1e-6) << cells;
        EXPECT_NEAR(high, 0.17, 1e-6) << cells;
    }
}

TEST(Surfaces, ABoxOverTheEdgeOfATableTouchesItsTopOnly) {
    const Mesh table = boxMesh({2, 2, 0.5});
    // It reaches over the edge; its lower corners are far behind the side of the table, which it does not touch.
    const auto found = on(table, Box{{0.4, 0.3, 0.2}}, at({0.9, 0.1, 0.3495}));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(touches(found[0], Vec3::UnitZ(), -0.0005, 1e-9));
    EXPECT_TRUE(hasPoints(
        found[0], {{0.7, -0.05, 0.24975}, {0.7, 0.25, 0.24975}, {1, -0.05, 0.24975}, {1, 0.25, 0.24975}}, 1e-9));
}

TEST(Surfaces, NothingIsStoppedAtASeamOfANearlyFlatValley) {
    // A box that slides over the bend upwards touches faces only: no contact looks back along its way.
    const Mesh bend = foldedMesh(0.01, 5);
    Random random(9);
    for (int i = 0; i < 200; ++i) {
        const Pose pose{Vec3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(0.098, 0.103)),
                        Quat(Eigen::AngleAxisd(random.uniform(0, 6), Vec3::UnitZ()))};
        for (const Manifold& m : on(bend, Box{{0.4, 0.3, 0.2}}, pose)) EXPECT_GT(m.normal.z(), 0.999) << i;
    }
}

TEST(Surfaces, OfOneSideBringBackWhatGotBehindAndOfTwoSidesKeepIt) {
    const Mesh one = flatMesh(20, 4);
    const Mesh two = irregularMesh(
        20, 4, 1, [](double, double) { return 0.0; }, SurfaceSides::two);
    const Pose behind = at({0.1, 0.1, -0.05});
    EXPECT_TRUE(touches(on(one, Sphere{0.1}, behind).at(0), Vec3::UnitZ(), -0.15));
    EXPECT_TRUE(touches(on(two, Sphere{0.1}, behind).at(0), -Vec3::UnitZ(), -0.05));
    EXPECT_TRUE(on(one, Sphere{0.1}, at({0, 0, -0.11})).empty()) << "it is through";
    EXPECT_TRUE(touches(on(two, Box{{0.2, 0.2, 0.2}}, behind).at(0), -Vec3::UnitZ(), -0.05));
    EXPECT_TRUE(touches(on(one, Box{{0.2, 0.2, 0.2}}, behind).at(0), Vec3::UnitZ(), -0.15));
}

TEST(Surfaces, ABoxOnABoxOfTrianglesTouchesAsOnABox) {
    const Mesh mesh = boxMesh({1, 1, 1});
    Random random(12);
    int compared = 0;
    for (int i = 0; i < 12000; ++i) {
        const Pose pose{random.vector(0.9), random.orientation()};
        const Manifold expected = contactOf(Box{{0.4, 0.3, 0.2}}, pose, Box{{1, 1, 1}}, Pose{});
        if (expected.size == 0 || deepest(expected) < -0.01) continue;
        const auto found = on(mesh, Box{{0.4, 0.3, 0.2}}, pose);
        ASSERT_FALSE(found.empty()) << i;
        double least = 1;
        double cosine = -1;
        for (const Manifold& m : found) {
            least = std::min(least, deepest(m));
            cosine = std::max(cosine, m.normal.dot(expected.normal));
        }
        // Where an edge overlaps, either of two faces may be the nearer one.
        EXPECT_GT(least, deepest(expected) - 1e-3) << i;
        EXPECT_LT(least, std::max(1.01e-4, 0.5 * deepest(expected))) << i;
        if (std::abs(least - deepest(expected)) < 1e-6) {
            EXPECT_GT(cosine, 0.99) << i;
        }
        ++compared;
    }
    EXPECT_GT(compared, 100);
}

TEST(Surfaces, AnyPoseOnRoughGroundGivesFiniteNumbers) {
    const Mesh rough =
        irregularMesh(20, 4, 2, [](double x, double y) { return 0.1 * std::sin(5 * x) * std::cos(7 * y); });
    Random random(6);
    for (const auto& [name, shape] : solids()) {
        for (int i = 0; i < 200; ++i) {
            const Pose pose{random.vector(1).cwiseProduct(Vec3(1, 1, 0.3)), random.orientation()};
            for (const Manifold& m : on(rough, shape, pose, 0.05)) {
                EXPECT_NEAR(m.normal.norm(), 1, 1e-9);
                EXPECT_GT(m.size, 0U);
                for (std::size_t k = 0; k < m.size; ++k) {
                    EXPECT_TRUE(m.points[k].point.allFinite() && m.points[k].distance <= 0.0501) << name;
                }
            }
        }
    }
}

}  // namespace
}  // namespace cairn::testing
