#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "broad_phase/hash_grids.h"
#include "broad_phase/scenes.h"

namespace cairn {
namespace {

using broad_phase_tests::allSizes;
using broad_phase_tests::Bodies;
using broad_phase_tests::densePile;
using broad_phase_tests::Random;

std::vector<BodyPair> gridPairs(HashGrids& grids, const Bodies& bodies) {
    std::vector<BodyPair> pairs;
    grids.findPairs(bodies.input(), Executor(1), pairs);
    return pairs;
}

/// Sweep along x with a list of the bodies that the sweep is in: shares nothing with the grids, and is fast enough.
std::vector<BodyPair> sweepPairs(const Bodies& bodies) {
    std::vector<BodyIndex> by_start(bodies.size());
    std::iota(by_start.begin(), by_start.end(), 0u);
    std::sort(by_start.begin(), by_start.end(),
              [&](BodyIndex i, BodyIndex j) { return bodies.bounds[i].lower.x() < bodies.bounds[j].lower.x(); });
    std::vector<BodyPair> pairs;
    std::vector<BodyIndex> open;
    for (const BodyIndex i : by_start) {
        std::erase_if(open, [&](BodyIndex j) { return bodies.bounds[j].upper.x() < bodies.bounds[i].lower.x(); });
        for (const BodyIndex j : open) {
            if (bodies.kind[i] == BodyKind::fixed && bodies.kind[j] == BodyKind::fixed) continue;
            if (bodies.bounds[i].overlaps(bodies.bounds[j])) pairs.push_back({std::min(i, j), std::max(i, j)});
        }
        open.push_back(i);
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

TEST(ManyBodies, AHundredThousandEqualAnIndependentSweep) {
    Random random(21);
    Bodies bodies;  // a long channel, so that the sweep has little to do
    for (int x = 0; x < 4000; ++x) {
        for (int y = 0; y < 5; ++y) {
            for (int z = 0; z < 5; ++z) {
                const BodyKind kind = random.below(20) == 0 ? BodyKind::fixed : BodyKind::dynamic;
                bodies.add(Vec3(x - 2000, y, z) + random.inBox(0.2), Vec3::Constant(random.uniform(0.3, 0.7)), kind);
            }
        }
    }
    bodies.shuffle(random);
    const auto expected = sweepPairs(bodies);
    ASSERT_GT(expected.size(), 100000u);
    HashGrids grids;
    EXPECT_EQ(gridPairs(grids, bodies), expected);
}

TEST(ManyBodies, AHundredThousandOfAllSizesEqualAnIndependentSweep) {
    Random random(22);
    Bodies bodies;
    for (int i = 0; i < 100000; ++i) {
        const double size = random.logUniform(0.01, 10);
        const Vec3 at(random.uniform(-5000, 5000), random.uniform(-10, 10), random.uniform(-10, 10));
        bodies.add(Vec3(1e6, 0, 0) + at, 0.5 * size * Vec3(1, random.uniform(0.2, 1), random.uniform(0.2, 1)));
    }
    const auto expected = sweepPairs(bodies);
    ASSERT_GT(expected.size(), 5000u);
    HashGrids grids;
    EXPECT_EQ(gridPairs(grids, bodies), expected);
}

/// Tests per body must not grow with the number of bodies.
TEST(ManyBodies, TestsGrowLinearlyInADensePile) {
    Random random(23);
    HashGrids grids;
    std::vector<double> tests_per_body;
    for (const int edge : {10, 20, 40}) {
        const Bodies bodies = densePile(random, edge);
        gridPairs(grids, bodies);
        tests_per_body.push_back(static_cast<double>(grids.tests()) / static_cast<double>(bodies.size()));
    }
    EXPECT_GT(tests_per_body.front(), 5);
    // Bodies on the surface have fewer neighbours and get rarer in a larger pile: that much growth is due.
    EXPECT_LT(tests_per_body[2], 1.5 * tests_per_body[0]);
    EXPECT_LT(tests_per_body[2], 40);
}

TEST(ManyBodies, TestsGrowLinearlyWithSizesOneToAThousand) {
    Random random(24);
    HashGrids grids;
    std::vector<double> tests_per_body;
    for (const std::size_t count : {4000, 32000}) {
        Bodies bodies;  // the same density in space for both
        const double half = 3 * std::cbrt(static_cast<double>(count) / 4000);
        for (std::size_t i = 0; i < count; ++i) {
            bodies.add(random.inBox(half), Vec3::Constant(random.logUniform(0.0005, 0.5)));
        }
        gridPairs(grids, bodies);
        tests_per_body.push_back(static_cast<double>(grids.tests()) / static_cast<double>(count));
    }
    EXPECT_LT(tests_per_body[1], 2 * tests_per_body[0]);
    EXPECT_LT(tests_per_body[1], 100);
}

TEST(ManyBodies, FixedBodiesOnOneSpotCostNothing) {
    Bodies bodies;
    for (int i = 0; i < 20000; ++i) bodies.add(Vec3(1, 2, 3), Vec3::Constant(1), BodyKind::fixed);
    bodies.add(Vec3(1, 2, 3), Vec3::Constant(1));
    HashGrids grids;
    EXPECT_EQ(gridPairs(grids, bodies).size(), 20000u);
    EXPECT_LE(grids.tests(), 20000u);
}

TEST(ManyBodies, AFewLargeFixedBoxesCostOneTestPerBodyEach) {
    Random random(25);
    HashGrids grids;
    Bodies bodies = densePile(random, 20);
    gridPairs(grids, bodies);
    const std::uint64_t without = grids.tests();
    for (int i = 0; i < 5; ++i) bodies.add(Vec3(10, 10, -2 - i), Vec3(100, 100, 1), BodyKind::fixed);
    gridPairs(grids, bodies);
    EXPECT_GT(grids.tests(), without);
    EXPECT_LE(grids.tests(), without + 5 * bodies.size());
}

}  // namespace
}  // namespace cairn
