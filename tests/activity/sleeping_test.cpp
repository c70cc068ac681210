#include "activity/sleeping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace cairn {
namespace {

const Executor one_thread(1);
constexpr double time_step = 1.0 / 240;

/// Bodies with what the sleeping system looks at; all dynamic, unit mass and inertia.
struct Fixture {
    explicit Fixture(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            const BodyIndex body = bodies.allocate(BodyKind::dynamic);
            bodies.mass[body] = 1;
            bodies.inertia_B[body] = Vec3::Ones();
            bodies.r_max[body] = 0.5;
            bodies.updateMassProperties(body);
        }
    }

    std::vector<std::int32_t> supports(const Vec3& acceleration) {
        std::vector<std::int32_t> result(bodies.slots());
        countSupports(bodies.kind, contacts, acceleration, result);
        return result;
    }

    void sleep(const SleepSettings& settings, double step = time_step) {
        fallAsleep(bodies.state(), {bodies.motion, bodies.r_max, bodies.constant_force, bodies.constant_torque},
                   settings, {.time = step}, one_thread);
    }

    /// Likewise, of bodies of which it is known where they went.
    void sleepGone(const SleepSettings& settings, std::span<const BodyWay> way) {
        MotionState motion{bodies.motion, bodies.r_max, bodies.constant_force, bodies.constant_torque};
        motion.way = way;
        motion.part_length = time_step;
        motion.mean_v = bodies.mean_v;
        motion.mean_w = bodies.mean_w;
        fallAsleep(bodies.state(), motion, settings, {.time = time_step}, one_thread);
    }

    /// Lets the first body fly for a step with a velocity.
    void fly(const SleepSettings& settings, const Vec3& v) {
        const std::vector<BodyWay> way(1, BodyWay{.begin = {bodies.position[0], bodies.orientation[0]}, .v = v});
        bodies.v[0] = v;
        bodies.position[0] += time_step * v;
        sleepGone(settings, way);
        bodies.woken[0] = WakeReason::none;
    }

    BodyStorage bodies;
    std::vector<Contact> contacts;
};

const Vec3 gravity(0, 0, -10);

TEST(Supports, Figure17aPileOfThreeSpheres) {
    // Two spheres beside each other on the ground, a third on top of both.
    Fixture s(4);
    s.bodies.kind[0] = BodyKind::fixed;
    const Vec3 up = Vec3::UnitZ();
    const Vec3 slanted_left = Vec3(-0.5, 0, -0.866).normalized();  // from the top sphere down to the left one
    const Vec3 slanted_right = Vec3(0.5, 0, -0.866).normalized();
    s.contacts = {{.a = 0, .b = 1, .normal = -up},
                  {.a = 0, .b = 2, .normal = -up},
                  {.a = 1, .b = 2, .normal = -Vec3::UnitX()},
                  {.a = 1, .b = 3, .normal = slanted_left},
                  {.a = 2, .b = 3, .normal = slanted_right}};
    EXPECT_EQ(s.supports(gravity), (std::vector<std::int32_t>{0, 1, 1, 2}));
    EXPECT_EQ(s.supports(-gravity), (std::vector<std::int32_t>{0, 1, 1, 0}));
    EXPECT_EQ(s.supports(Vec3::Zero()), (std::vector<std::int32_t>{0, 0, 0, 0}));
}

TEST(Supports, AWallBesideABodyIsNoSupportInSpiteOfRounding) {
    Fixture s(2);
    s.bodies.kind[0] = BodyKind::fixed;
    s.contacts = {{.a = 0, .b = 1, .normal = Vec3(1, 0, 1e-9).normalized()}};
    EXPECT_EQ(s.supports(gravity)[1], 0);
}

TEST(Waking, LosingOneOfTwoSupportsWakes) {
    Fixture s(1);
    s.bodies.asleep[0] = 1;
    wakeUnsupported(s.bodies.state(), std::vector<std::int32_t>{2}, std::vector<std::int32_t>{1}, one_thread);
    EXPECT_EQ(s.bodies.asleep[0], 0);
    EXPECT_EQ(s.bodies.woken[0], WakeReason::support_lost);
}

TEST(Waking, HavingNoSupportWakesEvenWithoutHistory) {
    Fixture s(2);
    s.bodies.asleep[0] = s.bodies.asleep[1] = 1;
    wakeUnsupported(s.bodies.state(), std::vector<std::int32_t>{-1, 0}, std::vector<std::int32_t>{0, 0}, one_thread);
    EXPECT_EQ(s.bodies.woken[0], WakeReason::floating);
    EXPECT_EQ(s.bodies.woken[1], WakeReason::floating);
}

TEST(Waking, ANeighbourThatMovesAwaySidewaysDoesNotWake) {
    Fixture s(3);
    s.bodies.kind[0] = BodyKind::fixed;
    s.bodies.asleep[1] = 1;
    s.contacts = {{.a = 0, .b = 1, .normal = -Vec3::UnitZ()}, {.a = 1, .b = 2, .normal = Vec3::UnitX()}};
    const auto before = s.supports(gravity);
    s.contacts.pop_back();
    wakeUnsupported(s.bodies.state(), before, s.supports(gravity), one_thread);
    EXPECT_EQ(s.bodies.asleep[1], 1);
}

TEST(Waking, KeepingOrGainingSupportsDoesNotWake) {
    Fixture s(2);
    s.bodies.asleep[0] = s.bodies.asleep[1] = 1;
    wakeUnsupported(s.bodies.state(), std::vector<std::int32_t>{2, 1}, std::vector<std::int32_t>{2, 3}, one_thread);
    EXPECT_EQ(s.bodies.asleep[0], 1);
    EXPECT_EQ(s.bodies.asleep[1], 1);
}

TEST(FallingAsleep, FollowsAlgorithm5) {
    Fixture s(1);
    SleepSettings settings;
    settings.sleep_threshold = 0.01;
    const double step = std::log(0.5) / std::log(0.9) / 240;  // after which half of the history counts
    s.bodies.motion[0] = 4e-4;
    s.bodies.v[0] = Vec3(0.003, 0, 0.004);
    s.bodies.w[0] = Vec3(0, 0.006, 0.008);
    // m² = 2 (0.005² + 0.01²·0.5²) = 1e-4; rwa = 0.5·4e-4 + 0.5·1e-4
    s.sleep(settings, step);
    EXPECT_DOUBLE_EQ(s.bodies.motion[0], 2.5e-4);
    EXPECT_EQ(s.bodies.asleep[0], 0);

    s.bodies.v[0] = Vec3::Zero();
    s.bodies.w[0] = Vec3::Zero();
    s.sleep(settings, step);
    EXPECT_DOUBLE_EQ(s.bodies.motion[0], 1.25e-4);
    EXPECT_EQ(s.bodies.asleep[0], 0);
    s.bodies.v[0] = Vec3(1e-3, 0, 0);
    s.sleep(settings, step);
    EXPECT_EQ(s.bodies.asleep[0], 1);
    EXPECT_EQ(s.bodies.v[0], Vec3::Zero());
    EXPECT_DOUBLE_EQ(s.bodies.motion[0], 1e-4);
}

TEST(FallingAsleep, WhoGoesNowhereSleepsInSpiteOfItsVelocity) {
    Fixture s(4);
    const SleepSettings settings{.sleep_threshold = 0.01};
    const Vec3 v(0, 0, -0.05);
    const Vec3 w(0.1, 0, 0);
    const std::vector<BodyWay> way(4, BodyWay{.begin = {}, .v = v, .w = w});
    for (int i = 0; i < 4; ++i) s.bodies.motion[i] = 0;
    std::ranges::fill(s.bodies.v, v);
    std::ranges::fill(s.bodies.w, w);
    // The first is where it was, the second went by its velocity, the third turned by it, and the last was struck.
    s.bodies.position[1] = time_step * v;
    s.bodies.orientation[2] = Quat(Eigen::AngleAxisd(time_step * w.norm(), Vec3::UnitX()));
    s.bodies.v[3] = Vec3(1, 0, 0);
    // As they did for long.
    s.bodies.mean_v[1] = v;
    s.bodies.mean_w[2] = w;
    s.sleepGone(settings, way);
    EXPECT_EQ(std::vector<int>(s.bodies.asleep.begin(), s.bodies.asleep.end()), (std::vector<int>{1, 0, 0, 0}));
    EXPECT_NEAR(s.bodies.motion[1], 0.1 * 2 * 0.05 * 0.05, 1e-15);
    EXPECT_NEAR(s.bodies.motion[2], 0.1 * 2 * 0.1 * 0.1 * 0.5 * 0.5, 1e-15);
}

TEST(FallingAsleep, WhoTurnsOnceInAStepDoesNotSleep) {
    Fixture s(1);
    const SleepSettings settings{.sleep_threshold = 0.01};
    const std::vector<BodyWay> way(1, BodyWay{.begin = {}, .w = Vec3(0, 0, 2 * std::numbers::pi / time_step)});
    s.bodies.motion[0] = 0;
    s.bodies.w[0] = way[0].w;
    s.sleepGone(settings, way);
    EXPECT_EQ(s.bodies.asleep[0], 0);
}

/// Whether a body falls asleep within a second of flights to and fro. @param drift beside that [m/s]
bool sleepsShaking(double speed, double drift) {
    Fixture s(1);
    const SleepSettings settings{.sleep_threshold = 0.01};
    s.bodies.motion[0] = initialMotion(settings);
    for (int i = 0; i < 240 && s.bodies.asleep[0] == 0; ++i) {
        s.fly(settings, Vec3(i % 2 == 0 ? speed : -speed, 0, drift));
    }
    return s.bodies.asleep[0] != 0;
}

TEST(FallingAsleep, WhoGoesNowhereOnTheMeanSleepsUnlessItShakesHard) {
    EXPECT_TRUE(sleepsShaking(0.03, 0));
    EXPECT_FALSE(sleepsShaking(0.04, 0));
    EXPECT_TRUE(sleepsShaking(0.01, 0.005));
    EXPECT_FALSE(sleepsShaking(0.01, 0.01));
    EXPECT_FALSE(sleepsShaking(0, 0.01));
}

TEST(FallingAsleep, TheTopOfAFlightIsNoRest) {
    Fixture s(1);
    const SleepSettings settings{.sleep_threshold = 8.33e-3};
    s.bodies.motion[0] = initialMotion(settings);
    for (int i = -100; i < 100; ++i) {
        s.fly(settings, i * time_step * gravity);
        ASSERT_EQ(s.bodies.asleep[0], 0) << i;
    }
}

TEST(FallingAsleep, WhoWasPushedFromItsSleepMoves) {
    Fixture s(1);
    const SleepSettings settings{.sleep_threshold = 0.01};
    s.bodies.asleep[0] = 1;
    s.bodies.motion[0] = 1e-4;
    s.bodies.state().wake(0, WakeReason::changed);
    for (int i = 0; i < 100; ++i) {
        s.fly(settings, Vec3(0.015, 0, 0));
        ASSERT_EQ(s.bodies.asleep[0], 0) << i;
    }
}

/// Whether a sleeper that is pushed sleeps again in the step after it. @param then its speed in that one [m/s]
bool sleepsAfterPush(double speed, double then) {
    Fixture s(1);
    const SleepSettings settings{.sleep_threshold = 0.01};
    s.bodies.asleep[0] = 1;
    s.bodies.motion[0] = 1e-4;
    s.bodies.state().wake(0, WakeReason::struck);
    s.fly(settings, Vec3(speed, 0, 0));
    EXPECT_EQ(s.bodies.asleep[0], 0) << "the next step tells";
    s.bodies.woken[0] = WakeReason::none;
    s.fly(settings, Vec3(then, 0, 0));
    return s.bodies.asleep[0] != 0;
}

TEST(FallingAsleep, WhoWasPushedStaysAwakeIfAndOnlyIfItGoesOn) {
    for (const double speed : {0.0075, 0.1, 10.0}) {
        EXPECT_TRUE(sleepsAfterPush(speed, 0.007)) << speed;
        EXPECT_FALSE(sleepsAfterPush(speed, 0.0072)) << speed;
    }
}

TEST(FallingAsleep, TheHistoryDecaysAlikeAtAnyTimeStep) {
    EXPECT_EQ(motionBias({.time = 1.0 / 240}), 0.9);
    EXPECT_DOUBLE_EQ(std::pow(motionBias({.time = 1.0 / 960}), 4), 0.9);
    EXPECT_EQ(motionBias({.time = 1.0 / 60, .usual = 60}), 0.9);
}

TEST(FallingAsleep, TheAverageIsCappedSoThatASuddenStopIsNotForgottenTooLate) {
    Fixture s(1);
    SleepSettings settings;
    settings.sleep_threshold = 0.01;
    s.bodies.v[0] = Vec3(100, 0, 0);
    s.sleep(settings);
    EXPECT_DOUBLE_EQ(s.bodies.motion[0], 9e-4);
}

TEST(FallingAsleep, AWokenBodySleepsAgainAtOnceIfAndOnlyIfItBarelyMoves) {
    SleepSettings settings;
    for (const double part : {0.99, 1.01}) {
        Fixture s(1);
        s.bodies.motion[0] = settings.sleep_threshold * settings.sleep_threshold;
        s.bodies.v[0] = Vec3(part * settings.sleep_threshold / std::sqrt(2.0), 0, 0);
        s.sleep(settings);
        EXPECT_EQ(s.bodies.asleep[0], part < 1 ? 1 : 0) << part;
    }
}

TEST(FallingAsleep, AConstantForceTooWeakToShowInOneStepKeepsABodyAwake) {
    SleepSettings settings;
    Fixture s(2);
    s.bodies.constant_force[0] = Vec3(0.1, 0, 0);
    s.sleep(settings);
    EXPECT_EQ(s.bodies.asleep[0], 0);
    EXPECT_EQ(s.bodies.asleep[1], 1);
}

TEST(FallingAsleep, FixedBodiesAreLeftAlone) {
    Fixture s(1);
    s.bodies.kind[0] = BodyKind::fixed;
    s.sleep(SleepSettings{});
    EXPECT_EQ(s.bodies.asleep[0], 0);
}

}  // namespace
}  // namespace cairn
