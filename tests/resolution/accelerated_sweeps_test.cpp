/// Sweeps with accumulated impulses, and the direct step for what rests.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "resolution/batch_fixture.h"

namespace cairn {
namespace {

using test::Pile;

constexpr double fall = 10.0 / 240;  // speed that gravity gives in a time step [m/s]

ResolutionSettings sweeping() {
    ResolutionSettings settings = test::exactSettings();
    settings.resolution = ResolutionKind::accelerated_sweeps;
    settings.restitution_threshold = 1.1 * fall;
    settings.iterations = 20;
    settings.tolerance = 0;
    return settings;
}

/// Boxes of 1 m on each other, all falling for one step; body 0 is the ground. @param mass of the box in a place
template <class Mass>
Pile towerOf(int boxes, const Mass& mass, double friction = 0.5) {
    Pile pile;
    pile.addFixed(Vec3(0, 0, -0.5));
    for (int i = 0; i < boxes; ++i) {
        const BodyIndex box = pile.addBox(Vec3(0, 0, i + 0.5), mass(i), Vec3::Ones());
        pile.v[box] = Vec3(0, 0, -fall);
        for (const double x : {-0.5, 0.5}) {
            for (const double y : {-0.5, 0.5}) {
                pile.touch(box - 1, box, Vec3(x, y, i), -Vec3::UnitZ(), 0, {friction, friction});
            }
        }
    }
    return pile;
}

double largestSpeed(const Pile& pile) {
    double largest = 0;
    for (std::size_t i = 0; i < pile.v.size(); ++i) largest = std::max({largest, pile.v[i].norm(), pile.w[i].norm()});
    return largest;
}

double pushOnGround(const Pile& pile) {
    double sum = 0;
    for (const Contact& c : pile.contacts) {
        if (c.a == 0) sum -= c.impulse.z();
    }
    return sum;
}

TEST(DirectStep, StopsATowerInItsFirstStep) {
    Pile pile = towerOf(40, [](int) { return 1.0; });
    pile.resolve(sweeping());
    EXPECT_LT(largestSpeed(pile), 1e-6 * fall) << "ten times its softness";
    EXPECT_NEAR(pushOnGround(pile), 40 * fall, 1e-6 * fall);
}

TEST(DirectStep, IsWhatStopsIt) {
    Pile pile = towerOf(40, [](int) { return 1.0; });
    ResolutionSettings settings = sweeping();
    settings.restitution_threshold = 0;  // so it does not count as resting
    pile.resolve(settings);
    EXPECT_GT(largestSpeed(pile), 1e-4) << "twenty sweeps are not enough for forty boxes";
}

TEST(DirectStep, HoldsAThousandTimesHeavierBoxOnALightOne) {
    Pile pile = towerOf(2, [](int i) { return i == 0 ? 1.0 : 1000.0; });
    pile.resolve(sweeping());
    EXPECT_LT(largestSpeed(pile), 1e-9);
    EXPECT_NEAR(pushOnGround(pile), 1001 * fall, 1e-6);
}

TEST(DirectStep, LeavesEveryImpulseInItsFrictionCone) {
    Pile pile = towerOf(
        3, [](int) { return 1.0; }, 0.1);
    for (BodyIndex i = 1; i < pile.v.size(); ++i) pile.v[i].x() = 0.2 * fall;  // more than friction can stop
    pile.resolve(sweeping());
    for (const Contact& c : pile.contacts) {
        const double normal = c.normal.dot(c.impulse);
        EXPECT_GE(normal, -1e-12);
        EXPECT_LE((c.impulse - normal * c.normal).norm(), 0.1 * normal + 1e-9);
    }
    EXPECT_GT(pile.v[1].x(), 0.05 * fall);
}

TEST(AcceleratedSweeps, KeepMomentumWithAndWithoutColours) {
    for (const std::size_t contacts : {100, 2000}) {
        Pile pile = test::randomPile(7, contacts / 4, contacts);
        const Vec3 momentum = pile.momentum();
        const Vec3 angular = pile.angularMomentum();
        ResolutionSettings settings = sweeping();
        const double energy = pile.energy();
        pile.resolve(settings);
        EXPECT_LT(pile.energy(), 0.99 * energy);
        EXPECT_LT((pile.momentum() - momentum).norm(), 1e-12 * static_cast<double>(contacts));
        EXPECT_LT((pile.angularMomentum() - angular).norm(), 1e-11 * static_cast<double>(contacts));
    }
}

/// Two bodies with a few contacts, or one that touches the fixed body 0. @param number picks what kind of pair
void addPair(Pile& pile, std::size_t number, test::Random& random) {
    const auto body = [&](double mass) {
        const BodyIndex i = pile.add(random.vector(1), mass, test::randomInertia(random, mass));
        pile.v[i] = random.vector(1);
        pile.w[i] = random.vector(1);
        return i;
    };
    const bool singular = number % 11 == 3;
    const BodyIndex a = number % 5 == 1 ? 0 : body(random.uniform(0.5, 3));
    const BodyIndex b = body(singular ? 1e200 : random.uniform(0.5, 3));
    for (std::size_t i = 0; i < 1 + number % 4 + number % 3; ++i) {
        pile.touch(a, b, random.vector(1), random.vector(1).normalized(), 0.25, {0.4, 0.4});
    }
    if (number % 13 == 5) pile.v[b].x() = std::numeric_limits<double>::quiet_NaN();
}

TEST(AcceleratedSweeps, TreatFourPairsAtOnceAsEachAlone) {
    ResolutionSettings settings = sweeping();
    settings.iterations = 1;
    test::expectAsEachAlone(addPair, settings, 1e-12);
}

TEST(AcceleratedSweeps, GiveTheSameBitsOnAnyNumberOfThreads) {
    const Pile before = test::randomPile(8, 600, 3000, 5);
    ResolutionSettings settings = sweeping();
    Pile one = before;
    one.resolve(settings);
    for (const int threads : {2, 3, 4, 8}) {
        Pile many = before;
        many.resolve(*makeResolution(ResolutionKind::accelerated_sweeps), settings, Executor(threads));
        for (std::size_t i = 0; i < one.v.size(); ++i) {
            ASSERT_EQ(one.v[i], many.v[i]) << threads;
            ASSERT_EQ(one.w[i], many.w[i]) << threads;
        }
    }
}

/// @return sweeps over a tower whose boxes all move with a velocity, and whose contacts are so deep
std::int64_t sweepsOfTower(const Vec3& velocity, double tolerance, double depth = 0) {
    Pile pile = towerOf(8, [](int) { return 1.0; });
    pile.gravity = Vec3(0, 0, -10);
    for (BodyIndex box = 1; box < pile.v.size(); ++box) pile.v[box] += velocity;
    for (Contact& contact : pile.contacts) contact.distance = -depth * contact.allowed_overlap;
    ResolutionSettings settings = sweeping();
    settings.tolerance = tolerance;
    settings.restitution_threshold = 0;  // so nothing counts as resting and takes direct steps
    return pile.resolve(settings).global_iterations / (2 * static_cast<std::int64_t>(pile.contacts.size()));
}

TEST(AcceleratedSweeps, SweepWhatMovesAsFarAsItsMotionNeeds) {
    const Vec3 hardly(1e-9, 0, 0);
    const std::int64_t slow = sweepsOfTower(hardly, 0.4);
    EXPECT_EQ(sweepsOfTower(Vec3(9, 0, 0), 0.4), 1);
    EXPECT_GT(slow, 1);
    EXPECT_LT(slow, sweepsOfTower(hardly, 0.01));
    EXPECT_EQ(sweepsOfTower(Vec3(9, 0, 0), 0), 20) << "all that are allowed";
}

TEST(AcceleratedSweeps, SweepMoreWhereBodiesAreDeepInEachOther) {
    const Vec3 slow(0.3, 0, 0);
    EXPECT_EQ(sweepsOfTower(slow, 0.4, 0.7), sweepsOfTower(slow, 0.4, 0)) << "as deep as a correction leaves them";
    EXPECT_GT(sweepsOfTower(slow, 0.4, 2), sweepsOfTower(slow, 0.4, 0));
}

/// @return visits of a tower of 20 whose 19 pairs of boxes and so many more make 1.5 per box with 11
std::int64_t visitsOfRestingTower(BodyIndex more_pairs) {
    Pile pile = towerOf(20, [](int) { return 1.0; });
    for (BodyIndex i = 1; i <= more_pairs; ++i) pile.touch(i, i + 2, Vec3(0, 0, i + 0.5), -Vec3::UnitZ());
    std::ranges::stable_sort(pile.contacts, {}, [](const Contact& c) { return std::pair(c.a, c.b); });
    return pile.resolve(sweeping()).global_iterations;
}

TEST(AcceleratedSweeps, TakeDirectStepsWhereFewPairsTouch) {
    const std::int64_t without = visitsOfRestingTower(12);
    EXPECT_LT(2 * visitsOfRestingTower(0), without);
    EXPECT_LT(2 * visitsOfRestingTower(11), without);
}

TEST(AcceleratedSweeps, LeaveABatchAsleepAloneButKeepItsImpulses) {
    Pile pile = towerOf(3, [](int) { return 1.0; });
    for (BodyIndex i = 1; i < pile.v.size(); ++i) {
        pile.v[i].setZero();
        pile.asleep[i] = 1;
    }
    for (Contact& c : pile.contacts) c.last_impulse = Vec3(0, 0, -1);
    EXPECT_EQ(pile.resolve(sweeping()).global_iterations, 0);
    for (const Contact& c : pile.contacts) EXPECT_EQ(c.impulse, c.last_impulse);
    EXPECT_EQ(pile.asleep[1], 1);
}

TEST(AcceleratedSweeps, AMovingSupportWakesABatch) {
    Pile pile = towerOf(3, [](int) { return 1.0; });
    for (BodyIndex i = 1; i < pile.v.size(); ++i) {
        pile.v[i].setZero();
        pile.asleep[i] = 1;
    }
    pile.v[0] = Vec3(0, 0, 1);
    pile.resolve(sweeping());
    EXPECT_EQ(pile.asleep[1], 0);
    EXPECT_GT(pile.v[3].z(), 0.9);
}

}  // namespace
}  // namespace cairn
