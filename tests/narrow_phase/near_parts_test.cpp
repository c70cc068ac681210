/// Compounds of many parts: a tree over them changes no bit of what is found, and few parts are asked.
#include "narrow_phase/near_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "narrow_phase/narrow_phase.h"
#include "narrow_phase/parts_near_triangles.h"
#include "surface_maker.h"

namespace cairn::testing {
namespace {

/// Boxes and balls beside and above each other. @param rows along each axis
Compound blocks(int rows) {
    Compound compound;
    for (int i = 0; i < rows * rows * rows; ++i) {
        const Vec3 at(0.11 * (i % rows), 0.12 * (i / rows % rows), 0.1 * (i / rows / rows));
        const Quat turn = Quat(1, 0.01 * (i % 7), 0.02 * (i % 5), -0.01 * (i % 3)).normalized();
        const Shape shape = i % 3 == 0 ? Shape(Sphere{0.06}) : Shape(Box{{0.1, 0.11, 0.09}});
        compound.parts.push_back({shape, {at, turn}, {}, {}});
    }
    return compound;
}

Shape indexed(const Compound& compound) {
    Shape shape = compound;
    indexParts(shape);
    return shape;
}

Mesh roughMesh(int cells, double edge) {
    return irregularMesh(cells, edge, 5, [](double x, double y) { return 0.1 * std::sin(5 * x) * std::cos(7 * y); });
}

/// Everything that is found, number by number.
std::vector<double> numbersOf(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
    std::vector<double> found;
    Manifold manifold;
    forEachManifold(a, pose_a, b, pose_b, 0.01, manifold, [&](const Manifold& m) {
        found.insert(found.end(), m.normal.begin(), m.normal.end());
        for (std::size_t i = 0; i < m.size; ++i) {
            found.insert(found.end(), m.points[i].point.begin(), m.points[i].point.end());
            found.push_back(m.points[i].distance);
        }
    });
    return found;
}

TEST(PartsOfCompounds, ATreeChangesNoBitOfWhatIsFound) {
    const Compound plain = blocks(6);
    const Shape with_tree = indexed(plain);
    const Shape small = indexed(blocks(3));
    std::vector<std::pair<const char*, Shape>> others = solids();
    others.emplace_back("plane", HalfSpace{Vec3(0.1, 0.2, 2), 0.05});
    others.emplace_back("mesh", flatMesh(6, 3));
    others.emplace_back("rough mesh", roughMesh(20, 3));
    others.emplace_back("blocks", small);
    Random random(11);
    for (const Vec3& far : {Vec3(0, 0, 0), Vec3(3e5, -2e5, 1e5)}) {
        std::size_t numbers = 0;
        for (const auto& [name, other] : others) {
            for (int i = 0; i < 100; ++i) {
                const Pose pose{far + random.vector(0.3), random.orientation()};
                const Pose other_pose{far + random.vector(0.6), random.orientation()};
                const auto expected = numbersOf(plain, pose, other, other_pose);
                EXPECT_EQ(numbersOf(with_tree, pose, other, other_pose), expected) << name << " " << i;
                EXPECT_EQ(numbersOf(other, other_pose, with_tree, pose), numbersOf(other, other_pose, plain, pose));
                EXPECT_EQ(boundsOf(with_tree, pose).lower, boundsOf(plain, pose).lower);
                EXPECT_EQ(boundsOf(with_tree, pose).upper, boundsOf(plain, pose).upper);
                numbers += expected.size();
            }
        }
        EXPECT_GT(numbers, 10000U);
    }
}

TEST(PartsOfCompounds, FewOfAThousandAreAsked) {
    const Shape shape = indexed(blocks(10));
    const auto& compound = std::get<Compound>(shape);
    const Pose pose{Vec3(1, 2, 3), Quat(0.9, 0.1, 0.2, 0.3).normalized()};
    const Shape ball = Sphere{0.05};
    const Pose inside{pose.toOuter(Vec3(0.5, 0.5, 0.5)), Quat::Identity()};
    EXPECT_LT(NearParts(compound, pose, ball, inside, boundsOf(ball, inside), 0.001).count(), 40U);
    // A plane that cuts off a corner.
    const Shape ground = HalfSpace{Vec3::UnitZ(), boundsOf(shape, pose).lower.z() + 0.1};
    const NearParts near(compound, pose, ground, Pose{}, boundsOf(ground, Pose{}), 0.001);
    EXPECT_GT(near.count(), 0U);
    EXPECT_LT(near.count(), 30U);
}

TEST(PartsOfCompounds, NearTrianglesAreFoundByBothTrees) {
    const Shape shape = indexed(blocks(10));
    const auto& compound = std::get<Compound>(shape);
    const Mesh mesh = roughMesh(100, 3);
    const SurfaceData& surface = mesh.data();
    Random random(17);
    std::size_t most = 0;
    for (int i = 0; i < 20; ++i) {
        const Pose pose{random.vector(0.7), random.orientation()};
        const auto near = partsNearTriangles(compound, pose, surface, 0.01);
        EXPECT_TRUE(std::ranges::is_sorted(near));
        most = std::max(most, near.size());
        for (std::uint32_t part = 0; part < compound.parts.size(); ++part) {
            const CompoundPart& p = compound.parts[part];
            const Bounds bounds = boundsOf(p.shape, pose.toOuter(p.pose)).grown(0.01);
            surface.tree.forEachOverlapping(bounds, [&](std::uint32_t triangle) {
                EXPECT_TRUE(std::ranges::binary_search(near, PartNearTriangle{part, triangle})) << part;
            });
        }
    }
    EXPECT_GT(most, 1000U);
    EXPECT_LT(most, 50000U);  // of 20 million pairs
    EXPECT_TRUE(partsNearTriangles(compound, {Vec3(0, 0, 5), Quat::Identity()}, surface, 0.01).empty());
}

}  // namespace
}  // namespace cairn::testing
