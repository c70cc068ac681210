/// Gravity as a function of time.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cairn/world.h"

namespace cairn {
namespace {

/// With all accounts; what sleeping and damping take would blur them.
Settings withAccounts() {
    Settings settings = Settings::preset(Preset::performance);
    settings.diagnostics.diagnostics = true;
    settings.sleep.sleeping = false;
    settings.sleep.damping = 0;
    return settings;
}

/// A world with a floor at z = 0.
struct WeighedWorld {
    World world;
    MaterialId stone;

    explicit WeighedWorld(const Settings& settings = withAccounts()) : world(settings) {
        stone = world.addMaterial({"stone", 1000});
        world.setChecks(Checks::on);
        world.setDefaultPairProperties({.restitution = 0, .static_friction = 0.8, .kinetic_friction = 0.8});
        world.setGravity({0, 0, -10});
        world.addBody({.shape = HalfSpace{}, .material = stone, .fixed = true});
    }
    BodyId box(double height) {
        return world.addBody({.shape = Box{Vec3::Constant(0.2)}, .material = stone, .pose = Pose{Vec3(0, 0, height)}});
    }
    /// Steps, and requires that energy and momentum are accounted for. @return the work of laws [J]
    double run(double seconds) {
        double drives = 0;
        for (const double end = world.time() + seconds - 1e-9; world.time() < end;) {
            world.step();
            const Diagnostics& d = world.statistics().diagnostics;
            drives += d.energy_drives;
            EXPECT_LE(std::abs(d.energy_error), 1e-10 * (1 + std::abs(d.energy)));
            EXPECT_LE(d.momentum_error, 1e-9);
        }
        return drives;
    }
};

/// What falls for two seconds under a gravity that is a sine, and its speed: g·t + a·(1 − cos(ωt))/ω.
TEST(Gravity, GivesWhatTheIntegralOfItsLawIs) {
    WeighedWorld g;
    const BodyId box = g.box(100);
    const double omega = 2 * std::numbers::pi * 0.3;
    g.world.setGravity({0, 0, -10}, SineMotion{.amplitude = {1, 0, 4}, .frequency = 0.3});
    g.run(2);
    const double integral = (1 - std::cos(omega * g.world.time())) / omega;
    EXPECT_NEAR(g.world.linearVelocity(box).x(), integral, 1e-5);
    EXPECT_NEAR(g.world.linearVelocity(box).z(), 4 * integral - 10 * g.world.time(), 1e-4);
    ASSERT_TRUE(g.world.gravityLaw());
    g.world.setGravity({0, 0, -10});
    EXPECT_FALSE(g.world.gravityLaw());
    g.world.step();
    EXPECT_EQ(g.world.gravity(), Vec3(0, 0, -10));
}

/// The energy of the world changes with gravity, by what the account says (run() requires that of every step).
TEST(Gravity, ChangesDoWorkThatTheAccountNames) {
    WeighedWorld g;
    const BodyId box = g.box(0.1);
    g.run(0.5);
    const double energy = g.world.statistics().diagnostics.energy;
    g.world.setGravity({0, 0, -10}, TableMotion{{0, 1}, {Vec3(0, 0, 0), Vec3(0, 0, -30)}, {}});
    const double drives = g.run(1.5);
    EXPECT_EQ(g.world.gravity(), Vec3(0, 0, -40));
    const double height = g.world.pose(box).position.z();
    EXPECT_NEAR(drives, g.world.mass(box) * 30 * height, 1e-3 * drives);
    EXPECT_NEAR(g.world.statistics().diagnostics.energy, energy + drives, 1e-3 * drives);
}

TEST(Gravity, WakesWhileItChangesAndLetsSleepAfterwards) {
    WeighedWorld g(Settings::preset(Preset::performance));
    const BodyId box = g.box(0.1);
    g.run(2);
    ASSERT_TRUE(g.world.isAsleep(box));
    // It passes gravities that are too weak for the sleep threshold.
    const TableMotion there_and_back{{0, 1, 2}, {Vec3(0, 0, 0), Vec3(0, 0, 10), Vec3(0, 0, -5)}, {}};
    g.world.setGravity({0, 0, -10}, there_and_back);
    EXPECT_FALSE(g.world.isAsleep(box));
    g.run(1.9);
    EXPECT_FALSE(g.world.isAsleep(box));
    g.world.setSettings(g.world.settings());
    g.run(2);
    EXPECT_EQ(g.world.gravity(), Vec3(0, 0, -15));
    EXPECT_TRUE(g.world.isAsleep(box)) << "the table has ended";
    g.world.setGravity({0, 0, -10}, SineMotion{.amplitude = {0.001, 0, 0}});
    g.run(2);
    EXPECT_FALSE(g.world.isAsleep(box));
}

TEST(Gravity, RefusesWhatNoLawOfItIs) {
    WeighedWorld g(Settings::preset(Preset::performance));
    EXPECT_THROW(g.world.setGravity({0, 0, -10}, ConstantMotion{.spin = {0, 0, 1}}), InputError);
    EXPECT_THROW(g.world.setGravity({0, 0, -10}, SineMotion{.frequency = -1}), InputError);
    EXPECT_THROW(g.world.setGravity({0, 0, std::nan("")}, ConstantMotion{}), InputError);
    const TableMotion to_little{{0, 1}, {Vec3(0, 0, -10), Vec3(0, 0, -0.001)}, {}};
    EXPECT_THROW(g.world.setGravity({0, 0, -10}, to_little), InputError) << "where it stays nobody could fall";
    EXPECT_EQ(g.world.gravity(), Vec3(0, 0, -10));
    EXPECT_FALSE(g.world.gravityLaw());
}

}  // namespace
}  // namespace cairn
