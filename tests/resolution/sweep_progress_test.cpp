#include "resolution/sweep_progress.h"

#include <gtest/gtest.h>

#include <vector>

namespace cairn {
namespace {

/// After how many sweeps with such changes a batch is done; 0 = not yet.
int sweepsUntilSteady(const SweepPlan& plan, const std::vector<double>& changes) {
    SweepProgress progress(plan);
    int sweeps = 0;
    for (const double change : changes) {
        progress.countSweep();
        ++sweeps;
        if (progress.isSteady({.squared = change * change, .largest_speed = 1})) return sweeps;
    }
    return 0;
}

const SweepPlan plan{.limit = 100, .steady_speed = 1e-9, .tolerance = 0.1, .safe_speed = 10, .motion = 1};

TEST(SweepProgress, EndsWhenAGeometricSeriesLeavesLittle) {
    // After the third, 0.25·0.5/(1 − 0.5) = 0.25 are left, after the fifth 0.0625.
    EXPECT_EQ(sweepsUntilSteady(plan, {1, 0.5, 0.25, 0.125, 0.0625, 0.03125}), 5);
}

TEST(SweepProgress, EndsAtOnceWhereLittleChangesBesideTheMotion) {
    EXPECT_EQ(sweepsUntilSteady(plan, {0.05}), 1);
}

TEST(SweepProgress, DoesNotTakeOneSweepThatChangesLittleForTheEnd) {
    // By the last rate of 0.23, taken as 0.3, 0.043 would be left; by the mean since the second sweep, 0.585, it is
    // 0.14.
    EXPECT_EQ(sweepsUntilSteady(plan, {1, 0.5, 0.45, 0.43, 0.1}), 0);
    EXPECT_EQ(sweepsUntilSteady(plan, {1, 0.5, 0.45, 0.43, 0.1, 0.05}), 6);
}

TEST(SweepProgress, KeepsItsDirectionUnlessSweepsDiverge) {
    SweepProgress progress(plan);
    EXPECT_EQ(progress.beta({.squared = 1}), 0) << "there is none yet";
    progress.advance({.squared = 1});
    EXPECT_EQ(progress.beta({.squared = 0.25}), 0.25);
    EXPECT_EQ(progress.beta({.squared = 1.25}), 1.25) << "grown for once";
    EXPECT_EQ(progress.beta({.squared = 2}), 0);
}

TEST(SweepProgress, GoesOnWhereSweepsChangeMoreAndMore) {
    EXPECT_EQ(sweepsUntilSteady(plan, {0.2, 0.3, 0.4, 0.5, 0.6}), 0);
}

}  // namespace
}  // namespace cairn
