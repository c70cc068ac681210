/// Bodies that lie still while they are awake are held, and let go as soon as something happens to them.
#include <gtest/gtest.h>

#include <cmath>

#include "cairn/world.h"

namespace cairn {
namespace {

/// Boxes of 0.1 m on top of each other, which never sleep.
struct Tower {
    explicit Tower(int boxes, double rest_speed = Settings::preset(Preset::performance).resolution.rest_speed)
        : world(awake(rest_speed)) {
        oak = world.addMaterial({"oak", 800});
        world.setDefaultPairProperties({.restitution = 0, .static_friction = 0.5, .kinetic_friction = 0.5});
        world.setGravity(Vec3(0, 0, -10));
        world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true});
        for (int i = 0; i < boxes; ++i) {
            box.push_back(world.addBody({.shape = Box{Vec3::Constant(0.1)},
                                         .material = oak,
                                         .pose = {Vec3(0, 0, 0.05 + 0.1 * i), Quat::Identity()}}));
        }
    }

    static Settings awake(double rest_speed) {
        Settings settings = Settings::preset(Preset::performance);
        settings.sleep.sleeping = false;
        settings.resolution.rest_speed = rest_speed;
        return settings;
    }

    void step(int steps) {
        for (int i = 0; i < steps; ++i) world.step();
    }
    double height(std::size_t i) const { return world.pose(box[i]).position.z(); }

    World world;
    MaterialId oak{};
    std::vector<BodyId> box;
};

TEST(Rest, ATowerComesToRestAwakeAndCostsNoResolution) {
    Tower tower(10);
    tower.step(480);
    EXPECT_EQ(tower.world.statistics().asleep, 0);
    EXPECT_EQ(tower.world.statistics().global_iterations, 0);
    const Vec3 top = tower.world.pose(tower.box[9]).position;
    tower.step(240);
    EXPECT_EQ(tower.world.pose(tower.box[9]).position, top);
    double pushed = 0;
    for (const ContactInfo& contact : tower.world.contacts()) {
        if (contact.a == tower.box[0] || contact.b == tower.box[0]) pushed += std::abs(contact.impulse.z());
    }
    // The contacts go on with their impulses: ten boxes on the floor, nine on the lowest, with damped gravity.
    const double weight = 0.8 * 10 / 240.0 * 0.3;
    EXPECT_NEAR(pushed, 19 * weight, 0.02 * 19 * weight);
}

TEST(Rest, IsOffWithARestSpeedOf0) {
    Tower tower(10, 0);
    tower.step(480);
    EXPECT_GT(tower.world.statistics().global_iterations, 0);
}

TEST(Rest, APushEndsIt) {
    Tower tower(3);
    tower.step(480);
    tower.world.applyImpulse(tower.box[2], Vec3(0, 0, 0.8));
    tower.step(1);
    EXPECT_NEAR(tower.world.linearVelocity(tower.box[2]).z(), 1, 0.05);
}

TEST(Rest, EndsWhereTheSupportGoes) {
    Tower tower(3);
    tower.step(480);
    tower.world.removeBody(tower.box[0]);
    tower.step(120);
    EXPECT_NEAR(tower.height(1), 0.05, 2e-3);
    EXPECT_NEAR(tower.height(2), 0.15, 2e-3);
}

TEST(Rest, AnImpactGoesThroughWhatRests) {
    Tower rests(3);
    Tower awake(3, 0);
    for (Tower* tower : {&rests, &awake}) {
        tower->step(480);
        tower->world.setLinearVelocity(tower->box[2], Vec3(0.8, 0, 0));
        tower->step(24);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 difference = rests.world.pose(rests.box[i]).position - awake.world.pose(awake.box[i]).position;
        EXPECT_LT(difference.norm(), 1e-3) << "box " << i;
    }
    EXPECT_GT(rests.world.pose(rests.box[2]).position.x(), 0.01) << "it slid";
}

/// How far a box gets down a slope in two seconds, from rest [m].
double slide(double slope, double rest_speed) {
    Tower tower(1, rest_speed);
    tower.world.setGravity(10 * Vec3(std::sin(slope), 0, -std::cos(slope)));
    tower.step(480);
    return tower.world.pose(tower.box[0]).position.x();
}

TEST(Rest, WhatSlidesDownASteepSlopeDoesNot) {
    // Half a degree beyond the friction angle of 26.57°.
    const double slope = 27.07 * M_PI / 180;
    EXPECT_GT(slide(slope, 41.7e-6), 0.05);
    EXPECT_EQ(slide(slope, 41.7e-6), slide(slope, 0));
}

TEST(Rest, BodiesOnAFixedBodyThatMovesGoWithIt) {
    Tower tower(1);
    World& world = tower.world;
    const BodyId plate = world.addBody({.shape = Box{Vec3(1, 1, 0.1)},
                                        .material = tower.oak,
                                        .pose = {Vec3(3, 0, 0.05), Quat::Identity()},
                                        .fixed = true});
    const BodyId load = world.addBody(
        {.shape = Box{Vec3::Constant(0.1)}, .material = tower.oak, .pose = {Vec3(3, 0, 0.15), Quat::Identity()}});
    tower.step(480);
    EXPECT_EQ(world.statistics().global_iterations, 0);
    for (int i = 1; i <= 100; ++i) {
        world.setPose(plate, {Vec3(3, 0, 0.05 - 1e-3 * i), Quat::Identity()});
        world.step();
    }
    EXPECT_LT(world.pose(load).position.z(), 0.1);
}

}  // namespace
}  // namespace cairn
