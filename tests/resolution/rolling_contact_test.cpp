/// Contacts that resist rolling, as the accelerated sweeps visit them.
#include "resolution/rolling_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "resolution/batch_fixture.h"

namespace cairn {
namespace {

using test::Pile;

ResolutionSettings sweepingExactly(double sweeps) {
    ResolutionSettings settings = test::exactSettings();
    settings.resolution = ResolutionKind::accelerated_sweeps;
    settings.iterations = sweeps;
    settings.tolerance = 0;
    return settings;
}

/// A ball of 1 kg and 1 m that rolls on the ground, and falls for a moment.
Pile ballThatRolls(double rolling, double spinning) {
    Pile pile;
    pile.addFixed(Vec3(0, 0, -0.5));
    const BodyIndex ball = pile.addSphere(Vec3(0, 0, 0.5));
    pile.v[ball] = Vec3(1, 0, -0.1);
    pile.w[ball] = Vec3(0, 2, 3);
    Contact& contact = pile.touch(0, ball, Vec3::Zero(), -Vec3::UnitZ(), 0, {10, 10});
    contact.rolling_friction = rolling;
    contact.spinning_friction = spinning;
    return pile;
}

TEST(RollingContact, OneVisitStopsWhatMayNotRoll) {
    Pile pile = ballThatRolls(100, 100);
    pile.resolve(sweepingExactly(1));
    EXPECT_LT(pile.v[1].norm(), 1e-14);
    EXPECT_LT(pile.w[1].norm(), 1e-14);
}

TEST(RollingContact, TorquesActAgainstRollingAndSpinningAsFarAsTheyMay) {
    Pile pile = ballThatRolls(0.5, 0.25);
    pile.resolve(sweepingExactly(20));
    const Contact& contact = pile.contacts.front();
    EXPECT_NEAR(contact.impulse.z(), -0.1, 1e-14);
    // On A, the ground, so in the direction of the ball's turns.
    EXPECT_NEAR(contact.angular_impulse.x(), 0, 1e-14);
    EXPECT_NEAR(contact.angular_impulse.y(), 0.5 * 0.1, 1e-14);
    EXPECT_NEAR(contact.angular_impulse.z(), 0.25 * 0.1, 1e-14);
    EXPECT_NEAR(pile.v[1].x(), 0.5 * pile.w[1].y(), 1e-14) << "it does not slide";
    EXPECT_NEAR(pile.w[1].y(), 2 - 0.05 / 0.35, 1e-14) << "0.35 kg·m² about where it touches";
    EXPECT_NEAR(pile.w[1].z(), 3 - 0.025 / 0.1, 1e-14);
}

/// Every third contact of a pile resists rolling, every seventh spinning.
Pile resisting(Pile pile) {
    for (std::size_t i = 0; i < pile.contacts.size(); ++i) {
        pile.contacts[i].rolling_friction = i % 3 == 0 ? 0.05 : 0;
        pile.contacts[i].spinning_friction = i % 7 == 0 ? 0.02 : 0;
    }
    return pile;
}

TEST(RollingContact, KeepsMomentumAndLosesEnergy) {
    for (const std::size_t contacts : {30, 100, 2000}) {
        Pile pile = resisting(test::randomPile(7, contacts / 4, contacts));
        const Vec3 momentum = pile.momentum();
        const Vec3 angular = pile.angularMomentum();
        const double energy = pile.energy();
        pile.resolve(sweepingExactly(20));
        EXPECT_LT(pile.energy(), 0.99 * energy);
        EXPECT_LT((pile.momentum() - momentum).norm(), 1e-12 * static_cast<double>(contacts));
        EXPECT_LT((pile.angularMomentum() - angular).norm(), 1e-11 * static_cast<double>(contacts));
    }
}

TEST(RollingContact, NoTorqueIsBeyondItsBound) {
    Pile pile = resisting(test::randomPile(9, 100, 500, 5));
    pile.resolve(sweepingExactly(20));
    int bound = 0;
    for (const Contact& c : pile.contacts) {
        const double normal = c.normal.dot(c.impulse);
        const double spin = c.normal.dot(c.angular_impulse);
        const double roll = (c.angular_impulse - spin * c.normal).norm();
        EXPECT_GE(normal, -1e-15);
        EXPECT_LE(std::abs(spin), c.spinning_friction * normal + 1e-15);
        EXPECT_LE(roll, c.rolling_friction * normal + 1e-15);
        bound += c.rolling_friction > 0 && normal > 0 && roll > 0.999 * c.rolling_friction * normal;
    }
    EXPECT_GT(bound, 10);
}

TEST(RollingContact, TheBitsAreTheSameOnAnyNumberOfThreads) {
    const Pile before = resisting(test::randomPile(8, 600, 3000, 5));
    Pile one = before;
    one.resolve(sweepingExactly(20));
    for (const int threads : {2, 3, 4, 8}) {
        Pile many = before;
        many.resolve(*makeResolution(ResolutionKind::accelerated_sweeps), sweepingExactly(20), Executor(threads));
        for (std::size_t i = 0; i < one.v.size(); ++i) {
            ASSERT_EQ(one.v[i], many.v[i]) << threads;
            ASSERT_EQ(one.w[i], many.w[i]) << threads;
        }
        for (std::size_t i = 0; i < one.contacts.size(); ++i) {
            ASSERT_EQ(one.contacts[i].angular_impulse, many.contacts[i].angular_impulse) << threads;
        }
    }
}

/// Two bodies that resist rolling, or one that touches the fixed body 0. @param number picks what kind of pair
void addResistingPair(Pile& pile, std::size_t number, test::Random& random) {
    const auto body = [&](double mass) {
        const BodyIndex i = pile.add(random.vector(1), mass, test::randomInertia(random, mass));
        pile.v[i] = random.vector(1);
        pile.w[i] = random.vector(1);
        return i;
    };
    const BodyIndex a = number % 5 == 1 ? 0 : body(random.uniform(0.5, 3));
    const BodyIndex b = body(number % 11 == 3 ? 1e200 : random.uniform(0.5, 3));
    if (number % 13 == 7) pile.inertiaInv_W[b].setZero();
    for (std::size_t i = 0; i < 1 + number % 3; ++i) {
        Contact& contact = pile.touch(a, b, random.vector(1), random.vector(1).normalized(), 0.25, {0.4, 0.4});
        contact.rolling_friction = random.uniform(0, 0.3);
        contact.spinning_friction = random.uniform(0, 0.3);
    }
    if (number % 13 == 5) pile.v[b].x() = std::numeric_limits<double>::quiet_NaN();
}

TEST(RollingContact, FourPairsAtOnceAreTreatedAsEachAlone) {
    test::expectAsEachAlone(addResistingPair, sweepingExactly(1), 1e-11);
}

TEST(RollingContact, BodiesThatCannotTurnAreStoppedAsOthersAre) {
    Pile pile = ballThatRolls(0.5, 0.25);
    pile.inertiaInv_W[1].setZero();
    pile.w[1].setZero();
    pile.resolve(sweepingExactly(1));
    EXPECT_LT(pile.v[1].norm(), 1e-14);
    EXPECT_EQ(pile.contacts.front().angular_impulse, Vec3::Zero());
}

}  // namespace
}  // namespace cairn
