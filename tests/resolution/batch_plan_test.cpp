/// Which batches take direct steps.
#include "resolution/batch_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "resolution/batch_fixture.h"

namespace cairn {
namespace {

/// Balls at rest in a chain, of which so many touch another one besides, a third of the chain away.
bool mayLeap(BodyIndex balls, BodyIndex loops, double speed = 0) {
    test::Pile pile;
    for (BodyIndex i = 0; i < balls; ++i) pile.addSphere(Vec3(i, 0, 0));
    for (BodyIndex i = 0; i + 1 < balls; ++i) {
        pile.touch(i, i + 1, Vec3(i + 0.5, 0, 0), -Vec3::UnitX());
        if (i < loops) pile.touch(i, i + balls / 3, Vec3(i, 0, 0), -Vec3::UnitX());
    }
    pile.v[0] = Vec3(speed, 0, 0);
    std::vector<BodyIndex> bodies(balls);
    std::iota(bodies.begin(), bodies.end(), 0U);
    std::vector<std::uint32_t> indices(pile.contacts.size());
    std::iota(indices.begin(), indices.end(), 0U);
    return kindOf({bodies, indices, {}}, pile.contacts, pile.state(), {}).may_step_directly;
}

TEST(BatchPlan, ChainsAtRestTakeDirectStepsHoweverLongTheyAre) {
    EXPECT_TRUE(mayLeap(100, 0));
    EXPECT_TRUE(mayLeap(100'000, 0));
    EXPECT_FALSE(mayLeap(100, 0, 10));
}

TEST(BatchPlan, NoDirectStepsWhereMorePairsTouchThanInStacks) {
    EXPECT_TRUE(mayLeap(120, 61)) << "1.5 pairs per body";
    EXPECT_FALSE(mayLeap(120, 62));
}

TEST(BatchPlan, NoDirectStepsWhereLoopsMayMakeTheFactorDense) {
    // With n loops at most a third of them make a dense block, whose n³/162 products may be 25 per contact.
    EXPECT_TRUE(mayLeap(1000, 167));
    EXPECT_FALSE(mayLeap(1000, 168));
}

TEST(BatchPlan, WhatOthersDenyABodyIsNoMotion) {
    test::Pile pile;
    for (BodyIndex i = 0; i < 3; ++i) {
        pile.addSphere(Vec3(0, 0, i));
        pile.v[i] = Vec3(0, 0, i);
    }
    for (BodyIndex i = 0; i < 2; ++i) pile.touch(i, i + 1, Vec3(0, 0, i + 0.5), -Vec3::UnitZ());
    const std::vector<BodyIndex> bodies = {0, 1, 2};
    const std::vector<std::uint32_t> contacts = {0, 1};
    const auto motion = [&](const std::vector<std::uint8_t>& denied) {
        BodyState state = pile.state();
        state.denied = denied;
        return kindOf({bodies, contacts, {}}, pile.contacts, state, {}).motion;
    };
    const double all = motion({});
    EXPECT_GT(all, 0);
    EXPECT_DOUBLE_EQ(motion({1, 0, 0}), all / std::sqrt(2.0)) << "one of two contacts";
    EXPECT_EQ(motion({0, 1, 0}), 0);
}

TEST(BatchPlan, WhatRestsIsSweptThreeTimesAsOften) {
    test::Pile pile;
    const BodyState bodies = pile.state();
    ResolutionSettings settings;
    settings.iterations = 20;
    EXPECT_EQ(planOf({}, bodies, settings).limit, 20);
    EXPECT_EQ(planOf({.rests = true}, bodies, settings).limit, 60);
}

TEST(BatchPlan, WhatForcesPullIsSolvedToItsOwnToleranceIfThatIsLess) {
    test::Pile pile;
    const BodyState bodies = pile.state();
    ResolutionSettings settings;
    settings.tolerance = 0.1;
    for (const double own : {0.01, 0.2}) {
        settings.pulled_tolerance = own;
        const SweepPlan plain = planOf({}, bodies, settings);
        const SweepPlan pulled = planOf({.pulled = true}, bodies, settings);
        const double part = own < settings.tolerance ? 0.1 : 1;
        EXPECT_DOUBLE_EQ(plain.tolerance, 0.1);
        EXPECT_DOUBLE_EQ(pulled.tolerance, part * plain.tolerance);
        EXPECT_DOUBLE_EQ(pulled.steady_speed, part * plain.steady_speed);
    }
    settings.tolerance = 0;
    EXPECT_EQ(planOf({.pulled = true}, bodies, settings).tolerance, 0);
}

}  // namespace
}  // namespace cairn
