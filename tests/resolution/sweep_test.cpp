#include <gtest/gtest.h>

#include "batch_fixture.h"

namespace cairn::test {
namespace {

ResolutionSettings sweepSettings() {
    ResolutionSettings settings = exactSettings();
    settings.resolution = ResolutionKind::sweep;
    settings.iterations = 10000;
    return settings;
}

/// Balls in a groove, row on row, all falling alike.
Pile groove() {
    Pile pile;
    const BodyIndex left = pile.addFixed(Vec3(-2, 0, 0)), right = pile.addFixed(Vec3(2, 0, 0));
    const BodyIndex a = pile.addSphere(Vec3(-0.5, 0, 0)), b = pile.addSphere(Vec3(0.5, 0, 0));
    const BodyIndex c = pile.addSphere(Vec3(0, 0, std::sqrt(0.75)));
    for (const BodyIndex i : {a, b, c}) pile.v[i] = Vec3(0, 0, -0.1);
    const Vec3 n_left = Vec3(-1, 0, -1).normalized(), n_right = Vec3(1, 0, -1).normalized();
    pile.touch(left, a, pile.position[a] + 0.5 * n_left, n_left);
    pile.touch(right, b, pile.position[b] + 0.5 * n_right, n_right);
    pile.touch(a, b, Vec3::Zero(), -Vec3::UnitX());
    const Vec3 n_ac = pile.position[a] - pile.position[c], n_bc = pile.position[b] - pile.position[c];
    pile.touch(a, c, pile.position[c] + 0.5 * n_ac, n_ac);
    pile.touch(b, c, pile.position[c] + 0.5 * n_bc, n_bc);
    return pile;
}

TEST(Sweep, ConvergesToTheVelocitiesOfTheQueue) {
    Pile solved = groove();
    Pile queued = solved;
    ASSERT_GT(solved.resolve(sweepSettings()).global_iterations, 10);
    queued.resolve(exactSettings());
    // Not the last digit: impulses are never taken back, so that what the order of early ones gave stays.
    for (std::size_t i = 0; i < solved.kind.size(); ++i) {
        EXPECT_LT((solved.v[i] - queued.v[i]).norm(), 1e-3) << "body " << i;  // of 0.1 m/s
        EXPECT_LT((solved.w[i] - queued.w[i]).norm(), 1e-3) << "body " << i;
        EXPECT_LT(solved.v[i].norm(), 0.005) << "body " << i;
    }
}

TEST(Sweep, ResolvesEqualToTheQueueWhereTheOrderDoesNotMatter) {
    // One contact per pair of bodies that touch nothing else.
    Pile solved;
    Random random(9);
    for (int i = 0; i < 50; ++i) {
        const double mass = random.uniform(1, 2);
        const BodyIndex a = solved.add(random.vector(9), mass, randomInertia(random, mass));
        const BodyIndex b = solved.addSphere(random.vector(9));
        solved.v[a] = random.vector(1);
        solved.w[b] = random.vector(1);
        const Vec3 normal = random.vector(1).normalized();
        solved.touch(a, b, 0.5 * (solved.position[a] + solved.position[b]), normal, 0.5, {0.3, 0.2});
    }
    Pile queued = solved;
    const ResolutionCounts counts = solved.resolve(sweepSettings());
    EXPECT_EQ(counts.global_iterations, queued.resolve(exactSettings()).global_iterations);
    EXPECT_GT(counts.global_iterations, 10);
    for (std::size_t i = 0; i < solved.kind.size(); ++i) {
        EXPECT_EQ(solved.v[i], queued.v[i]);
        EXPECT_EQ(solved.w[i], queued.w[i]);
    }
}

TEST(Sweep, GoesThroughTheContactsInAscendingOrder) {
    // A row of balls struck from the left: one sweep carries the impulse to the end, e = 1.
    Pile pile;
    for (int i = 0; i < 5; ++i) pile.addSphere(Vec3(i, 0, 0));
    for (BodyIndex i = 0; i < 4; ++i) pile.touch(i, i + 1, Vec3(i + 0.5, 0, 0), -Vec3::UnitX(), 1);
    pile.v[0] = Vec3(1, 0, 0);
    ResolutionSettings settings = sweepSettings();
    settings.iterations = 1;
    EXPECT_EQ(pile.resolve(settings).global_iterations, 4);
    EXPECT_TRUE(pile.v[4].isApprox(Vec3(1, 0, 0), 1e-14));
    // Struck from the right it takes a sweep per ball.
    for (Vec3& v : pile.v) v.setZero();
    pile.v[4] = Vec3(-1, 0, 0);
    EXPECT_EQ(pile.resolve(settings).global_iterations, 1);
}

TEST(Sweep, ConservesMomentumAndLeavesNothingClosing) {
    Pile pile = randomPile(2, 40, 70);
    const Vec3 momentum = pile.momentum(), angular = pile.angularMomentum();
    ResolutionSettings settings = sweepSettings();
    settings.resolution_threshold = 1e-6;
    pile.resolve(settings);
    EXPECT_GT(pile.smallestDelta(), -1.001e-6);
    EXPECT_LT((pile.momentum() - momentum).norm(), 1e-12);
    EXPECT_LT((pile.angularMomentum() - angular).norm(), 1e-12);
}

TEST(Sweep, StopsAfterItsSweepsAndWakesWhatItResolves) {
    Pile pile = groove();
    pile.v[4].setZero();
    pile.asleep[4] = 1;
    ResolutionSettings settings = sweepSettings();
    settings.iterations = 1;
    const ResolutionCounts counts = pile.resolve(settings);
    EXPECT_GT(counts.global_iterations, 0);
    EXPECT_LE(counts.global_iterations, 5);
    settings.iterations = 100;
    pile.v[2] = Vec3(0, 0, 1);  // up against the sleeping ball
    pile.resolve(settings);
    EXPECT_EQ(pile.woken[4], WakeReason::struck);
}

TEST(Sweep, LeavesBodiesThatAreNotFiniteAlone) {
    Pile pile = groove();
    pile.v[2] = Vec3(0, 0, -std::numeric_limits<double>::infinity());
    pile.resolve(sweepSettings());
    EXPECT_TRUE(pile.v[3].allFinite());
    EXPECT_TRUE(pile.v[4].allFinite());
}

}  // namespace
}  // namespace cairn::test
