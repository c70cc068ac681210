/// Steps that are divided where what touches moves far.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "cairn/world.h"

namespace cairn {
namespace {

constexpr double rate = 60;
constexpr double g = 10;

Settings dividing(std::int64_t most_parts) {
    Settings settings = Settings::preset(Preset::performance, rate);
    settings.sleep.sleeping = false;
    settings.sleep.damping = 0;
    settings.integration.most_parts = most_parts;
    return settings;
}

BodyDescription boxAt(const Vec3& extents, const Vec3& position) {
    BodyDescription d;
    d.shape = Box{extents};
    d.pose.position = position;
    return d;
}

/// The ground, and far away from its middle a top: a box that spins on it without friction, so fast that steps are
/// divided.
struct Hall {
    World world;
    MaterialId stone, ice;

    explicit Hall(std::int64_t most_parts = 8) : world(dividing(most_parts)) {
        stone = world.addMaterial({"stone", 2500});
        ice = world.addMaterial({"ice", 900});
        world.setGravity(Vec3(0, 0, -g));
        world.setDefaultPairProperties({.restitution = 0, .static_friction = 0.5, .kinetic_friction = 0.5});
        world.setPairProperties(ice, stone, {.restitution = 0, .static_friction = 0, .kinetic_friction = 0});
        BodyDescription ground;
        ground.shape = HalfSpace{};
        ground.fixed = true;
        world.addBody(ground);
        BodyDescription top = boxAt(Vec3(0.1, 0.1, 0.1), Vec3(50, 0, 0.05));
        top.material = ice;
        top.angular_velocity = Vec3(0, 0, 200);
        world.addBody(top);
    }
};

TEST(DividedSteps, WhatSpinsWhereItTouchesDividesThem) {
    Hall whole(1);
    Hall divided(8);
    whole.world.step();
    divided.world.step();
    EXPECT_NE(whole.world.stateHash(), divided.world.stateHash());
}

TEST(DividedSteps, WhatMovesLittleIsComputedInWholeOnes) {
    const auto run = [](std::int64_t most_parts) {
        World world(dividing(most_parts));
        world.addMaterial({"stone", 2500});
        world.setGravity(Vec3(0, 0, -g));
        BodyDescription ground;
        ground.shape = HalfSpace{};
        ground.fixed = true;
        world.addBody(ground);
        for (int i = 0; i < 5; ++i) world.addBody(boxAt(Vec3(0.1, 0.1, 0.1), Vec3(0, 0, 0.05 + 0.1 * i)));
        for (int i = 0; i < 60; ++i) world.step();
        return world.stateHash();
    };
    EXPECT_EQ(run(1), run(64));
}

TEST(DividedSteps, FreeBodiesKeepToTheParabolaAndFeelForcesForOneStep) {
    Hall hall;
    BodyDescription ball;
    ball.shape = Sphere{0.1};
    ball.pose.position = Vec3(0, 0, 100);
    ball.linear_velocity = Vec3(1, 0, 0);
    const BodyId id = hall.world.addBody(ball);
    const double mass = hall.world.mass(id);
    hall.world.applyForce(id, Vec3(0, mass * rate, 0));
    for (int i = 0; i < 60; ++i) hall.world.step();
    const Vec3 v = hall.world.linearVelocity(id);
    EXPECT_NEAR(v.x(), 1, 1e-12);
    EXPECT_NEAR(v.y(), 1, 1e-12);
    EXPECT_NEAR(v.z(), -g, 1e-11);
    EXPECT_NEAR(hall.world.pose(id).position.z(), 100 - g / 2, 1e-9);
}

TEST(DividedSteps, ContactsReportWhatTheyGaveInTheWholeStep) {
    Hall hall;
    const BodyId box = hall.world.addBody(boxAt(Vec3(0.1, 0.1, 0.1), Vec3(0, 0, 0.05)));
    const double weight = hall.world.mass(box) * g;
    for (int i = 0; i < 20; ++i) {
        hall.world.step();
        Vec3 sum = Vec3::Zero();
        for (const ContactInfo& c : hall.world.contacts()) {
            if (c.a == box) sum += c.impulse;
            if (c.b == box) sum -= c.impulse;
        }
        if (i < 3) continue;
        EXPECT_NEAR(sum.z(), weight / rate, 1e-3 * weight / rate) << i;
    }
}

TEST(DividedSteps, JointsReportAndBreakByTheForceOfTheWholeStep) {
    for (const double strength : {0.9, 1.1}) {
        Hall hall;
        const BodyId box = hall.world.addBody(boxAt(Vec3(0.1, 0.1, 0.1), Vec3(0, 0, 2)));
        const double weight = hall.world.mass(box) * g;
        JointDescription joint;
        joint.kind = JointKind::fixed;
        joint.a = box;
        joint.anchor = Vec3(0, 0, 2);
        joint.break_force = strength * weight;
        const JointId id = hall.world.addJoint(joint);
        for (int i = 0; i < 30; ++i) hall.world.step();
        EXPECT_EQ(hall.world.contains(id), strength > 1);
        if (strength < 1) continue;
        EXPECT_NEAR(hall.world.joint(id).force.norm(), weight, 1e-6 * weight);
    }
}

TEST(DividedSteps, ALawLeadsItsBodyAndWhatItCarries) {
    Hall hall;
    BodyDescription floor = boxAt(Vec3(2, 2, 0.2), Vec3(0, 0, 3));
    floor.fixed = true;
    const BodyId lift = hall.world.addBody(floor);
    const BodyId box = hall.world.addBody(boxAt(Vec3(0.1, 0.1, 0.1), Vec3(0, 0, 3.15)));
    hall.world.setMotion(lift, ConstantMotion{Vec3(0.5, 0, 0.25), Vec3::Zero()});
    for (int i = 0; i < 60; ++i) hall.world.step();
    EXPECT_NEAR((hall.world.pose(lift).position - Vec3(0.5, 0, 3.25)).norm(), 0, 1e-12);
    EXPECT_NEAR(hall.world.pose(box).position.z(), 3.4, 0.002);
    EXPECT_NEAR(hall.world.linearVelocity(box).x(), 0.5, 0.01);
}

/// Thin plates that tumble down onto each other.
void addPlates(World& world) {
    for (int i = 0; i < 24; ++i) {
        BodyDescription plate = boxAt(Vec3(0.12, 0.1, 0.02), Vec3(0.05 * (i % 3), 0.04 * (i % 2), 0.3 + 0.15 * i));
        plate.linear_velocity = Vec3(0, 0, -8);
        plate.angular_velocity = Vec3(20.0 + i, 30.0 - i, 5);
        world.addBody(plate);
    }
}

TEST(DividedSteps, PlatesThatTumbleOverlapNoMoreThanTheyMay) {
    for (const std::int64_t most_parts : {1, 8}) {
        Hall hall(most_parts);
        addPlates(hall.world);
        for (int i = 0; i < 60; ++i) {
            hall.world.step();
            // 1.3 times what they are allowed: 1.45 % of the plates' thickness.
            ASSERT_LE(hall.world.statistics().largest_overlap / 0.02, 1.31 * 0.0145) << most_parts << ", step " << i;
        }
    }
}

TEST(DividedSteps, DiagnosticsAccountForAllParts) {
    Hall hall;
    addPlates(hall.world);
    Settings settings = hall.world.settings();
    settings.diagnostics.diagnostics = true;
    hall.world.setSettings(settings);
    hall.world.step();
    double energy = hall.world.statistics().diagnostics.energy;
    for (int i = 0; i < 30; ++i) {
        hall.world.step();
        const Diagnostics& d = hall.world.statistics().diagnostics;
        EXPECT_LT(d.momentum_error, 1e-9) << i;
        EXPECT_NEAR(d.energy_error, 0, 1e-6 * energy) << i;
        const double accounts = d.energy_flight + d.energy_forces + d.energy_damping + d.energy_friction +
                                d.energy_restitution + d.energy_joints + d.energy_correction + d.energy_drives +
                                d.energy_sleep + d.energy_error;
        EXPECT_NEAR(d.energy - energy, accounts, 1e-9 * energy) << i;
        energy = d.energy;
    }
}

TEST(DividedSteps, ThreadsAndSnapshotsChangeNoBit) {
    Hall hall;
    addPlates(hall.world);
    Hall threaded;
    addPlates(threaded.world);
    Settings settings = threaded.world.settings();
    settings.parallel = {3, true};
    threaded.world.setSettings(settings);
    for (int i = 0; i < 20; ++i) {
        hall.world.step();
        threaded.world.step();
        ASSERT_EQ(hall.world.stateHash(), threaded.world.stateHash()) << i;
    }
    World read = World::restore(hall.world.save());
    for (int i = 0; i < 20; ++i) {
        hall.world.step();
        read.step();
        ASSERT_EQ(hall.world.stateHash(), read.stateHash()) << i;
    }
}

}  // namespace
}  // namespace cairn
