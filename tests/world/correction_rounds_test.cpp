/// What the correction pushes into bodies that were too far away to have a contact is found and corrected, too.
#include <gtest/gtest.h>

#include <algorithm>

#include "cairn/world.h"

namespace cairn {
namespace {

/// A wall moves in one step 50 mm into the first of a row of balls with gaps of 5 mm. @return the deepest overlap of
/// two balls after that step [m]
double overlapAfterPush(int balls, std::int64_t rounds, std::int64_t threads) {
    Settings settings = Settings::preset(Preset::performance);
    settings.correction.correction_rounds = rounds;
    settings.parallel.threads = threads;
    World world(settings);
    const MaterialId oak = world.addMaterial({"oak", 800});
    const BodyId wall = world.addBody({.shape = Box{Vec3(0.1, 1, 1)}, .material = oak, .fixed = true});
    std::vector<BodyId> row;
    for (int i = 0; i < balls; ++i) {
        row.push_back(world.addBody(
            {.shape = Sphere{0.1}, .material = oak, .pose = {Vec3(0.155 + 0.205 * i, 0, 0), Quat::Identity()}}));
    }
    world.step();
    world.setPose(wall, {Vec3(0.055, 0, 0), Quat::Identity()});
    world.step();
    double deepest = 0;
    for (std::size_t i = 1; i < row.size(); ++i) {
        const Vec3 way = world.pose(row[i]).position - world.pose(row[i - 1]).position;
        deepest = std::max(deepest, 0.2 - way.norm());
    }
    return deepest;
}

TEST(CorrectionRounds, OneLeavesWhatItPushedBodiesInto) {
    EXPECT_NEAR(overlapAfterPush(2, 1, 1), 0.044, 1e-3);
}

TEST(CorrectionRounds, EachFindsTheNextBodyOfARow) {
    const double threshold = Settings::preset(Preset::performance).correction.penetration_threshold;
    EXPECT_LE(overlapAfterPush(2, 2, 1), threshold);
    EXPECT_GT(overlapAfterPush(4, 2, 1), 10 * threshold);
    EXPECT_LE(overlapAfterPush(4, 4, 1), threshold);
}

TEST(CorrectionRounds, AreTheSameOnAnyNumberOfThreads) {
    EXPECT_EQ(overlapAfterPush(6, 3, 1), overlapAfterPush(6, 3, 4));
}

TEST(CorrectionRounds, EndWhenNothingWasPushedFar) {
    EXPECT_EQ(overlapAfterPush(3, 10, 1), overlapAfterPush(3, 100, 1));
}

}  // namespace
}  // namespace cairn
