/// In a batch that sleeps in part only what is disturbed wakes, and wakes at once.
#include <gtest/gtest.h>

#include <cmath>

#include "resolution/batch_fixture.h"

namespace cairn {
namespace {

using test::Pile;

constexpr double wake_speed = 0.01;  // [m/s]

ResolutionSettings holdingSleepers() {
    ResolutionSettings settings = test::exactSettings();
    settings.resolution = ResolutionKind::accelerated_sweeps;
    settings.restitution_threshold = 0.05;
    settings.iterations = 1000;
    settings.tolerance = 0;
    settings.resolution_threshold = 1e-10;
    return settings;
}

/// Balls of 1 kg in a row along x, all asleep but the first.
Pile row(int balls) {
    Pile pile;
    pile.wake_speed = wake_speed;
    for (int i = 0; i < balls; ++i) {
        const BodyIndex ball = pile.addSphere(Vec3(i, 0, 0));
        pile.asleep[ball] = ball == 0 ? 0 : 1;
        if (ball > 0) pile.touch(ball - 1, ball, Vec3(i - 0.5, 0, 0), -Vec3::UnitX());
    }
    return pile;
}

int sleepersOf(const Pile& pile) {
    return static_cast<int>(std::ranges::count(pile.asleep, 1));
}

TEST(Selection, AnImpactGoesThroughASleepingRowInTheSameStep) {
    Pile pile = row(40);
    pile.v[0] = Vec3(20, 0, 0);
    pile.resolve(holdingSleepers());
    EXPECT_EQ(sleepersOf(pile), 0);
    EXPECT_NEAR(pile.momentum().x(), 20, 1e-9);
    for (const Vec3& v : pile.v) EXPECT_NEAR(v.x(), 0.5, 1e-6);
}

TEST(Selection, WhatIsTooSlowToWakeAnythingStops) {
    Pile pile = row(40);
    pile.v[0] = Vec3(0.7 * wake_speed, 0, 0);
    pile.resolve(holdingSleepers());
    EXPECT_EQ(sleepersOf(pile), 39);
    for (const Vec3& v : pile.v) EXPECT_LT(v.norm(), 1e-12);
}

TEST(Selection, WithoutAWakeSpeedAllAreResolved) {
    Pile pile = row(40);
    pile.v[0] = Vec3(0.002, 0, 0);
    pile.wake_speed = 0;
    pile.resolve(holdingSleepers());
    EXPECT_EQ(sleepersOf(pile), 0);
    EXPECT_NEAR(pile.momentum().x(), 0.002, 1e-12);
}

TEST(Selection, WhatCarriesTheSamePushSleepsOnAndKeepsItsImpulses) {
    Pile pile = row(10);
    for (Contact& contact : pile.contacts) {
        contact.last_impulse = -0.5 * Vec3::UnitX();
        contact.reference_impulse = contact.last_impulse;
    }
    pile.v[0] = Vec3(0.5 + 0.9 * wake_speed / 2, 0, 0);
    pile.resolve(holdingSleepers());
    EXPECT_EQ(sleepersOf(pile), 9);
    EXPECT_NEAR(pile.v[0].x(), 0, 1e-12);
    EXPECT_EQ(pile.contacts[5].impulse, pile.contacts[5].last_impulse);
    EXPECT_EQ(pile.contacts[0].reference_impulse, pile.contacts[0].last_impulse) << "small differences add up";
}

TEST(Selection, WhoIsResolvedAlongSleepsOnUnlessItIsPushed) {
    for (const double part_of_limit : {0.9, 1.1}) {
        Pile pile = row(4);  // of which too few sleep to be held
        const double common = part_of_limit * wake_speed / std::sqrt(2);
        pile.v[0] = Vec3(4 * common, 0, 0);
        pile.resolve(holdingSleepers());
        EXPECT_NEAR(pile.v[0].x(), common, 1e-9);
        const bool pushed = part_of_limit > 1;
        for (BodyIndex i = 1; i < 4; ++i) {
            EXPECT_EQ(pile.asleep[i], pushed ? 0 : 1);
            EXPECT_EQ(pile.woken[i], pushed ? WakeReason::struck : WakeReason::none);
            EXPECT_NEAR(pile.v[i].x(), pushed ? common : 0, 1e-9);
        }
    }
}

TEST(Selection, WhatGravityGivesPushesNobodyWhoseLastFlightWasDenied) {
    for (const bool denied : {false, true}) {
        for (const double falls : {1.0, 3.0}) {
            Pile pile;
            pile.wake_speed = wake_speed;
            pile.gravity = Vec3(0, 0, -10);
            const Vec3 fall = pile.gravity / 240;
            const BodyIndex above = pile.addSphere(Vec3(0, 0, 1));
            const BodyIndex below = pile.addSphere(Vec3(0, 0, 0));
            pile.touch(above, below, Vec3(0, 0, 0.5), Vec3::UnitZ());
            pile.v[above] = falls * fall;
            pile.asleep[below] = 1;
            pile.held[below] = denied ? 1 : 0;
            pile.resolve(holdingSleepers());
            EXPECT_EQ(pile.asleep[below], denied && falls == 1 ? 1 : 0) << denied << " " << falls;
        }
    }
}

TEST(Selection, AContactOfTwoAwakeBodiesIsTheNextReference) {
    Pile pile = row(3);
    pile.v[0] = Vec3(3, 0, 0);
    pile.resolve(holdingSleepers());
    for (const Contact& contact : pile.contacts) EXPECT_EQ(contact.reference_impulse, contact.impulse);
    EXPECT_NEAR(pile.contacts[0].impulse.x(), -2, 1e-9);
}

TEST(Selection, WhatIsNotPassedStaysAsItIs) {
    // Two rows, of which only the second one is resolved, as around struck bodies.
    const Executor executor;
    for (const bool sleeps : {false, true}) {
        Pile pile = row(3);
        const BodyIndex first = pile.addSphere(Vec3(0, 9, 0));
        const BodyIndex second = pile.addSphere(Vec3(1, 9, 0));
        pile.asleep[second] = sleeps ? 1 : 0;
        pile.touch(first, second, Vec3(0.5, 9, 0), -Vec3::UnitX());
        for (Contact& contact : pile.contacts) {
            contact.impulse = -Vec3::UnitX();
            contact.last_impulse = -2 * Vec3::UnitX();
            contact.reference_impulse = -3 * Vec3::UnitX();
        }
        const std::vector<BodyIndex> bodies{first, second};
        const std::vector<std::uint32_t> contacts{2};
        const BatchView batch{bodies, contacts, {}};
        Selection selection;
        selection.begin({{&batch, 1}, pile.contacts, pile.state(), Selecting::awake_parts, wake_speed, executor});
        selection.finish();
        for (const std::size_t i : {0, 1}) {
            EXPECT_EQ(pile.contacts[i].impulse.x(), -1);
            EXPECT_EQ(pile.contacts[i].reference_impulse.x(), -3);
        }
        EXPECT_EQ(pile.contacts[2].reference_impulse.x(), -1);
    }
}

TEST(Selection, TheImpulseQueueWakesWhatItTouches) {
    Pile pile = row(3);
    pile.v[0] = Vec3(0.003, 0, 0);
    ResolutionSettings settings = holdingSleepers();
    settings.resolution = ResolutionKind::impulse_queue;
    pile.resolve(settings);
    EXPECT_EQ(pile.asleep[1], 0);
}

}  // namespace
}  // namespace cairn
