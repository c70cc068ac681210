#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "broad_phase/all_pairs.h"
#include "broad_phase/hash_grids.h"
#include "broad_phase/scenes.h"

namespace cairn {
namespace {

using broad_phase_tests::allPairs;
using broad_phase_tests::allSizes;
using broad_phase_tests::Bodies;
using broad_phase_tests::densePile;
using broad_phase_tests::Random;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<BodyPair> pairsOf(HashGrids& broad_phase, const Bodies& bodies, int threads = 1) {
    std::vector<BodyPair> pairs = {{7, 3}};  // what was there before must vanish
    broad_phase.findPairs(bodies.input(), Executor(threads), pairs);
    return pairs;
}

std::vector<BodyPair> gridPairs(const Bodies& bodies, int threads = 1) {
    HashGrids grids;
    return pairsOf(grids, bodies, threads);
}

/// @param at_least how many pairs there must be for the comparison to mean something
void expectEqualToAllPairs(const Bodies& bodies, std::size_t at_least) {
    const auto expected = allPairs(bodies.input());
    EXPECT_GE(expected.size(), at_least);
    EXPECT_EQ(gridPairs(bodies), expected);
}

TEST(AllPairs, FindsExactlyTheOverlappingPairs) {
    Bodies bodies;
    bodies.add(Vec3(0, 0, 0), Vec3::Constant(1), BodyKind::fixed);
    bodies.add(Vec3(1, 1, 1), Vec3::Constant(1));
    bodies.add(Vec3(1, 1, 1), Vec3::Constant(1), BodyKind::hole);
    bodies.add(Vec3(3, 1, 1), Vec3::Constant(1));                   // touches 1 with a face
    bodies.add(Vec3(0, 0, 0), Vec3::Constant(1), BodyKind::fixed);  // overlaps 0, both fixed
    bodies.add(Vec3(5.1, 1, 1), Vec3::Constant(1));                 // misses 3
    EXPECT_EQ(allPairs(bodies.input()), (std::vector<BodyPair>{{0, 1}, {1, 3}, {1, 4}}));
}

TEST(HashGrids, NoneOneAndTwoBodies) {
    Bodies bodies;
    EXPECT_TRUE(gridPairs(bodies).empty());
    bodies.add(Vec3(1, 2, 3), Vec3::Constant(0.5));
    EXPECT_TRUE(gridPairs(bodies).empty());
    bodies.add(Vec3(1.5, 2, 3), Vec3::Constant(0.5));
    EXPECT_EQ(gridPairs(bodies), (std::vector<BodyPair>{{0, 1}}));
    bodies.bounds[1] = {Vec3(9, 9, 9), Vec3(10, 10, 10)};
    EXPECT_TRUE(gridPairs(bodies).empty());
}

TEST(HashGrids, LeaveOutPairsOfStillBodies) {
    for (const std::size_t one_of : {1, 2, 7, 100}) {
        SCOPED_TRACE(one_of);
        Random random(one_of);
        Bodies bodies = allSizes(random, 600, 0.01, Vec3::Zero());
        bodies.add({Vec3(-inf, -inf, -inf), Vec3(inf, inf, 0)}, BodyKind::fixed);
        const auto all = allPairs(bodies.input());
        for (std::size_t i = 0; i < bodies.size(); ++i) bodies.still.push_back(random.below(one_of) == 0 ? 0 : 1);
        std::vector<BodyPair> expected;
        for (const BodyPair& pair : all) {
            if (bodies.still[pair.a] == 0 || bodies.still[pair.b] == 0) expected.push_back(pair);
        }
        ASSERT_GT(expected.size(), 2U);
        EXPECT_EQ(allPairs(bodies.input()), expected);
        EXPECT_EQ(gridPairs(bodies, 3), expected);
    }
}

TEST(HashGrids, EqualAllPairsOnDensePilesEverywhere) {
    Random random(2);
    for (const double far : {0.0, 1e3, -1e6, 1e9, -1e12}) {
        SCOPED_TRACE(far);
        Bodies bodies = densePile(random, 9, Vec3(far, -far, 0.5 * far));
        bodies.shuffle(random);
        expectEqualToAllPairs(bodies, 1500);
    }
}

TEST(HashGrids, EqualAllPairsWithSizesOneToAThousand) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Random random(seed);
        SCOPED_TRACE(seed);
        expectEqualToAllPairs(allSizes(random, 1200, 0.001, Vec3::Zero()), 1000);
        expectEqualToAllPairs(allSizes(random, 1200, 0.001, Vec3(1e6, -3e6, 2e7)), 1000);
    }
}

TEST(HashGrids, TheSmallestAndTheLargestBodiesMeet) {
    Random random(3);
    Bodies bodies;
    for (int i = 0; i < 20; ++i) bodies.add(random.inBox(4000), Vec3::Constant(500));
    for (int i = 0; i < 600; ++i) {
        // On the surface of a large body, inside or outside by half a small one.
        const Bounds large = bodies.bounds[random.below(20)];
        Vec3 at = large.lower + (large.upper - large.lower).cwiseProduct(random.inBox(0.5) + Vec3::Constant(0.5));
        at[static_cast<Eigen::Index>(random.below(3))] = (random.below(2) == 0 ? large.lower : large.upper).x();
        bodies.add(at, Vec3::Constant(0.5));
    }
    bodies.shuffle(random);
    expectEqualToAllPairs(bodies, 200);
}

TEST(HashGrids, EqualAllPairsOnCellBoundaries) {
    // All corners are small multiples of a power of two: bodies touch exactly, on both sides of the origin.
    for (const double unit : {1.0, 0.25, 3.0, 0.1}) {
        SCOPED_TRACE(unit);
        Random random(4);
        Bodies bodies;
        for (int i = 0; i < 700; ++i) {
            const auto whole = [&] { return static_cast<double>(random.below(13)) - 6; };
            const double x = whole();
            const double y = whole();
            const double z = whole();
            const double size = std::ldexp(1.0, static_cast<int>(random.below(3)));
            bodies.add(Bounds{unit * Vec3(x, y, z), unit * (Vec3(x, y, z) + Vec3::Constant(size))});
        }
        expectEqualToAllPairs(bodies, 5000);
    }
}

TEST(HashGrids, EqualAllPairsWhenAllAreInOneCell) {
    Random random(5);
    Bodies plates;  // thin in one direction, so hundreds fit into a cell without touching
    for (int i = 0; i < 400; ++i) {
        Vec3 half = Vec3::Constant(0.5);
        half[i % 3] = 1e-4;
        plates.add(0.3 * random.inBox(1), half, i % 5 == 0 ? BodyKind::fixed : BodyKind::dynamic);
    }
    expectEqualToAllPairs(plates, 1000);

    Bodies same;
    for (int i = 0; i < 200; ++i) same.add(Vec3(-3, 7, 1e5), Vec3(0.1, 0.2, 0.3));
    EXPECT_EQ(gridPairs(same).size(), 200u * 199u / 2);
    expectEqualToAllPairs(same, 200 * 199 / 2);
}

TEST(HashGrids, EqualAllPairsWithPointsPlatesAndNeedles) {
    Random random(6);
    Bodies bodies;
    for (int i = 0; i < 600; ++i) {
        Vec3 half(random.logUniform(1e-6, 1), random.logUniform(1e-6, 1), random.logUniform(1e-6, 1));
        if (random.below(3) == 0) half[static_cast<Eigen::Index>(random.below(3))] = 0;
        if (random.below(10) == 0) half.setZero();
        bodies.add(random.inBox(1), half);
    }
    for (int i = 0; i < 20; ++i) bodies.add(Vec3::Zero(), Vec3::Zero());  // points, all in the origin
    expectEqualToAllPairs(bodies, 200);
}

TEST(HashGrids, EqualAllPairsWithInfiniteBodies) {
    Random random(7);
    Bodies bodies = densePile(random, 6);
    for (int i = 0; i < 6; ++i) bodies.add(Bounds{}, BodyKind::fixed);
    bodies.add(Bounds{}, BodyKind::dynamic);
    bodies.add(Bounds{Vec3(-inf, -inf, -inf), Vec3(inf, inf, 2.5)}, BodyKind::fixed);
    bodies.add(Bounds{Vec3(1, 2, 3), Vec3(2, inf, 4)}, BodyKind::dynamic);
    bodies.shuffle(random);
    expectEqualToAllPairs(bodies, 216 * 7);
}

TEST(HashGrids, BoundsThatAreNotNumbersOrInsideOutTouchWhatTheOracleSays) {
    Random random(8);
    Bodies bodies = densePile(random, 5);
    const auto before = gridPairs(bodies);
    bodies.add(Bounds{Vec3(nan, 0, 0), Vec3(1, 1, 1)});
    bodies.add(Bounds{Vec3(0, 0, 0), Vec3(1, nan, 1)});
    EXPECT_EQ(gridPairs(bodies), before);
    bodies.add(Bounds{Vec3(3, 3, 3), Vec3(2.8, 2.8, 2.8)});
    bodies.add(Bounds{Vec3(-1e308, -1e308, -1e308), Vec3(1e308, 1e308, 1e308)});
    bodies.shuffle(random);
    expectEqualToAllPairs(bodies, before.size() + 125);
}

TEST(HashGrids, EqualAllPairsWithLargeFixedBoxes) {
    Random random(9);
    Bodies bodies = densePile(random, 8);
    for (int side = 0; side < 5; ++side) {  // a well
        Vec3 centre = Vec3::Constant(3.5);
        Vec3 half = Vec3::Constant(5);
        centre[side % 3] = side < 3 ? -0.5 : 7.5;
        half[side % 3] = 0.2;
        bodies.add(centre, half, BodyKind::fixed);
    }
    for (int x = 0; x < 12; ++x) {  // a tiled floor
        for (int y = 0; y < 12; ++y) bodies.add(Vec3(4 * x - 20, 4 * y - 20, -1.4), Vec3(2, 2, 1), BodyKind::fixed);
    }
    bodies.shuffle(random);
    expectEqualToAllPairs(bodies, 1000);
}

TEST(HashGrids, HolesAreInNoPair) {
    Random random(10);
    Bodies bodies = densePile(random, 8);
    for (int i = 0; i < 5; ++i) bodies.add(Bounds{}, BodyKind::fixed);
    bodies.shuffle(random);
    for (std::size_t i = 0; i < bodies.size(); i += 1 + random.below(4)) {
        bodies.kind[i] = BodyKind::hole;
        if (i % 2 == 0) bodies.bounds[i].lower.setConstant(nan);  // whatever is left there must not matter
    }
    expectEqualToAllPairs(bodies, 300);
    for (const BodyPair& pair : gridPairs(bodies)) {
        EXPECT_NE(bodies.kind[pair.a], BodyKind::hole);
        EXPECT_NE(bodies.kind[pair.b], BodyKind::hole);
    }
}

TEST(HashGrids, EqualAllPairsWithMoreLevelsThanTheHierarchyHas) {
    Random random(11);
    Bodies bodies;
    for (int octave = -60; octave < 30; octave += 1) {
        for (int i = 0; i < 12; ++i) {
            bodies.add(random.inBox(1) * std::ldexp(1.0, octave), Vec3::Constant(std::ldexp(0.3, octave)));
        }
    }
    bodies.shuffle(random);
    expectEqualToAllPairs(bodies, 10000);
}

TEST(HashGrids, AnInstanceForgetsTheStepBefore) {
    HashGrids grids;
    Random random(12);
    const Bodies large = allSizes(random, 800, 0.01, Vec3::Zero());
    const Bodies small = densePile(random, 3, Vec3(50, 0, 0));
    for (int round = 0; round < 2; ++round) {
        EXPECT_EQ(pairsOf(grids, large), allPairs(large.input()));
        EXPECT_EQ(pairsOf(grids, small), allPairs(small.input()));
        EXPECT_TRUE(pairsOf(grids, Bodies{}).empty());
    }
}

TEST(HashGrids, AreTheSameOnAnyNumberOfThreads) {
    Random random(13);
    Bodies bodies = allSizes(random, 12000, 0.001, Vec3(10, 20, -30));
    for (int i = 0; i < 3; ++i) bodies.add(Bounds{}, BodyKind::fixed);
    bodies.shuffle(random);
    const auto expected = gridPairs(bodies);
    ASSERT_GT(expected.size(), 40000u) << "few pairs are sorted by one thread";
    for (const int threads : {2, 3, 4, 8}) EXPECT_EQ(gridPairs(bodies, threads), expected);
}

TEST(HashGrids, LevelsGrowWithTheSizeAndInfiniteBodiesHaveNone) {
    Bodies bodies;
    for (int level = 0; level < 6; ++level) {
        for (int i = 0; i < 20; ++i) bodies.add(Vec3(100 * i, 0, 0), Vec3::Constant(std::ldexp(0.01, 2 * level)));
    }
    bodies.add(Bounds{}, BodyKind::fixed);
    bodies.add(Vec3::Zero(), Vec3::Ones(), BodyKind::hole);
    HashGrids grids;
    EXPECT_EQ(grids.level(0), -1) << "before the first step nobody is in a level";
    pairsOf(grids, bodies);
    for (BodyIndex i = 0; i < 120; ++i) EXPECT_EQ(grids.level(i), static_cast<int>(i / 20)) << i;
    EXPECT_EQ(grids.level(120), -1);
    EXPECT_EQ(grids.level(121), -1);
    EXPECT_EQ(grids.level(122), -1) << "beyond the last slot";
}

}  // namespace
}  // namespace cairn
