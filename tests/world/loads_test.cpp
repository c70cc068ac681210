/// What other forces than gravity act on, and what moves evenly, feels all of its weight, however slow it is.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cairn/world.h"

namespace cairn {
namespace {

constexpr double gravity = 10;
constexpr double friction = 0.5;

/// A floor and boxes of 8 kg on it.
struct PushedBoxes {
    World world;
    MaterialId stone;

    explicit PushedBoxes(Preset preset = Preset::performance) : world(Settings::preset(preset)) {
        stone = world.addMaterial({"stone", 1000});
        world.setDefaultPairProperties({.restitution = 0, .static_friction = friction, .kinetic_friction = friction});
        world.setGravity({0, 0, -gravity});
        world.addBody({.shape = HalfSpace{}, .material = stone, .fixed = true});
    }
    BodyId box(const Vec3& at) {
        return world.addBody({.shape = Box{Vec3::Constant(0.2)}, .material = stone, .pose = Pose{at}});
    }
    void run(int steps) {
        for (int i = 0; i < steps; ++i) world.step();
    }
    /// What the floor pushes a body up with, as a multiple of its weight in a step.
    double borne(BodyId body) const {
        double impulse = 0;
        for (const ContactInfo& contact : world.contacts()) {
            if (contact.a == body || contact.b == body) impulse += std::abs(contact.impulse.z());
        }
        return impulse / (8 * gravity * world.settings().timeStep());
    }
};

TEST(Loads, FrictionHoldsAForceThatAllOfTheWeightHolds) {
    PushedBoxes floor;
    const BodyId pushed = floor.box({0, 0, 0.1});
    const BodyId other = floor.box({2, 0, 0.1});
    floor.world.setConstantForce(pushed, {0.8 * friction * 8 * gravity, 0, 0});
    floor.run(1);
    EXPECT_NEAR(floor.borne(pushed), 1, 0.01) << "from the first step on";
    floor.run(240);
    EXPECT_NEAR(floor.world.pose(pushed).position.x(), 0, 1e-4);
    EXPECT_NEAR(floor.borne(pushed), 1, 0.01);
    EXPECT_NEAR(floor.borne(other), 1 - floor.world.settings().sleep.damping, 0.01);
}

TEST(Loads, AForceOfOneStepCounts) {
    PushedBoxes floor;
    const BodyId pushed = floor.box({0, 0, 0.1});
    floor.run(240);
    for (int i = 0; i < 240; ++i) {
        floor.world.applyForce(pushed, {0.8 * friction * 8 * gravity, 0, 0});
        floor.run(1);
    }
    EXPECT_NEAR(floor.world.pose(pushed).position.x(), 0, 1e-4);
}

TEST(Loads, WhatStandsOnAPushedBodyPressesWithAllOfIts) {
    PushedBoxes floor;
    const BodyId pushed = floor.box({0, 0, 0.1});
    floor.box({0, 0, 0.3});
    floor.world.setConstantForce(pushed, {0.8 * friction * 16 * gravity, 0, 0});
    floor.run(240);
    EXPECT_NEAR(floor.world.pose(pushed).position.x(), 0, 1e-4);
}

TEST(Loads, ThePresetsOfTheThesisDampAlways) {
    PushedBoxes floor(Preset::thesis);
    const BodyId pushed = floor.box({0, 0, 0.1});
    floor.world.setConstantForce(pushed, {0.8 * friction * 8 * gravity, 0, 0});
    floor.run(1);
    // The queue gives the corners one after the other a little more than they need.
    EXPECT_NEAR(floor.borne(pushed), 1 - floor.world.settings().sleep.damping, 0.05);
}

/// Rolling friction of 1 mm slows a ball of 0.1 m down by 5/7 of gravity's hundredth.
TEST(Loads, ABallRollsAsFarAsRollingFrictionLets) {
    PushedBoxes floor;
    floor.world.setDefaultPairProperties({.restitution = 0,
                                          .static_friction = friction,
                                          .kinetic_friction = friction,
                                          .rolling_friction = 1e-3,
                                          .spinning_friction = 1e-3});
    constexpr double speed = 0.08;
    const BodyId ball = floor.world.addBody({.shape = Sphere{0.1},
                                             .material = floor.stone,
                                             .pose = Pose{Vec3(0, 0, 0.1)},
                                             .linear_velocity = Vec3(speed, 0, 0),
                                             .angular_velocity = Vec3(0, speed / 0.1, 0)});
    for (int i = 0; i < 2400 && !floor.world.isAsleep(ball); ++i) floor.run(1);
    const double deceleration = gravity * 1e-3 / 0.1 / 1.4;
    const double way = speed * speed / (2 * deceleration);
    EXPECT_NEAR(floor.world.pose(ball).position.x(), way, 0.03 * way);
    EXPECT_LT(floor.world.time(), 1.2 * speed / deceleration) << "and sleeps then";
}

/// With a part of its weight taken it would hang in the air.
TEST(Loads, WhatIsLiftedByLessThanItsWeightFalls) {
    PushedBoxes floor;
    const BodyId lifted = floor.box({0, 0, 10});
    floor.world.setConstantForce(lifted, {0, 0, 0.4 * 8 * gravity});
    floor.run(240);
    EXPECT_NEAR(floor.world.linearVelocity(lifted).z(), -0.6 * gravity, 1e-9);
}

/// It sinks more slowly than what damping takes hold of; a step adds what gravity gives, then drag takes its part.
TEST(Loads, WhatSinksSlowlySinksAsFastAsItsDragLets) {
    PushedBoxes floor;
    const BodyId sinking = floor.box({0, 0, 1});
    floor.world.setDamping(sinking, 200, 0);
    floor.run(240);
    const double step = floor.world.settings().timeStep();
    EXPECT_NEAR(floor.world.linearVelocity(sinking).z(), -gravity * step / std::expm1(200 * step), 1e-9);
}

TEST(Loads, ASpringCarriesAll) {
    PushedBoxes floor;
    const BodyId hung = floor.box({0, 0, 1});
    constexpr double stiffness = 8e4;
    floor.world.addSpring(
        {.a = hung, .anchor_b = Vec3(0, 0, 2), .stiffness = stiffness, .damping = 800, .rest_length = 1});
    floor.run(960);
    EXPECT_NEAR(floor.world.pose(hung).position.z(), 1 - 8 * gravity / stiffness, 2e-5);
}

TEST(Loads, AServoBearsAll) {
    PushedBoxes floor;
    const BodyId lifted = floor.box({0, 0, 1});
    constexpr double stiffness = 8e4;
    JointDescription slide{.kind = JointKind::slider, .a = lifted, .anchor = Vec3(0, 0, 1), .axis = Vec3::UnitZ()};
    slide.servo = JointServo{.position = 0, .stiffness = stiffness, .damping = 800};
    floor.world.addJoint(slide);
    floor.run(960);
    EXPECT_NEAR(floor.world.pose(lifted).position.z(), 1 - 8 * gravity / stiffness, 2e-5);
}

/// A table that speeds up slower than all of the weight's friction allows takes along what stands on it.
TEST(Loads, AMovingTableTakesAlongWhatFrictionHolds) {
    PushedBoxes floor;
    const BodyId table = floor.world.addBody(
        {.shape = Box{{8, 4, 0.2}}, .material = floor.stone, .pose = Pose{Vec3(0, 9, 0.9)}, .fixed = true});
    const BodyId load = floor.box({0, 9, 1.1});
    constexpr double acceleration = 0.8 * friction * gravity;
    const std::vector<Vec3> even(3, Vec3(acceleration, 0, 0));
    floor.world.setMotion(table, integrateAccelerogram(1, even, Baseline::none));
    floor.run(240);
    EXPECT_NEAR(floor.world.pose(table).position.x(), acceleration / 2, 1e-2);
    EXPECT_NEAR(floor.world.pose(load).position.x(), floor.world.pose(table).position.x(), 1e-3);
}

}  // namespace
}  // namespace cairn
