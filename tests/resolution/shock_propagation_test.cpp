#include "resolution/shock_propagation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "batch_fixture.h"

namespace cairn::test {
namespace {

constexpr Friction wood = {0.5, 0.4};

/// Four contacts at the corners of the overlap of a lower and an upper unit cube.
void stack(Pile& pile, BodyIndex lower, BodyIndex upper, double z, double x_low, double x_high) {
    for (const double x : {x_low, x_high}) {
        for (const double y : {-0.5, 0.5}) pile.touch(lower, upper, Vec3(x, y, z), -Vec3::UnitZ(), 0, wood);
    }
}

Pile tower(int boxes, double speed) {
    Pile pile;
    BodyIndex below = pile.addFixed(Vec3(0, 0, -1));
    for (int i = 0; i < boxes; ++i) {
        const BodyIndex box = pile.addBox(Vec3(0, 0, i + 0.5), 1, Vec3::Ones());
        pile.v[box] = Vec3(0, 0, -speed);
        stack(pile, below, box, i, -0.5, 0.5);
        below = box;
    }
    return pile;
}

/// Figure 23(a): three blocks, two on them, one on top; the ground is body 0.
Pile pyramid(double speed) {
    Pile pile;
    pile.addFixed(Vec3(0, 0, -1));
    for (int row = 0; row < 3; ++row) {
        for (int i = 0; i < 3 - row; ++i) {
            const BodyIndex box = pile.addBox(Vec3(i + 0.5 * row, 0, row + 0.5), 1, Vec3::Ones());
            pile.v[box] = Vec3(0, 0, -speed);
        }
    }
    for (BodyIndex i = 1; i <= 3; ++i) stack(pile, 0, i, 0, i - 1.5, i - 0.5);
    for (const auto& [lower, upper] : {std::pair{1U, 4U}, {2U, 4U}, {2U, 5U}, {3U, 5U}, {4U, 6U}, {5U, 6U}}) {
        const double x = 0.5 * (pile.position[lower].x() + pile.position[upper].x());
        stack(pile, lower, upper, pile.position[lower].z() + 0.5, x - 0.25, x + 0.25);
    }
    return pile;
}

/// A few global iterations, then shock propagation.
ResolutionSettings fewGlobalIterations() {
    ResolutionSettings settings;
    settings.resolution = ResolutionKind::impulse_queue;
    settings.resolution_threshold = 1e-6;
    settings.iterations = 0.5;
    return settings;
}

/// Runs shock propagation by hand to see the stages. @param limit of a stage as a multiple of its contacts; 0 = none
ShockOutcome shockAlone(Pile& pile, const ResolutionSettings& settings, double limit = 0) {
    std::vector<BodyIndex> bodies;
    for (BodyIndex i = 0; i < pile.kind.size(); ++i) {
        if (pile.kind[i] == BodyKind::dynamic) bodies.push_back(i);
    }
    std::vector<std::uint32_t> indices(pile.contacts.size());
    std::iota(indices.begin(), indices.end(), 0U);
    const BatchView view{bodies, indices};
    QueueSolver solver(QueueConstants{}.queue_switch);
    solver.begin(view, pile.contacts, pile.state(), settings);
    const ShockOutcome outcome = ShockPropagation().run(solver, limit);
    solver.batch.scatter(view, pile.contacts, pile.state());
    return outcome;
}

TEST(ShockPropagation, MakesATowersContactsNonClosing) {
    Pile pile = tower(10, 0.05);
    const ResolutionCounts counts = resolveWith({.shock_iterations = 0}, pile, fewGlobalIterations());
    EXPECT_EQ(counts.shock_batches, 1);
    EXPECT_GT(counts.shock_iterations, 0);
    EXPECT_EQ(counts.global_iterations, 20);
    EXPECT_GT(pile.smallestDelta(), -1.001e-6);
}

TEST(ShockPropagation, TakesTheThreeRowsOfAPyramidOneAfterTheOther) {
    Pile pile = pyramid(0.05);
    const ShockOutcome outcome = shockAlone(pile, fewGlobalIterations());
    EXPECT_EQ(outcome.stages, 3);
    EXPECT_GT(pile.smallestDelta(), -1.001e-6);
    // What gravity gave (0.05 m/s) is gone but for the little that impulses along the edges leave.
    for (std::size_t i = 1; i < pile.kind.size(); ++i) EXPECT_LT(pile.v[i].norm(), 1e-3) << "body " << i;
}

TEST(ShockPropagation, StartsFromEveryFixedBody) {
    // Figure 23(b): ten balls in three subsets of 4, 4 and 2; the lowest ball on the right is fixed like the ground.
    Pile pile;
    pile.addFixed(Vec3(0, 0, -1));
    const BodyIndex boundary = pile.addFixed(Vec3(3, 0, 0.5));
    const double rise = std::sqrt(0.75);
    std::vector<Vec3> places;
    for (const double x : {0.0, 1.0, 2.0}) places.emplace_back(x, 0, 0.5);
    for (const double x : {0.5, 1.5, 2.5}) places.emplace_back(x, 0, 0.5 + rise);
    for (const double x : {1.0, 2.0, 3.0}) places.emplace_back(x, 0, 0.5 + 2 * rise);
    places.emplace_back(1.5, 0, 0.5 + 3 * rise);
    for (const Vec3& at : places) pile.v[pile.addSphere(at)] = Vec3(0, 0, -0.05);
    for (BodyIndex i = 2; i < 5; ++i) {
        pile.touch(0, i, pile.position[i] - 0.5 * Vec3::UnitZ(), -Vec3::UnitZ(), 0, wood);
    }
    for (BodyIndex i = boundary; i < pile.kind.size(); ++i) {
        for (BodyIndex k = i + 1; k < pile.kind.size(); ++k) {
            const Vec3 apart = pile.position[i] - pile.position[k];
            if (apart.norm() > 1.01) continue;
            pile.touch(i, k, pile.position[k] + 0.5 * apart, apart.normalized(), 0, wood);
        }
    }
    const ShockOutcome outcome = shockAlone(pile, fewGlobalIterations());
    EXPECT_EQ(outcome.stages, 3);
    EXPECT_GT(pile.smallestDelta(), -1.001e-6);
}

TEST(ShockPropagation, LetsNothingAboveMoveWhatIsDone) {
    // Two boxes, each with its own speed: the lower one ends as if it were alone with the box on top of it in its
    // stage; in the second stage it keeps that velocity although the upper box still presses.
    Pile pile = tower(2, 0);
    pile.v[2] = Vec3(0, 0, -1);
    ResolutionSettings settings = fewGlobalIterations();
    // One iteration per stage: the upper box pushes the lower one.
    const ShockOutcome outcome = shockAlone(pile, settings, 0.125);
    EXPECT_EQ(outcome.stages, 2);
    EXPECT_EQ(outcome.iterations, 2);
    // Stage 0: one corner of the contact between the boxes. Stage 1: another corner against an immovable lower box.
    Pile by_hand = tower(2, 0);
    by_hand.v[2] = Vec3(0, 0, -1);
    settings.iterations = 1e-3;
    settings.shock_propagation = false;
    by_hand.resolve(settings);
    EXPECT_EQ(pile.v[1], by_hand.v[1]);
    EXPECT_EQ(pile.w[1], by_hand.w[1]);
    EXPECT_NE(pile.v[2], by_hand.v[2]);
}

/// A ball that leaves the ground meets two more above it, the last a thousand times as heavy as the others. One global
/// iteration leaves the lower two at half its speed; frozen at it, they would drive the heavy one like a wall.
Pile ballBelowAHeavyOne(double speed, double heavy) {
    Pile pile;
    BodyIndex below = pile.addFixed(Vec3(0, 0, -1));
    for (int i = 0; i < 3; ++i) {
        const BodyIndex ball = pile.addSphere(Vec3(0, 0, i + 0.5), i < 2 ? 1 : heavy);
        pile.touch(below, ball, Vec3(0, 0, i), -Vec3::UnitZ());
        below = ball;
    }
    pile.v[1] = Vec3(0, 0, speed);
    return pile;
}

ResolutionSettings oneGlobalIteration() {
    ResolutionSettings settings = fewGlobalIterations();
    settings.iterations = 0.1;
    return settings;
}

TEST(ShockPropagation, TakesNoEnergyFromWhatItFreezesInMotion) {
    Pile pile = ballBelowAHeavyOne(10, 1000);
    const double before = pile.energy();
    const ResolutionCounts counts = pile.resolve(oneGlobalIteration());
    ASSERT_EQ(counts.global_iterations, 1);
    ASSERT_EQ(counts.shock_batches, 1);
    EXPECT_LE(pile.energy(), before * (1 + 1e-12));
    // What it may do it does: the heavy ball rises, the lower two keep their 5 m/s and the rest of the 50 J is its own.
    EXPECT_NEAR(pile.v[1].z(), 5, 1e-12);
    const double lighter = 0.5 * (pile.v[1].squaredNorm() + pile.v[2].squaredNorm());
    EXPECT_NEAR(0.5 * 1000 * pile.v[3].squaredNorm(), 50 - lighter, 1e-9);
    // Impulses and velocities belong together.
    EXPECT_NEAR(-pile.contacts[2].impulse.z(), 1000 * pile.v[3].z(), 1e-9);
}

TEST(ShockPropagation, KeepsAllItDoesWhereTheEnergyAllowsIt) {
    Pile pile = ballBelowAHeavyOne(10, 1);
    Pile alone = pile;
    resolveWith({.shock_iterations = 0}, pile, oneGlobalIteration());
    alone.v[1] = alone.v[2] = Vec3(0, 0, 5);
    shockAlone(alone, oneGlobalIteration());
    for (BodyIndex i = 1; i <= 3; ++i) {
        EXPECT_NEAR(pile.v[i].z(), 5, 1e-6);
        EXPECT_LT((pile.v[i] - alone.v[i]).norm(), 1e-12);
    }
}

TEST(ShockPropagation, IsSkippedWhenTheGlobalResolutionFinishes) {
    Pile pile = tower(3, 0.05);
    Pile without = pile;
    ResolutionSettings settings = fewGlobalIterations();
    settings.iterations = 0;
    const ResolutionCounts counts = pile.resolve(settings);
    EXPECT_EQ(counts.shock_batches, 0);
    EXPECT_EQ(counts.shock_iterations, 0);
    settings.shock_propagation = false;
    without.resolve(settings);
    for (std::size_t i = 0; i < pile.kind.size(); ++i) EXPECT_EQ(pile.v[i], without.v[i]);
}

TEST(ShockPropagation, IsSkippedWhenTheLimitIsReachedWithNothingLeft) {
    Pile pile;
    const BodyIndex ground = pile.addFixed(), ball = pile.addSphere(Vec3(0, 0, 0.5));
    pile.v[ball] = Vec3(0, 0, -1);
    pile.touch(ground, ball, Vec3::Zero(), -Vec3::UnitZ());
    ResolutionSettings settings = fewGlobalIterations();
    settings.iterations = 1;
    const ResolutionCounts counts = pile.resolve(settings);
    EXPECT_EQ(counts.global_iterations, 1);
    EXPECT_EQ(counts.shock_batches, 0);
}

TEST(ShockPropagation, IsSkippedWithoutFixedBodies) {
    Pile pile = randomPile(4, 30, 90, 0);
    const Vec3 momentum = pile.momentum();
    ResolutionSettings settings = fewGlobalIterations();
    settings.iterations = 0.2;
    const ResolutionCounts counts = pile.resolve(settings);
    EXPECT_EQ(counts.global_iterations, 18);
    EXPECT_LT(pile.smallestDelta(), -1e-6);
    EXPECT_EQ(counts.shock_batches, 0);
    EXPECT_EQ(counts.shock_iterations, 0);
    EXPECT_LT((pile.momentum() - momentum).norm(), 1e-12);
}

TEST(ShockPropagation, CanBeSwitchedOff) {
    Pile pile = tower(10, 0.05);
    ResolutionSettings settings = fewGlobalIterations();
    settings.shock_propagation = false;
    EXPECT_EQ(pile.resolve(settings).shock_batches, 0);
    EXPECT_LT(pile.smallestDelta(), -1e-3);
}

TEST(ShockPropagation, RestoresTheMasses) {
    const std::unique_ptr<Resolution> resolution = makeResolution(ResolutionKind::impulse_queue);
    Pile pile = tower(6, 0.05);
    const Pile before = pile;
    ASSERT_EQ(pile.resolve(*resolution, fewGlobalIterations()).shock_batches, 1);
    EXPECT_EQ(pile.mass_inv, before.mass_inv);
    EXPECT_EQ(pile.inertiaInv_W, before.inertiaInv_W);
    // Nor are infinite masses left behind in the resolution: the next batch is resolved as if it were the first.
    Pile again = before;
    again.resolve(*resolution, fewGlobalIterations());
    for (std::size_t i = 0; i < pile.kind.size(); ++i) {
        EXPECT_EQ(again.v[i], pile.v[i]);
        EXPECT_EQ(again.w[i], pile.w[i]);
    }
}

TEST(ShockPropagation, KeepsToItsOwnLimitInEveryStage) {
    Pile pile = tower(10, 0.05);
    const ShockOutcome outcome = shockAlone(pile, fewGlobalIterations(), 0.5);
    EXPECT_EQ(outcome.stages, 10);
    EXPECT_LE(outcome.iterations, 9 * 4 + 2);  // half of eight contacts per box, of four for the highest one
    EXPECT_GT(outcome.iterations, 10);
}

}  // namespace
}  // namespace cairn::test
