#include "integration/integration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "integration/springs.h"

namespace cairn {
namespace {

const Executor one_thread(1);

BodyIndex addBody(BodyStorage& bodies, double mass, const Vec3& inertia_B) {
    const BodyIndex i = bodies.allocate(BodyKind::dynamic);
    bodies.mass[i] = mass;
    bodies.inertia_B[i] = inertia_B;
    bodies.r_max[i] = 0.5;
    bodies.updateMassProperties(i);
    return i;
}

Vec3 angularMomentum(const Quat& q, const Vec3& w, const Vec3& inertia_B) {
    return q * inertia_B.cwiseProduct(q.conjugate() * w);
}

TEST(Rotation, FreeRotationKeepsAngularMomentumAndEnergy) {
    // The box of the free-flight comparison: 0.1 × 0.4 × 0.9 m, 10 kg, near its unstable axis.
    const Vec3 inertia_B = Vec3(0.16 + 0.81, 0.01 + 0.81, 0.01 + 0.16) * (10.0 / 12);
    Quat q = Quat::Identity();
    Vec3 w(0.1, 5, 0.1);
    const Vec3 before = angularMomentum(q, w, inertia_B);
    const double energy = w.dot(before);
    for (int i = 0; i < 10000; ++i) rotateFreely(q, w, inertia_B, 1e-3);
    EXPECT_LT((angularMomentum(q, w, inertia_B) - before).norm() / before.norm(), 1e-12);
    EXPECT_NEAR(w.dot(angularMomentum(q, w, inertia_B)) / energy, 1, 1e-11);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
}

TEST(Rotation, FreeRotationIsOfFourthOrder) {
    const Vec3 inertia_B(1, 2, 3);
    const auto after = [&](int steps) {
        Quat q = Quat::Identity();
        Vec3 w(0.3, 2, 0.5);
        for (int i = 0; i < steps; ++i) rotateFreely(q, w, inertia_B, 2.0 / steps);
        return w;
    };
    const Vec3 exact = after(20000);
    const double coarse = (after(40) - exact).norm();
    const double fine = (after(80) - exact).norm();
    EXPECT_NEAR(std::log2(coarse / fine), 4, 0.3);
}

TEST(Rotation, UniformRotationTurnsByTheAngle) {
    Quat q = Quat::Identity();
    for (int i = 0; i < 100; ++i) rotateUniformly(q, Vec3(0, 0, 1), 0.01);
    EXPECT_NEAR(Eigen::AngleAxisd(q).angle(), 1, 1e-13);
    rotateUniformly(q, Vec3(0, 0, 1e-12), 1);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
}

TEST(Positions, AwakeBodiesMoveByTheirVelocityAndNoteTheWay) {
    BodyStorage bodies;
    const BodyIndex awake = addBody(bodies, 1, Vec3(1, 2, 3));
    const BodyIndex asleep = addBody(bodies, 1, Vec3(1, 2, 3));
    const BodyIndex fixed = addBody(bodies, 1, Vec3(1, 2, 3));
    bodies.kind[fixed] = BodyKind::fixed;
    for (const BodyIndex i : {awake, asleep, fixed}) {
        bodies.v[i] = Vec3(1, 2, 3);
        bodies.w[i] = Vec3(0.1, 0.2, 0.3);
        bodies.linear_step[i] = Vec3::Ones();
    }
    bodies.asleep[asleep] = 1;
    advancePositions(bodies, 0.1, one_thread);
    EXPECT_TRUE(bodies.position[awake].isApprox(Vec3(0.1, 0.2, 0.3)));
    EXPECT_TRUE(bodies.linear_step[awake].isApprox(Vec3(0.1, 0.2, 0.3)));
    EXPECT_TRUE(bodies.inertiaInv_W[awake].isApprox(
        Mat3(bodies.orientation[awake].toRotationMatrix() * bodies.inertiaInv_B[awake].asDiagonal() *
             bodies.orientation[awake].toRotationMatrix().transpose())));
    EXPECT_FALSE(bodies.orientation[awake].isApprox(Quat::Identity()));
    for (const BodyIndex i : {asleep, fixed}) {
        EXPECT_EQ(bodies.position[i], Vec3::Zero());
        EXPECT_EQ(bodies.linear_step[i], Vec3::Zero());
        EXPECT_TRUE(bodies.orientation[i].isApprox(Quat::Identity()));
    }
}

TEST(Velocities, ForcesTorquesAndGravityActForOneStep) {
    BodyStorage bodies;
    const BodyIndex i = addBody(bodies, 2, Vec3(1, 2, 4));
    bodies.force[i] = Vec3(4, 0, 0);
    bodies.constant_force[i] = Vec3(0, 2, 0);
    bodies.torque[i] = Vec3(0, 2, 0);
    bodies.constant_torque[i] = Vec3(0, 0, 4);
    const SleepSettings off{.damping = 0};
    advanceVelocities(bodies, Vec3(0, 0, -10), off, 0.1, one_thread);
    clearForces(bodies, one_thread);
    EXPECT_TRUE(bodies.v[i].isApprox(Vec3(0.2, 0.1, -1)));
    EXPECT_TRUE(bodies.w[i].isApprox(Vec3(0, 0.1, 0.1)));
    advanceVelocities(bodies, Vec3::Zero(), off, 0.1, one_thread);
    EXPECT_TRUE(bodies.v[i].isApprox(Vec3(0.2, 0.2, -1)));
    EXPECT_TRUE(bodies.w[i].isApprox(Vec3(0, 0.1, 0.2)));
}

TEST(Velocities, AddingInStepsSumsToTheWholeWithoutRoundingInOneDirection) {
    for (const double acceleration : {-9.81, 2e-3, 1e5}) {
        const double gain = acceleration / 3840;
        double v = 60;
        double rounded = 60;
        for (int step = 1; step <= 38400; ++step) {
            const double next = addInSteps(v, gain, step);
            // Never off by more than a unit in the last place, or the rounding of 4096 gains together.
            EXPECT_NEAR(next, v + gain, 2.3e-16 * std::max(std::abs(v + gain), std::abs(4096 * gain)));
            v = next;
            rounded += gain;
        }
        const double exact = 60 + 10 * acceleration;
        EXPECT_LT(std::abs(v - exact), 2e-14 * std::abs(exact)) << acceleration;
        EXPECT_GT(std::abs(rounded - exact), 5e-14 * std::abs(exact)) << "so it is needed; " << acceleration;
    }
}

TEST(Velocities, AddingInStepsAddsNothingNotANumberAndInfinities) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(addInSteps(0, 0, 7), 0);
    EXPECT_EQ(addInSteps(3, 0, 7), 3);
    EXPECT_EQ(addInSteps(3, -3, 7), 0);
    EXPECT_EQ(addInSteps(1, infinity, 7), infinity);
    EXPECT_TRUE(std::isnan(addInSteps(std::nan(""), 1, 7)));
    EXPECT_NEAR(addInSteps(0, -1e-3, 4095), -1e-3, 1e-15);
}

TEST(Positions, CompletingFreeFallMeetsTheParabolaTo12DigitsAndLeavesDisplacedBodiesWhereTheyAre) {
    BodyStorage bodies;
    const BodyIndex free = addBody(bodies, 1, Vec3::Ones());
    const BodyIndex displaced = addBody(bodies, 1, Vec3::Ones());
    const double time_step = 1.0 / 3840;
    const Vec3 gravity(0, 0, -9.81);
    const Vec3 displacement(0, 0, 0.25);
    for (const BodyIndex i : {free, displaced}) bodies.v[i] = Vec3(3, -4, 60);
    VelocitiesBefore before;
    for (int step = 1; step <= 38400; ++step) {
        beginWays(bodies, one_thread, before);
        advancePositions(bodies, time_step, one_thread);
        if (step == 100) bodies.position[displaced] += displacement;
        saveVelocities(bodies, one_thread, before);
        advanceVelocities(bodies, gravity, {.damping = 0}, time_step, one_thread, step);
        saveForced(bodies, one_thread, before);
        completeSmoothMotion(bodies, before, {}, time_step, one_thread);
    }
    const Vec3 exact(30, -40, 600 - 490.5);
    EXPECT_LT((bodies.position[free] - exact).norm() / exact.norm(), 3e-13);
    EXPECT_LT((bodies.position[displaced] - exact - displacement).norm() / exact.norm(), 1e-11);
}

TEST(Positions, WhatGoesBackOnItsWayKeepsEnergyAndAngularMomentum) {
    const double time_step = 0.1;
    const Vec3 gravity(0, 0, -10);
    for (const double part : {0.75, 0.5, 0.25, 0.0}) {
        BodyStorage bodies;
        const BodyIndex i = addBody(bodies, 2, Vec3(1, 2, 3));
        bodies.v[i] = Vec3(1, 0, 4);
        bodies.w[i] = Vec3(3, 1, 2);
        const auto energy = [&] {
            const Vec3 w_B = bodies.orientation[i].conjugate() * bodies.w[i];
            return bodies.v[i].squaredNorm() + 0.5 * w_B.dot(Vec3(1, 2, 3).cwiseProduct(w_B)) +
                   20 * bodies.position[i].z();
        };
        const auto momentum = [&]() -> Vec3 {
            const Vec3 w_B = bodies.orientation[i].conjugate() * bodies.w[i];
            return bodies.orientation[i] * Vec3(1, 2, 3).cwiseProduct(w_B);
        };
        const double before_energy = energy();
        const Vec3 before_momentum = momentum();
        const Pose begin{bodies.position[i], bodies.orientation[i]};
        VelocitiesBefore before;
        beginWays(bodies, one_thread, before);
        advancePositions(bodies, time_step, one_thread);
        // Twice, as others make it go back again.
        flyBack(bodies, i, 0.9, gravity, {.damping = 0}, time_step, before.way[i]);
        flyBack(bodies, i, part, gravity, {.damping = 0}, time_step, before.way[i]);
        const double flown = part * time_step;
        saveVelocities(bodies, one_thread, before);
        advanceVelocities(bodies, gravity, {.damping = 0}, time_step, one_thread);
        saveForced(bodies, one_thread, before);
        completeSmoothMotion(bodies, before, {}, time_step, one_thread);
        const Vec3 way = flown * Vec3(1, 0, 4) + 0.5 * flown * flown * gravity;
        EXPECT_LT((bodies.position[i] - begin.position - way).norm(), 1e-14) << part;
        EXPECT_NEAR(energy(), before_energy, 1e-12) << part;
        EXPECT_LT((momentum() - before_momentum).norm(), 1e-12) << part;
        const Quat turned = part == 0 ? begin.orientation : bodies.orientation[i];
        EXPECT_EQ(bodies.orientation[i].coeffs(), turned.coeffs()) << part;
    }
}

TEST(Velocities, GravityDampingOfAlgorithm12) {
    const SleepSettings damping{.sleep_threshold = 0.01, .damping = 0.7};
    for (const double part : {0.99, 1.01}) {
        BodyStorage bodies;
        const BodyIndex i = addBody(bodies, 1, Vec3::Ones());
        // 2 (v² + w² r²) = threshold² exactly at part = 1, half of it from each velocity
        bodies.v[i] = Vec3(part * 0.05, 0, 0);
        bodies.w[i] = Vec3(0, 0, part * 0.1);
        advanceVelocities(bodies, Vec3(0, 0, -10), damping, 0.1, one_thread);
        EXPECT_NEAR(bodies.v[i].z(), part < 1 ? -0.3 : -1, 1e-15);
    }
}

TEST(Velocities, SleepingAndFixedBodiesGainNone) {
    BodyStorage bodies;
    const BodyIndex asleep = addBody(bodies, 1, Vec3::Ones());
    const BodyIndex fixed = addBody(bodies, 1, Vec3::Ones());
    const BodyIndex awake = addBody(bodies, 1, Vec3::Ones());
    bodies.asleep[asleep] = 1;
    bodies.kind[fixed] = BodyKind::fixed;
    advanceVelocities(bodies, Vec3(0, 0, -10), {}, 0.1, one_thread);
    EXPECT_LT(bodies.v[awake].z(), 0);
    EXPECT_EQ(bodies.v[asleep], Vec3::Zero());
    EXPECT_EQ(bodies.v[fixed], Vec3::Zero());
}

TEST(Springs, AnUndampedOscillatorHasItsPeriod) {
    BodyStorage bodies;
    const BodyIndex i = addBody(bodies, 2, Vec3::Ones());
    bodies.position[i] = Vec3(1.5, 0, 0);
    const std::vector<Spring> springs = {{.present = true, .a = i, .stiffness = 200, .rest_length = 1}};
    constexpr double time_step = 1e-5;
    // ω = √(k/m) = 10 rad/s: after half a period the mass is on the other side of its rest length.
    const int steps = static_cast<int>(3.14159265358979 / 10 / time_step);
    for (int k = 0; k < steps; ++k) {
        advancePositions(bodies, time_step, one_thread);
        applySprings(springs, bodies, time_step);
    }
    EXPECT_NEAR(bodies.position[i].x(), 0.5, 1e-3);
}

TEST(Springs, StiffSpringsOnLightBodiesDoNotExplodeAndKeepMomentum) {
    BodyStorage bodies;
    const BodyIndex a = addBody(bodies, 1e-3, Vec3::Constant(1e-6));
    const BodyIndex b = addBody(bodies, 1, Vec3::Constant(0.1));
    bodies.position[a] = Vec3(0, 0, 2);
    const std::vector<Spring> springs = {{.present = true,
                                          .a = a,
                                          .b = b,
                                          .anchor_a = Vec3(0.1, 0, 0),
                                          .anchor_b = Vec3(0, 0.2, 0),
                                          .stiffness = 1e8,
                                          .damping = 10,
                                          .rest_length = 1}};
    double fastest = 0;
    for (int k = 0; k < 1000; ++k) {
        advancePositions(bodies, 1.0 / 240, one_thread);
        applySprings(springs, bodies, 1.0 / 240);
        ASSERT_LT(bodies.v[a].norm(), 1e3);
        fastest = std::max(fastest, bodies.v[a].norm());
    }
    EXPECT_GT(fastest, 1);
    const Vec3 momentum = bodies.mass[a] * bodies.v[a] + bodies.mass[b] * bodies.v[b];
    EXPECT_LT(momentum.norm(), 1e-10);
}

TEST(Springs, AnAwakeEndWakesTheOther) {
    BodyStorage bodies;
    const BodyIndex a = addBody(bodies, 1, Vec3::Ones());
    const BodyIndex b = addBody(bodies, 1, Vec3::Ones());
    bodies.asleep[a] = 1;
    const std::vector<Spring> springs = {{.present = true, .a = a, .b = b}};
    wakeSpringEnds(springs, bodies);
    EXPECT_EQ(bodies.asleep[a], 0);
    EXPECT_EQ(bodies.woken[a], WakeReason::changed);
    bodies.asleep[a] = bodies.asleep[b] = 1;
    wakeSpringEnds(springs, bodies);
    EXPECT_EQ(bodies.asleep[a], 1);
}

}  // namespace
}  // namespace cairn
