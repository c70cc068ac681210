#include "resolution/impulse_queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "oracle.h"

namespace cairn::test {
namespace {

constexpr std::size_t always_array = std::size_t{1} << 40;
constexpr std::size_t always_tournament = 0;

/// The bytes of all velocities must agree.
void expectSameState(const Pile& x, const Pile& y) {
    for (std::size_t i = 0; i < x.kind.size(); ++i) {
        ASSERT_EQ(x.v[i], y.v[i]) << "body " << i;
        ASSERT_EQ(x.w[i], y.w[i]) << "body " << i;
        ASSERT_EQ(x.woken[i], y.woken[i]) << "body " << i;
    }
    for (std::size_t i = 0; i < x.contacts.size(); ++i) ASSERT_EQ(x.contacts[i].impulse, y.contacts[i].impulse);
}

/// A heap of equal balls on a square lattice over the ground, all falling alike: full of ties.
Pile latticePile(int side, int layers) {
    Pile pile;
    const BodyIndex ground = pile.addFixed();
    const auto body = [&](int x, int y, int z) { return static_cast<BodyIndex>(1 + x + side * (y + side * z)); };
    for (int z = 0; z < layers; ++z) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const BodyIndex i = pile.addSphere(Vec3(x, y, z + 0.5));
                pile.v[i] = Vec3(0, 0, -0.25);
            }
        }
    }
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            pile.touch(ground, body(x, y, 0), Vec3(x, y, 0), -Vec3::UnitZ(), 0.5, {0.2, 0.2});
        }
    }
    for (int z = 0; z < layers; ++z) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const Vec3 at(x, y, z + 0.5);
                const BodyIndex i = body(x, y, z);
                if (x + 1 < side)
                    pile.touch(i, body(x + 1, y, z), at + Vec3(0.5, 0, 0), -Vec3::UnitX(), 0.5, {0.2, 0.2});
                if (y + 1 < side)
                    pile.touch(i, body(x, y + 1, z), at + Vec3(0, 0.5, 0), -Vec3::UnitY(), 0.5, {0.2, 0.2});
                if (z + 1 < layers) {
                    pile.touch(i, body(x, y, z + 1), at + Vec3(0, 0, 0.5), -Vec3::UnitZ(), 0.5, {0.2, 0.2});
                }
            }
        }
    }
    return pile;
}

TEST(IterationLimit, IsAMultipleOfTheContactsAtLeastOneAndNeverEndless) {
    EXPECT_EQ(iterationLimit(2, 10), 20);
    EXPECT_EQ(iterationLimit(0.25, 10), 3);
    EXPECT_EQ(iterationLimit(0.01, 10), 1);
    EXPECT_EQ(iterationLimit(2, 0), 1);
    EXPECT_EQ(iterationLimit(0, 10), iteration_cap);
    EXPECT_EQ(iterationLimit(1e300, 10), iteration_cap);
}

TEST(ImpulseQueue, ReversesTwoBallsBeforeAWall) {
    // Figure 21: two balls roll towards a wall, all contacts elastic; contacts 2, 1, 2 are resolved.
    Pile pile;
    const BodyIndex ground = pile.addFixed(Vec3(0, 0, -1)), wall = pile.addFixed(Vec3(3, 0, 0));
    const BodyIndex left = pile.addSphere(Vec3(0.5, 0, 0.5)), right = pile.addSphere(Vec3(1.5, 0, 0.5));
    pile.v[left] = pile.v[right] = Vec3(2, 0, 0);
    pile.touch(ground, left, Vec3(0.5, 0, 0), -Vec3::UnitZ(), 1);
    pile.touch(ground, right, Vec3(1.5, 0, 0), -Vec3::UnitZ(), 1);
    pile.touch(wall, right, Vec3(2, 0, 0.5), Vec3::UnitX(), 1);
    pile.touch(left, right, Vec3(1, 0, 0.5), -Vec3::UnitX(), 1);
    const ResolutionCounts counts = pile.resolve(exactSettings());
    EXPECT_EQ(counts.global_iterations, 3);
    EXPECT_TRUE(pile.v[left].isApprox(Vec3(-2, 0, 0), 1e-14));
    EXPECT_TRUE(pile.v[right].isApprox(Vec3(-2, 0, 0), 1e-14));
    EXPECT_EQ(pile.contacts[0].impulse, Vec3::Zero());
    EXPECT_TRUE(pile.contacts[2].impulse.isApprox(Vec3(8, 0, 0), 1e-14));
    EXPECT_EQ(counts.shock_batches, 0);
}

TEST(ImpulseQueue, TakesTheFastestContactFirst) {
    // Figure 22: the left ball sinks slowly towards the ground, the right one moves fast towards the wall.
    Pile pile;
    const BodyIndex ground = pile.addFixed(Vec3(0, 0, -1)), wall = pile.addFixed(Vec3(3, 0, 0));
    const BodyIndex left = pile.addSphere(Vec3(0.5, 0, 0.5)), right = pile.addSphere(Vec3(1.5, 0, 0.5));
    pile.v[left] = Vec3(0, 0, -1);
    pile.v[right] = Vec3(3, 0, 0);
    pile.touch(ground, left, Vec3(0.5, 0, 0), -Vec3::UnitZ());
    pile.touch(wall, right, Vec3(2, 0, 0.5), Vec3::UnitX());
    pile.touch(left, right, Vec3(1, 0, 0.5), -Vec3::UnitX());
    ResolutionSettings settings = exactSettings();
    settings.iterations = 0.3;  // one iteration
    EXPECT_EQ(pile.resolve(settings).global_iterations, 1);
    EXPECT_EQ(pile.v[left], Vec3(0, 0, -1));
    EXPECT_NEAR(pile.v[right].norm(), 0, 1e-14);
}

TEST(ImpulseQueue, PicksTheSmallestDeltaOfManyContacts) {
    for (const std::size_t queue_switch : {always_array, always_tournament}) {
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            Pile pile = randomPile(seed, 40, 100, 2);
            std::size_t fastest = 0;
            for (std::size_t i = 0; i < pile.contacts.size(); ++i) {
                if (pile.delta(pile.contacts[i]) < pile.delta(pile.contacts[fastest])) fastest = i;
            }
            ResolutionSettings settings = exactSettings();
            settings.iterations = 1e-3;
            ASSERT_EQ(resolveWith({.queue_switch = queue_switch}, pile, settings).global_iterations, 1);
            for (std::size_t i = 0; i < pile.contacts.size(); ++i) {
                ASSERT_EQ(pile.contacts[i].impulse.norm() > 0, i == fastest);
            }
        }
    }
}

TEST(ImpulseQueue, DoesWhatTheThesisWritesDown) {
    ResolutionSettings settings = exactSettings();
    settings.restitution_threshold = 0.05;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Pile pile = randomPile(seed, 30, 70, seed % 4, 0.4, {0.5, 0.3});
        Pile oracle = pile;
        const std::int64_t limit = 200;
        settings.iterations = static_cast<double>(limit) / 70;
        const QueueConstants constants{.queue_switch = seed % 2 == 0 ? always_array : always_tournament};
        const std::int64_t iterations = resolveWith(constants, pile, settings).global_iterations;
        EXPECT_EQ(iterations, resolveBatchByTheBook(oracle, settings, limit)) << "seed " << seed;
        for (std::size_t i = 0; i < pile.kind.size(); ++i) {
            ASSERT_LT((pile.v[i] - oracle.v[i]).norm(), 1e-9) << "seed " << seed;
            ASSERT_LT((pile.w[i] - oracle.w[i]).norm(), 1e-9) << "seed " << seed;
        }
    }
}

TEST(ImpulseQueue, LeavesNoContactClosing) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Pile pile = randomPile(seed, 60, 120, 3);
        ResolutionSettings settings = exactSettings();
        settings.resolution_threshold = 1e-5;
        const ResolutionCounts counts = pile.resolve(settings);
        ASSERT_GT(counts.global_iterations, 10);
        ASSERT_LT(counts.global_iterations, iteration_cap);
        EXPECT_GT(pile.smallestDelta(), -1.001e-5);
    }
}

TEST(ImpulseQueue, ConservesMomentum) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Pile pile = randomPile(seed, 40, 90, 0, 0.5, {0.5, 0.4});
        const Vec3 momentum = pile.momentum(), angular = pile.angularMomentum();
        ResolutionSettings settings = exactSettings();
        settings.iterations = 5;
        ASSERT_GT(pile.resolve(settings).global_iterations, 20);
        EXPECT_LT((pile.momentum() - momentum).norm(), 1e-12);
        EXPECT_LT((pile.angularMomentum() - angular).norm(), 1e-12);
    }
}

TEST(ImpulseQueue, NeverGainsEnergyWithoutFrictionAndKeepsItWhenElastic) {
    for (const double e : {0.0, 0.25, 1.0}) {
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            Pile pile = randomPile(seed, 40, 60, 2, e, {});
            const double energy = pile.energy();
            ResolutionSettings settings = exactSettings();
            settings.restitution_threshold = 0;
            settings.iterations = 20;
            pile.resolve(settings);
            EXPECT_LE(pile.energy(), energy * (1 + 1e-12));
            if (e == 1.0) {
                EXPECT_NEAR(pile.energy(), energy, 1e-9 * energy);
            } else {
                EXPECT_LT(pile.energy(), 0.999 * energy);
            }
        }
    }
}

TEST(ImpulseQueue, GivesTheSameBitsWithBothQueues) {
    std::vector<Pile> piles = {latticePile(3, 3), latticePile(5, 4), latticePile(2, 9)};
    for (std::uint64_t seed = 0; seed < 30; ++seed) piles.push_back(randomPile(seed, 20 + 5 * seed, 40 + 12 * seed, 3));
    ResolutionSettings settings;
    settings.resolution = ResolutionKind::impulse_queue;
    settings.iterations = 2;
    QueueConstants constants{.shock_iterations = 3};
    bool shock_ran = false;
    for (const Pile& pile : piles) {
        Pile array = pile, tournament = pile, hybrid = pile;
        constants.queue_switch = always_array;
        const ResolutionCounts counts = resolveWith(constants, array, settings);
        constants.queue_switch = always_tournament;
        EXPECT_EQ(resolveWith(constants, tournament, settings).shock_iterations, counts.shock_iterations);
        constants.queue_switch = 30;  // the stages of the shock propagation differ
        resolveWith(constants, hybrid, settings);
        expectSameState(array, tournament);
        expectSameState(array, hybrid);
        shock_ran = shock_ran || counts.shock_batches > 0;
    }
    EXPECT_TRUE(shock_ran);
}

TEST(ImpulseQueue, StopsAtItsLimit) {
    Pile pile = latticePile(4, 6);
    ResolutionSettings settings = exactSettings();
    settings.iterations = 1.5;
    EXPECT_EQ(pile.resolve(settings).global_iterations, iterationLimit(1.5, pile.contacts.size()));
    EXPECT_LT(pile.smallestDelta(), -1e-9);
}

TEST(ImpulseQueue, ResolvesEverythingInArbitraryOrder) {
    Pile fastest = latticePile(4, 5);
    Pile arbitrary = fastest;
    ResolutionSettings settings = exactSettings();
    settings.resolution_threshold = 1e-4;
    const std::int64_t few = fastest.resolve(settings).global_iterations;
    settings.resolution = ResolutionKind::arbitrary_order;
    const std::int64_t many = arbitrary.resolve(settings).global_iterations;
    EXPECT_GT(arbitrary.smallestDelta(), -1.001e-4);
    EXPECT_GT(many, few);  // §5.4
}

TEST(ImpulseQueue, TakesTheLatestClosingContactInArbitraryOrder) {
    Pile pile = randomPile(3, 40, 100, 2);
    // At the beginning, the last of the batch's contacts.
    std::size_t latest = pile.contacts.size() - 1;
    while (pile.delta(pile.contacts[latest]) >= -1e-9) --latest;
    ResolutionSettings settings = exactSettings();
    settings.resolution = ResolutionKind::arbitrary_order;
    settings.iterations = 1e-3;
    pile.resolve(settings);
    for (std::size_t i = 0; i < pile.contacts.size(); ++i) EXPECT_EQ(pile.contacts[i].impulse.norm() > 0, i == latest);
}

TEST(ImpulseQueue, WakesOnlyBodiesOfProcessedContacts) {
    // The ball hits a; b rests against a's side and is not touched by what happens.
    Pile pile;
    const BodyIndex ball = pile.addSphere(Vec3(-1, 0, 0)), a = pile.addSphere(Vec3(0, 0, 0));
    const BodyIndex b = pile.addSphere(Vec3(0, 1, 0));
    pile.v[ball] = Vec3(1, 0, 0);
    pile.asleep[a] = pile.asleep[b] = 1;
    pile.touch(ball, a, Vec3(-0.5, 0, 0), -Vec3::UnitX());
    pile.touch(a, b, Vec3(0, 0.5, 0), -Vec3::UnitY());
    pile.resolve(exactSettings());
    EXPECT_EQ(pile.asleep[a], 0);
    EXPECT_EQ(pile.woken[a], WakeReason::struck);
    EXPECT_EQ(pile.asleep[b], 1);
    EXPECT_EQ(pile.v[b], Vec3::Zero());
    EXPECT_EQ(pile.woken[ball], WakeReason::none);  // was awake

    pile.v[a] = Vec3(0, 1, 0);
    pile.resolve(exactSettings());
    EXPECT_EQ(pile.woken[b], WakeReason::struck);
}

TEST(ImpulseQueue, LeavesAFixedBodyAsItIs) {
    Pile pile = latticePile(2, 2);
    pile.resolve(exactSettings());
    EXPECT_EQ(pile.v[0], Vec3::Zero());
    EXPECT_EQ(pile.w[0], Vec3::Zero());
    EXPECT_EQ(pile.woken[0], WakeReason::none);
}

TEST(ImpulseQueue, EndsAndSparesTheNeighboursWhenABodyIsNotFinite) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()}) {
        for (const std::size_t queue_switch : {always_array, always_tournament}) {
            Pile pile = latticePile(3, 3);
            const BodyIndex culprit = 14;  // the centre
            pile.v[culprit] = Vec3(0, 0, bad);
            ResolutionSettings settings = exactSettings();
            settings.resolution_threshold = 1e-4;
            EXPECT_LT(resolveWith({.queue_switch = queue_switch}, pile, settings).global_iterations, 100000);
            for (BodyIndex i = 0; i < pile.kind.size(); ++i) {
                EXPECT_EQ(pile.v[i].allFinite() && pile.w[i].allFinite(), i != culprit) << "body " << i;
            }
        }
    }
}

TEST(ImpulseQueue, HasNoMemoryOfTheBatchBefore) {
    const std::unique_ptr<Resolution> used = makeResolution(ResolutionKind::impulse_queue);
    ResolutionSettings settings;
    settings.resolution = ResolutionKind::impulse_queue;
    settings.iterations = 0.5;
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
        Pile fresh = randomPile(seed, 100 / seed, 300 / seed, 2);
        Pile again = fresh;
        fresh.resolve(settings);
        again.resolve(*used, settings);
        expectSameState(fresh, again);
    }
}

TEST(ImpulseQueue, AcceptsABatchWithoutContacts) {
    Pile pile;
    const BodyIndex body = pile.addSphere(Vec3::Zero());
    pile.v[body] = Vec3(1, 2, 3);
    EXPECT_EQ(pile.resolve(exactSettings()).global_iterations, 0);
    EXPECT_EQ(pile.v[body], Vec3(1, 2, 3));
}

TEST(NoResolution, LeavesEverythingAsItIs) {
    Pile pile = latticePile(2, 2);
    const Pile before = pile;
    ResolutionSettings settings;
    settings.resolution = ResolutionKind::impulse_queue;
    settings.resolution = ResolutionKind::none;
    EXPECT_EQ(pile.resolve(settings).global_iterations, 0);
    expectSameState(pile, before);
}

}  // namespace
}  // namespace cairn::test
