/// A tower that sleeps is held and costs no resolution; one that may not sleep is computed in every step.
#include <gtest/gtest.h>

#include <cmath>

#include "cairn/world.h"

namespace cairn {
namespace {

/// Boxes of 0.1 m on top of each other.
struct HeldTower {
    explicit HeldTower(int boxes, const Settings& settings = Settings::preset(Preset::performance)) : world(settings) {
        oak = world.addMaterial({"oak", 800});
        world.setDefaultPairProperties({.restitution = 0, .static_friction = 0.5, .kinetic_friction = 0.5});
        world.setGravity(Vec3(0, 0, -10));
        world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true});
        for (int i = 0; i < boxes; ++i) {
            box.push_back(world.addBody({.shape = Box{Vec3::Constant(0.1)},
                                         .material = oak,
                                         .pose = {Vec3(0, 0, 0.05 + 0.1 * i), Quat::Identity()}}));
        }
        for (int i = 0; i < 480; ++i) world.step();
    }

    World world;
    MaterialId oak{};
    std::vector<BodyId> box;
};

TEST(Held, ATowerThatSleepsCostsNoResolution) {
    HeldTower tower(10);
    EXPECT_EQ(tower.world.statistics().asleep, 10);
    EXPECT_EQ(tower.world.statistics().global_iterations, 0);
    double pushed = 0;
    for (const ContactInfo& contact : tower.world.contacts()) {
        if (contact.a == tower.box[0] || contact.b == tower.box[0]) pushed += std::abs(contact.impulse.z());
    }
    // The contacts go on with their impulses: ten boxes on the floor, nine on the lowest, with damped gravity.
    const double weight = 0.8 * 10 / 240.0 * 0.3;
    EXPECT_NEAR(pushed, 19 * weight, 0.02 * 19 * weight);
}

TEST(Held, NothingIsHeldWhereNobodyMaySleep) {
    Settings settings = Settings::preset(Preset::performance);
    settings.sleep.sleeping = false;
    HeldTower tower(10, settings);
    EXPECT_EQ(tower.world.statistics().asleep, 0);
    EXPECT_GT(tower.world.statistics().global_iterations, 0);
    EXPECT_NEAR(tower.world.pose(tower.box[9]).position.z(), 0.95, 1e-3) << "it stands";
}

TEST(Held, AWeakImpactThatFollowsAnotherWakesNobody) {
    HeldTower tower(10);
    World& world = tower.world;
    const MaterialId cork = world.addMaterial({"cork", 8});
    // The lower ball is struck down and strikes the tower within the same step, whose surroundings are resolved again:
    // the boxes farther down hold those at the edge of them all the same.
    const auto addBall = [&](double z, double speed) {
        world.addBody({.shape = Sphere{0.02},
                       .material = cork,
                       .pose = {Vec3(0, 0, z), Quat::Identity()},
                       .linear_velocity = Vec3(0, 0, -speed)});
    };
    addBall(1.025, 0);
    addBall(1.2, 9);
    for (int i = 0; i < 10; ++i) {
        world.step();
        ASSERT_EQ(world.statistics().woken, 0) << i;
        ASSERT_EQ(world.statistics().asleep, 10) << i;
    }
}

TEST(Held, ASleeperOnAFixedBodyThatMovesGoesWithIt) {
    HeldTower tower(1);
    World& world = tower.world;
    const BodyId plate = world.addBody({.shape = Box{Vec3(1, 1, 0.1)},
                                        .material = tower.oak,
                                        .pose = {Vec3(3, 0, 0.05), Quat::Identity()},
                                        .fixed = true});
    const BodyId load = world.addBody(
        {.shape = Box{Vec3::Constant(0.1)}, .material = tower.oak, .pose = {Vec3(3, 0, 0.15), Quat::Identity()}});
    for (int i = 0; i < 480; ++i) world.step();
    EXPECT_TRUE(world.isAsleep(load));
    for (int i = 1; i <= 100; ++i) {
        world.setPose(plate, {Vec3(3, 0, 0.05 - 1e-3 * i), Quat::Identity()});
        world.step();
    }
    EXPECT_LT(world.pose(load).position.z(), 0.1);
}

}  // namespace
}  // namespace cairn
