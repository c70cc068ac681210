/// Concave solids in convex parts: nothing is left out, the error is what is said, mass and inertia are those of the
/// mesh.
#include "cairn/decompose.h"

#include <gtest/gtest.h>

#include <string>

#include "geometry/compound_mass.h"
#include "geometry/convex_part.h"
#include "geometry/geometry.h"
#include "geometry/hull_data.h"
#include "narrow_phase/pair_random.h"
#include "solid_maker.h"

namespace cairn {
namespace {

using testing::Cell;
using testing::Random;
using testing::Triangles;

const std::set<Cell> angle_cells = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};

std::set<Cell> openBoxCells() {
    std::set<Cell> cells;
    for (int x = 0; x < 5; ++x) {
        for (int y = 0; y < 5; ++y) {
            for (int z = 0; z < 4; ++z) {
                if (z == 0 || x == 0 || y == 0 || x == 4 || y == 4) cells.insert({x, y, z});
            }
        }
    }
    return cells;
}

const HullData& hullOfPart(const CompoundPart& part) {
    return std::get<ConvexHull>(part.shape).data();
}

/// Whether some part holds a point.
bool holds(const Compound& compound, const Vec3& p, double tolerance) {
    return std::ranges::any_of(compound.parts, [&](const CompoundPart& part) {
        const HullData& hull = hullOfPart(part);
        return std::ranges::all_of(hull.faces,
                                   [&](const HullFace& face) { return face.normal.dot(p) <= face.offset + tolerance; });
    });
}

std::string refusal(const Mesh& mesh, const DecompositionOptions& options = {}) {
    try {
        decompose(mesh, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// Mass properties of cubes of 1 m, put together one by one.
UnitMassProperties ofCubes(const std::set<Cell>& cells) {
    Compound compound;
    for (const Cell& c : cells) {
        compound.parts.push_back({Box{Vec3::Ones()}, {Vec3(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5)}, {}, {}});
    }
    return unitMassProperties(compound);
}

Mat3 inertiaOf(const UnitMassProperties& p) {
    const Mat3 axes = p.axes.toRotationMatrix();
    return axes * p.inertia_volume.asDiagonal() * axes.transpose();
}

TEST(Decomposition, DividesAnAngleIntoTwoPartsWithoutAnyError) {
    const Quat turn = Quat(0.3, 0.4, -0.5, 0.7).normalized();
    const Triangles angle = testing::cubes(angle_cells);
    for (const Triangles& placed : {angle, angle.placed(turn, 1, Vec3(3, 4, 5)), angle.placed(turn, 1e-4, Vec3::Zero()),
                                    angle.placed(turn, 1e7, Vec3::Zero()), angle.placed(turn, 1, Vec3(1e5, 0, 0))}) {
        const Decomposition found = decompose(placed.mesh());
        EXPECT_EQ(found.compound.parts.size(), 2U);
        EXPECT_NEAR(found.error, 0, 1e-11);
        EXPECT_FALSE(found.turned);
    }
}

TEST(Decomposition, FindsTheFewestPartsOfWhatCubesMake) {
    EXPECT_EQ(decompose(testing::cubes({{0, 0, 0}}).mesh()).compound.parts.size(), 1U);
    const Decomposition box = decompose(testing::cubes(openBoxCells()).mesh());
    EXPECT_EQ(box.compound.parts.size(), 5U);
    EXPECT_NEAR(box.volume, 73, 1e-9);
    EXPECT_NEAR(box.error, 0, 1e-12);
    std::set<Cell> comb;
    for (int i = 0; i < 21; ++i) {
        comb.insert({i, 0, 0});
        if (i % 2 == 0) comb.insert({i, 0, 1});
    }
    EXPECT_EQ(decompose(testing::cubes(comb).mesh()).compound.parts.size(), 12U);
    const Decomposition coarse = decompose(testing::cubes(comb).mesh(), {.most_parts = 5});
    EXPECT_EQ(coarse.compound.parts.size(), 5U);
    EXPECT_GT(coarse.error, 0.1);
}

TEST(Decomposition, KeepsMassCentreAndInertiaOfTheMesh) {
    for (const std::set<Cell>& cells : {angle_cells, openBoxCells()}) {
        const UnitMassProperties exact = ofCubes(cells);
        for (const int parts : {64, 1}) {
            const Decomposition found = decompose(testing::cubes(cells).mesh(), {.most_parts = parts});
            const UnitMassProperties mass = unitMassProperties(found.compound);
            EXPECT_NEAR(mass.volume, exact.volume, 1e-12 * exact.volume);
            EXPECT_LT((mass.centre - exact.centre).norm(), 1e-12);
            EXPECT_LT((inertiaOf(mass) - inertiaOf(exact)).norm(), 1e-12 * inertiaOf(exact).norm());
        }
    }
    // A ring: volume 2π²Rr², moment about its axis (R² + ¾r²) of the mass; a polygon of n corners has a little less.
    const Decomposition ring = decompose(testing::torus(1, 0.3, 60, 40).mesh(), {.largest_error = 0.5});
    const double volume = 2 * std::numbers::pi * std::numbers::pi * 0.09;
    EXPECT_NEAR(ring.volume, volume, 8e-3 * volume);
    EXPECT_NEAR(ring.compound.solid->inertia(2, 2), (1 + 0.75 * 0.09) * volume, 1.5e-2 * volume);
}

TEST(Decomposition, LeavesOutNothingAndAddsNoMoreThanAllowed) {
    const double large = 1;
    const double small = 0.3;
    const Mesh mesh = testing::torus(large, small, 48, 24).mesh();
    Random random(3);
    for (const double allowed : {0.1, 0.03}) {
        const Decomposition found = decompose(mesh, {.largest_error = allowed});
        EXPECT_LE(found.error, allowed);
        EXPECT_GT(found.error, 0);
        EXPECT_NEAR(volumeErrorOf(found.compound), found.error, 1e-12);
        EXPECT_NEAR(found.parts_volume, (1 + found.error) * found.volume, 1e-12);
        for (int i = 0; i < 2000; ++i) {
            // Inside the polygons, which lie within the round ring.
            const double r = 0.98 * small * random.uniform(0, 1);
            const double around = random.uniform(0, 6.3);
            const double along = random.uniform(0, 6.3);
            const double from_axis = 0.997 * large + 0.98 * r * std::cos(around);
            const Vec3 p(from_axis * std::cos(along), from_axis * std::sin(along), 0.98 * r * std::sin(around));
            ASSERT_TRUE(holds(found.compound, p, 1e-9)) << p.transpose();
        }
        EXPECT_FALSE(holds(found.compound, Vec3::Zero(), 0));
    }
    const Decomposition box = decompose(testing::cubes(openBoxCells()).mesh());
    for (const double z : {1.1, 2.5, 3.9}) EXPECT_FALSE(holds(box.compound, Vec3(2.5, 2.5, z), 0));
}

/// What compares planes: never larger than the hull, and not much smaller, flat and round and long ones alike.
TEST(Decomposition, EstimatesOfHullsAreALittleTooSmall) {
    std::vector<Vec3> corners;
    for (const double x : {-3.0, 1.0})
        for (const double y : {0.0, 0.01})
            for (const double z : {5.0, 6.0}) corners.emplace_back(x, y, z);
    EXPECT_NEAR(volumeWithin(corners), 0.04, 1e-12);
    EXPECT_EQ(farthestOf(corners).size(), 8U);
    Random random(5);
    for (const Vec3& half : {Vec3(1, 1, 1), Vec3(20, 1, 0.1), Vec3(1e-3, 3e-3, 2e-3)}) {
        std::vector<Vec3> ball;
        std::vector<Vec3> cloud;
        for (int i = 0; i < 4000; ++i) {
            const Vec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            ball.push_back(Vec3(7, 0, -2) + p.normalized().cwiseProduct(half));
            cloud.push_back(p.cwiseProduct(half));
        }
        for (const std::vector<Vec3>& points : {ball, cloud}) {
            const double hull = buildHull(points).mass.volume;
            const std::vector<Vec3> far = farthestOf(points);
            EXPECT_LE(far.size(), 600U);
            EXPECT_LE(volumeWithin(far), hull);
            EXPECT_GT(volumeWithin(far), 0.92 * hull);
        }
    }
    EXPECT_EQ(volumeWithin({}), 0);
    EXPECT_EQ(volumeWithin({Vec3::Ones(), Vec3::Ones()}), 0);
}

/// Planes of parts with many points are chosen by estimates, which must not cost parts.
TEST(Decomposition, FineMeshesTakeAsFewPartsAsCoarseOnes) {
    const Decomposition coarse = decompose(testing::torus(1, 0.2, 24, 9).mesh(), {.largest_error = 0.1});
    const Decomposition fine = decompose(testing::torus(1, 0.2, 96, 38).mesh(), {.largest_error = 0.1});
    EXPECT_LE(fine.error, 0.1);
    EXPECT_LE(fine.compound.parts.size(), coarse.compound.parts.size() + 1);
}

TEST(Decomposition, SolidsWithCavitiesAndThoseThatTouchThemselves) {
    std::set<Cell> hollow;
    for (int i = 0; i < 27; ++i) hollow.insert({i % 3, i / 3 % 3, i / 9});
    hollow.erase({1, 1, 1});
    const Decomposition shell = decompose(testing::cubes(hollow).mesh(), {.largest_error = 0});
    EXPECT_NEAR(shell.volume, 26, 1e-12);
    EXPECT_NEAR(shell.error, 0, 1e-12);
    EXPECT_FALSE(holds(shell.compound, Vec3(1.5, 1.5, 1.5), -0.4));
    // Two cubes that share an edge, and two that share a corner.
    for (const Cell& other : {Cell{1, 1, 0}, Cell{1, 1, 1}}) {
        const Decomposition pair = decompose(testing::cubes({{0, 0, 0}, other}).mesh());
        EXPECT_EQ(pair.compound.parts.size(), 2U);
        EXPECT_NEAR(pair.volume, 2, 1e-12);
    }
}

TEST(Decomposition, WhatIsInsideOutIsTurned) {
    Triangles angle = testing::cubes(angle_cells);
    angle.turnInsideOut();
    const Decomposition found = decompose(angle.mesh());
    EXPECT_TRUE(found.turned);
    EXPECT_NEAR(found.volume, 3, 1e-12);
    EXPECT_EQ(found.compound.parts.size(), 2U);
    EXPECT_LT((found.compound.solid->centre - ofCubes(angle_cells).centre).norm(), 1e-12);
    // One piece that is inside out beside another cannot be told from a cavity that is nowhere.
    Triangles both = testing::cubes({{0, 0, 0}});
    Triangles other = testing::cubes({{5, 0, 0}});
    other.turnInsideOut();
    for (const TriangleCorners& t : other.corners) {
        const auto first = static_cast<std::uint32_t>(24);
        both.corners.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
    EXPECT_NE(refusal(both.mesh()), "");
}

TEST(Decomposition, NamesTheHolesOfAMeshOrTakesItsHull) {
    Triangles open = testing::cubes(angle_cells);
    open.corners.pop_back();
    const std::string why = refusal(open.mesh());
    EXPECT_NE(why.find("3 open edges around 1 hole"), std::string::npos) << why;
    EXPECT_NE(why.find("the first at ("), std::string::npos) << why;
    EXPECT_NE(why.find("hull_if_open"), std::string::npos) << why;
    const Decomposition hull = decompose(open.mesh(), {.hull_if_open = true});
    EXPECT_TRUE(hull.took_hull);
    EXPECT_EQ(hull.compound.parts.size(), 1U);
    EXPECT_NEAR(hull.volume, 3.5, 1e-12);
    Triangles wrong = testing::cubes(angle_cells);
    std::swap(wrong.corners[3][1], wrong.corners[3][2]);
    EXPECT_NE(refusal(wrong.mesh()).find("look to opposite sides"), std::string::npos);
    EXPECT_NE(refusal(open.mesh(), {.largest_error = -1}).find("largest_error"), std::string::npos);
    EXPECT_NE(refusal(open.mesh(), {.most_parts = 0}).find("most_parts"), std::string::npos);
}

TEST(Decomposition, IsTheSameToTheLastBit) {
    const Mesh mesh = testing::bowl(1, 0.7, 16, 6).mesh();
    const Decomposition first = decompose(mesh, {.largest_error = 0.1});
    const Decomposition second = decompose(mesh, {.largest_error = 0.1});
    ASSERT_EQ(first.compound.parts.size(), second.compound.parts.size());
    for (std::size_t i = 0; i < first.compound.parts.size(); ++i) {
        EXPECT_EQ(hullOfPart(first.compound.parts[i]).corners, hullOfPart(second.compound.parts[i]).corners);
    }
}

TEST(Decomposition, ACompoundThatStandsForASolidHasNoOtherMass) {
    Compound compound = decompose(testing::cubes(angle_cells).mesh()).compound;
    EXPECT_NO_THROW(validateShape(compound));
    compound.parts[1].density = 5;
    EXPECT_THROW(validateShape(compound), InputError);
    compound.parts[1].density.reset();
    compound.solid->volume = 0;
    EXPECT_THROW(validateShape(compound), InputError);
    compound.solid->volume = 1;
    compound.solid->inertia = Mat3::Zero();
    EXPECT_THROW(validateShape(compound), InputError);
}

}  // namespace
}  // namespace cairn
