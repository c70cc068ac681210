/// The options of the contact law: energetic restitution, impacts in sequence or at once, rolling and spinning
/// friction.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "batch_fixture.h"
#include "resolution/energetic_impulse.h"
#include "resolution/local_batch.h"

namespace cairn::test {
namespace {

ResolutionSettings lawSettings(ResolutionKind kind) {
    ResolutionSettings settings;
    settings.resolution = kind;
    settings.resolution_threshold = 1e-12;
    settings.restitution_threshold = 1e-9;
    settings.iterations = kind == ResolutionKind::impulse_queue ? 0 : 2000;
    settings.shock_propagation = false;
    settings.tolerance = 0;
    return settings;
}

constexpr std::array<ResolutionKind, 3> kinds = {ResolutionKind::impulse_queue, ResolutionKind::sweep,
                                                 ResolutionKind::accelerated_sweeps};

/// A rod or another skew body that strikes the ground with one point.
Pile skewImpact(Random& random) {
    Pile pile;
    const BodyIndex ground = pile.addFixed();
    const Vec3 moments(random.uniform(0.01, 1), random.uniform(0.01, 1), random.uniform(0.01, 1));
    const Quat turned =
        Quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Mat3 axes = turned.normalized().toRotationMatrix();
    const BodyIndex body = pile.add(random.vector(1), 1, axes * moments.asDiagonal() * axes.transpose());
    pile.v[body] = random.vector(3);
    pile.w[body] = random.vector(5);
    const double mu = random.uniform(0, 1.5);
    Contact& contact =
        pile.touch(ground, body, Vec3::Zero(), -Vec3::UnitZ(), random.uniform(0, 1), {mu, mu * random.uniform(0.5, 1)});
    // Closing, however it moved.
    if (pile.delta(contact) > 0) {
        pile.v[body] = -pile.v[body];
        pile.w[body] = -pile.w[body];
    }
    return pile;
}

TEST(EnergeticRestitution, NeverGainsEnergyWhereNewtonsDoes) {
    int gained_by_newton = 0;
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
        Random random(seed);
        const Pile start = skewImpact(random);
        for (const ResolutionKind kind : {ResolutionKind::impulse_queue, ResolutionKind::accelerated_sweeps}) {
            Pile pile = start;
            ResolutionSettings settings = lawSettings(kind);
            settings.restitution_law = RestitutionLaw::energetic;
            const double before = pile.energy();
            pile.resolve(settings);
            EXPECT_LE(pile.energy(), before * (1 + 1e-12)) << "seed " << seed;
            EXPECT_GE(pile.smallestDelta(), -1e-9) << "seed " << seed;
            const Vec3 impulse = -pile.contacts[0].impulse;
            EXPECT_LE(std::hypot(impulse.x(), impulse.y()),
                      pile.contacts[0].static_friction * impulse.z() * (1 + 1e-9) + 1e-12)
                << "seed " << seed;
        }
        Pile newton = start;
        const double before = newton.energy();
        newton.resolve(lawSettings(ResolutionKind::impulse_queue));
        if (newton.energy() > before * (1 + 1e-9)) ++gained_by_newton;
    }
    EXPECT_GT(gained_by_newton, 10);
}

TEST(EnergeticRestitution, IsNewtonsWithoutFriction) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        Pile newton = skewImpact(random);
        newton.contacts[0].static_friction = 0;
        newton.contacts[0].kinetic_friction = 0;
        Pile energetic = newton;
        ResolutionSettings settings = lawSettings(ResolutionKind::impulse_queue);
        newton.resolve(settings);
        settings.restitution_law = RestitutionLaw::energetic;
        energetic.resolve(settings);
        EXPECT_TRUE(energetic.v[1].isApprox(newton.v[1], 1e-9)) << seed;
        EXPECT_TRUE(energetic.w[1].isApprox(newton.w[1], 1e-9)) << seed;
    }
}

/// Central impact: friction does not change the normal velocity, so that all coefficients are the same.
TEST(EnergeticRestitution, OfABallIsTheRatioOfTheSpeedsWhetherItSlidesOrSticks) {
    for (const double speed : {0.5, 5.0}) {
        Pile pile;
        const BodyIndex ground = pile.addFixed();
        const BodyIndex ball = pile.addSphere(Vec3(0, 0, 0.5));
        pile.v[ball] = Vec3(speed, 0, -1);
        pile.touch(ground, ball, Vec3::Zero(), -Vec3::UnitZ(), 0.6, {0.3, 0.3});
        ResolutionSettings settings = lawSettings(ResolutionKind::impulse_queue);
        settings.restitution_law = RestitutionLaw::energetic;
        pile.resolve(settings);
        EXPECT_NEAR(pile.v[ball].z(), 0.6, 1e-12);
        // Sliding: µ(1 + e)v; sticking: what stops the point of contact, 2/7 of the speed.
        EXPECT_NEAR(pile.v[ball].x(), speed - std::min(0.3 * 1.6, speed * 2 / 7), 1e-12);
    }
}

/// Against the impact's differential equation, solved in a million steps of explicit friction.
TEST(EnergeticRestitution, FollowsTheSlidingAsItTurns) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        Random random(seed);
        Pile pile = skewImpact(random);
        Contact& contact = pile.contacts[0];
        contact.restitution = 0.5;
        contact.static_friction = contact.kinetic_friction = 0.15;
        LocalBatch batch;
        const std::array<BodyIndex, 1> bodies = {1};
        const std::array<std::uint32_t, 1> indices = {0};
        batch.gather({bodies, indices}, pile.contacts, pile.state());
        const ContactFrame& frame = batch.contacts[0];
        const Mat3 k = collisionMatrix(frame, batch.bodies[frame.a], batch.bodies[frame.b]).toMatrix();
        const Vec3 before = batch.velocityOf(frame);
        const double dp = -before[0] / k(0, 0) * 1e-6;
        Vec3 j = Vec3::Zero();
        double work = 0;
        double left = -1;
        while (left != 0) {
            const Vec3 v = before + k * j;
            const double slip = std::hypot(v[1], v[2]);
            const Vec3 dj = Vec3(1, -0.15 * v[1] / slip, -0.15 * v[2] / slip) * dp;
            const double given = dp * (v[0] + 0.5 * (k * dj)[0]);
            if (v[0] < 0) {
                work -= given;
            } else {
                if (left < 0) left = 0.25 * work;
                left = std::max(0.0, left - given);
            }
            j += dj;
        }
        const Vec3 impulse = energeticImpulse(frame, before, 0.5);
        EXPECT_LT((impulse - j).norm(), 0.01 * j.norm()) << "seed " << seed;
    }
}

/// Three equal touching balls, the first of which runs into the others.
std::array<double, 3> chain(ResolutionKind kind, Impacts impacts) {
    Pile pile;
    for (int i = 0; i < 3; ++i) pile.addSphere(Vec3(i, 0, 0));
    pile.v[0] = Vec3::UnitX();
    pile.touch(0, 1, Vec3(0.5, 0, 0), -Vec3::UnitX(), 1);
    pile.touch(1, 2, Vec3(1.5, 0, 0), -Vec3::UnitX(), 1);
    ResolutionSettings settings = lawSettings(kind);
    settings.impacts = impacts;
    pile.resolve(settings);
    return {pile.v[0].x(), pile.v[1].x(), pile.v[2].x()};
}

TEST(Impacts, RunThroughATouchingChainInSequenceOrAtOnceWithEveryResolution) {
    for (const ResolutionKind kind : kinds) {
        const auto sequential = chain(kind, Impacts::sequential);
        const auto simultaneous = chain(kind, Impacts::simultaneous);
        constexpr std::array<double, 3> passed_on = {0, 0, 1};
        constexpr std::array<double, 3> at_once = {-1.0 / 3, 2.0 / 3, 2.0 / 3};
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(sequential[i], passed_on[i], 1e-9) << static_cast<int>(kind) << " ball " << i;
            EXPECT_NEAR(simultaneous[i], at_once[i], 1e-9) << static_cast<int>(kind) << " ball " << i;
        }
    }
}

TEST(RollingFriction, HoldsABallOnTheGroundThatItsTorqueCanHold) {
    for (const ResolutionKind kind : kinds) {
        Pile pile;
        const BodyIndex ground = pile.addFixed();
        const BodyIndex ball = pile.addSphere(Vec3(0, 0, 0.5));
        // What gravity gives in a step on an incline of tan θ = 0.1; the torque holds up to 0.06/0.5.
        pile.v[ball] = Vec3(0.001, 0, -0.01);
        pile.touch(ground, ball, Vec3::Zero(), -Vec3::UnitZ(), 0, {0.5, 0.5}).rolling_friction = 0.06;
        pile.resolve(lawSettings(kind));
        EXPECT_LT(pile.v[ball].norm(), 1e-12) << static_cast<int>(kind);
        EXPECT_LT(pile.w[ball].norm(), 1e-11) << static_cast<int>(kind);
        EXPECT_NEAR(pile.contacts[0].angular_impulse.norm(), 0.001 * 0.5, 1e-11);
    }
}

TEST(RollingFriction, SlowsARollingBallByItsTorque) {
    for (const ResolutionKind kind : kinds) {
        Pile pile;
        const BodyIndex ground = pile.addFixed();
        const BodyIndex ball = pile.addSphere(Vec3(0, 0, 0.5));
        pile.v[ball] = Vec3(1, 0, -0.01);
        pile.w[ball] = Vec3(0, 2, 0);
        pile.touch(ground, ball, Vec3::Zero(), -Vec3::UnitZ(), 0, {0.5, 0.5}).rolling_friction = 0.02;
        pile.resolve(lawSettings(kind));
        // m·r²(1 + 2/5)·Δω = −0.02 m · normal impulse
        EXPECT_NEAR(pile.w[ball].y(), 2 - 0.02 * 0.01 / (1.4 * 0.25), 1e-12) << static_cast<int>(kind);
        EXPECT_NEAR(pile.v[ball].x(), 0.5 * pile.w[ball].y(), 1e-12) << static_cast<int>(kind);
    }
}

TEST(SpinningFriction, SlowsASpinningBallByItsTorque) {
    for (const ResolutionKind kind : kinds) {
        Pile pile;
        const BodyIndex ground = pile.addFixed();
        const BodyIndex ball = pile.addSphere(Vec3(0, 0, 0.5));
        pile.v[ball] = Vec3(0, 0, -0.01);
        pile.w[ball] = Vec3(0, 0, 3);
        pile.touch(ground, ball, Vec3::Zero(), -Vec3::UnitZ(), 0, {0.5, 0.5}).spinning_friction = 0.03;
        pile.resolve(lawSettings(kind));
        EXPECT_NEAR(pile.w[ball].z(), 3 - 0.03 * 0.01 / 0.1, 1e-12) << static_cast<int>(kind);
        EXPECT_LT(pile.v[ball].norm(), 1e-12);
    }
}

}  // namespace
}  // namespace cairn::test
