/// Bodies and frames that move by a law.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cairn/world.h"

namespace cairn {
namespace {

Settings measured() {
    Settings settings = Settings::preset(Preset::performance);
    settings.diagnostics.diagnostics = true;
    // What holding and sleeping take stands on no account, and damping depends on the frame.
    settings.sleep.sleeping = false;
    settings.sleep.damping = 0;
    return settings;
}

/// A table whose top is z = 0, and what stands on it.
struct MovedTable {
    World world;
    MaterialId stone;
    BodyId table;

    explicit MovedTable(const Settings& settings = measured()) : world(settings) {
        stone = world.addMaterial({"stone", 1000});
        world.setDefaultPairProperties({.restitution = 0, .static_friction = 0.8, .kinetic_friction = 0.8});
        world.setGravity({0, 0, -10});
        table =
            world.addBody({.shape = Box{{4, 4, 1}}, .material = stone, .pose = Pose{Vec3(0, 0, -0.5)}, .fixed = true});
    }
    BodyId box(const Vec3& at, double size = 0.2) {
        return world.addBody({.shape = Box{Vec3::Constant(size)}, .material = stone, .pose = Pose{at}});
    }
    /// Steps, and requires that momentum and energy are accounted for.
    void run(double seconds) {
        const double end = world.time() + seconds - 1e-9;
        while (world.time() < end) {
            world.step();
            const Diagnostics& d = world.statistics().diagnostics;
            drives += d.energy_drives;
            if (!world.settings().diagnostics.diagnostics) continue;
            ASSERT_LT(std::abs(d.energy_error), 1e-10 * (1 + std::abs(d.energy)));
            ASSERT_LT(d.momentum_error, 1e-9);
        }
    }
    double drives = 0;
};

TEST(Motion, ConstantVelocityCarriesWhatSticks) {
    MovedTable t;
    const BodyId box = t.box({0, 0, 0.1});
    t.run(0.2);
    const double x = t.world.pose(box).position.x();
    t.world.setMotion(t.table, ConstantMotion{.velocity = {0.5, 0, 0}});
    t.run(2);
    EXPECT_NEAR(t.world.pose(t.table).position.x(), 1, 1e-12);
    EXPECT_NEAR(t.world.linearVelocity(box).x(), 0.5, 1e-6);
    // It slid until friction had brought it to the speed: v²/(2µg).
    EXPECT_NEAR(x + 1 - t.world.pose(box).position.x(), 0.25 / 16, 4e-3);
    EXPECT_FALSE(t.world.isAsleep(box));
    t.world.stopMotion(t.table);
    EXPECT_EQ(t.world.linearVelocity(t.table), Vec3(0, 0, 0));
    t.run(1);
    EXPECT_NEAR(t.world.linearVelocity(box).x(), 0, 1e-6);
    EXPECT_NEAR(t.world.pose(t.table).position.x(), 1, 1e-12);
}

TEST(Motion, SpinTurnsAboutThePivot) {
    MovedTable t;
    t.world.setMotion(t.table, ConstantMotion{.spin = {0, 0, 0.5}}, Vec3(1, 0, 0));
    t.run(1);
    const Pose pose = t.world.pose(t.table);
    const Quat turn(Eigen::AngleAxisd(0.5, Vec3::UnitZ()));
    EXPECT_LT((pose.toOuter(Vec3(1, 0, 0)) - Vec3(1, 0, -0.5)).norm(), 1e-12);
    EXPECT_LT(pose.orientation.angularDistance(turn), 1e-12);
    EXPECT_LT((t.world.angularVelocity(t.table) - Vec3(0, 0, 0.5)).norm(), 1e-9);
}

TEST(Motion, SineFollowsItsFormula) {
    MovedTable t;
    const SineMotion law{.amplitude = {0.03, 0, 0.01}, .turn = {0, 0.02, 0}, .frequency = 2, .phase = 0.4};
    t.world.setMotion(t.table, law);
    t.run(0.7);
    const double swing = std::sin(2 * std::numbers::pi * 2 * t.world.time() + 0.4) - std::sin(0.4);
    EXPECT_LT((t.world.pose(t.table).position - Vec3(0.03 * swing, 0, -0.5 + 0.01 * swing)).norm(), 1e-12);
    EXPECT_NEAR(t.world.pose(t.table).orientation.y(), std::sin(0.01 * swing), 1e-12);
}

TEST(Motion, TablesGoThroughTheirEntriesWithoutJumpsOfVelocity) {
    MovedTable t;
    TableMotion law;
    law.times = {0, 0.1, 0.25, 0.5, 0.6};
    for (const double x : {5.0, 5.1, 5.05, 5.3, 5.3}) law.displacements.emplace_back(x, 0, 0);
    t.world.setMotion(t.table, law);
    double last_speed = 0;
    for (int i = 0; i < 200; ++i) {
        t.world.step();
        const double speed = t.world.linearVelocity(t.table).x();
        EXPECT_LT(std::abs(speed - last_speed), 200 * t.world.settings().timeStep());
        last_speed = speed;
        for (std::size_t k = 0; k < law.times.size(); ++k) {
            if (std::abs(t.world.time() - law.times[k]) > 1e-9) continue;
            EXPECT_NEAR(t.world.pose(t.table).position.x(), law.displacements[k].x() - 5, 1e-12);
        }
    }
    EXPECT_EQ(last_speed, 0) << "it holds its end";
    law.displacements.back() = law.displacements.front();
    law.end = TableEnd::repeat;
    t.world.setPose(t.box({0, 0, 3}), Pose{});
    t.world.setMotion(t.table, law);
    const double x = t.world.pose(t.table).position.x();
    const auto steps = static_cast<int>(std::lround(1.2 / t.world.settings().timeStep()));
    for (int i = 0; i < steps; ++i) t.world.step();
    EXPECT_NEAR(t.world.pose(t.table).position.x(), x, 1e-9) << "after two rounds";
}

TEST(Motion, WorkOfAShakeTableClosesTheEnergyAccount) {
    MovedTable t;
    for (int i = 0; i < 4; ++i) t.box({0.02 * i, 0.01 * i, 0.1 + 0.2 * i});
    t.world.setMotion(t.table, SineMotion{.amplitude = {0.05, 0, 0}, .frequency = 2});
    t.run(2);
    EXPECT_GT(std::abs(t.drives), 1) << "[J]";
}

/// Pushes a box up against gravity: the work is m·g·h.
TEST(Motion, APistonLiftsWithItsWork) {
    MovedTable t;
    const BodyId box = t.box({0, 0, 0.1}, 0.2);
    t.run(0.5);
    t.drives = 0;
    t.world.setMotion(t.table, ConstantMotion{.velocity = {0, 0, 0.3}});
    t.run(2);
    const double mass = t.world.mass(box);
    EXPECT_NEAR(t.world.pose(box).position.z(), 0.7, 2e-3);
    EXPECT_NEAR(t.drives, mass * (10 * 0.6 + 0.5 * 0.3 * 0.3), 0.05 * mass);
}

TEST(Motion, SleepersWakeWhenTheirGroundMoves) {
    Settings settings = Settings::preset(Preset::performance);
    settings.resolution.tolerance = 0.01;
    MovedTable t(settings);
    const BodyId lower = t.box({0, 0, 0.1});
    const BodyId upper = t.box({0, 0, 0.3});
    t.run(2);
    ASSERT_TRUE(t.world.isAsleep(lower) && t.world.isAsleep(upper));
    t.world.setMotion(t.table, ConstantMotion{.velocity = {1e-4, 0, 0}});
    t.run(1);
    EXPECT_FALSE(t.world.isAsleep(upper));
    EXPECT_NEAR(t.world.pose(upper).position.x(), 1e-4, 2e-6) << "slower than what sleeping stops";
}

/// The same motion, told in the frame of the ground and in that of the world.
TEST(Motion, BaseExcitationAgreesWithInertialForces) {
    const SineMotion law{.amplitude = {0.02, 0.01, 0}, .frequency = 3, .phase = std::numbers::pi / 2};
    Settings settings = measured();
    settings.resolution.resolution_threshold = 1e-13;
    settings.resolution.iterations = 1000;
    settings.resolution.tolerance = 0;
    MovedTable shaken(settings);
    MovedTable inertial(settings);
    std::vector<BodyId> ids;
    for (MovedTable* t : {&shaken, &inertial}) {
        ids.clear();
        for (int i = 0; i < 3; ++i) ids.push_back(t->box({0.5 * i, 0, 0.1}, 0.2));
    }
    shaken.world.setMotion(shaken.table, law);
    inertial.world.setFrameMotion(law);
    // At rest in the frame: on the shaken table that is its velocity up to the first step.
    const double dt = settings.timeStep();
    const double swing = std::sin(2 * std::numbers::pi * 3 * dt + law.phase) - std::sin(law.phase);
    for (const BodyId id : ids) shaken.world.setLinearVelocity(id, law.amplitude * swing / dt);
    double farthest = 0;
    for (int i = 0; i < 240; ++i) {
        shaken.world.step();
        inertial.world.step();
        const Vec3 ground = shaken.world.pose(shaken.table).position - inertial.world.pose(inertial.table).position;
        farthest = std::max(farthest, ground.norm());
        for (const BodyId id : ids) {
            const Vec3 seen = shaken.world.pose(id).position - ground;
            ASSERT_LT((seen - inertial.world.pose(id).position).norm(), 1e-9) << "step " << i;
        }
    }
    EXPECT_GT(farthest, 0.03);
}

TEST(Motion, FramesDoWorkThatTheAccountNames) {
    MovedTable t;
    t.box({0, 0, 0.1});
    t.world.setFrameMotion(SineMotion{.amplitude = {0.2, 0, 0}, .frequency = 1.5});
    ASSERT_TRUE(t.world.frameMotion());
    t.run(1);
    EXPECT_GT(std::abs(t.drives), 0.1);
    t.world.setFrameMotion(std::nullopt);
    EXPECT_FALSE(t.world.frameMotion());
    t.drives = 0;
    t.run(0.5);
    EXPECT_EQ(t.drives, 0);
}

TEST(Motion, GoesOnFromSnapshotsAndMoments) {
    MovedTable t;
    for (int i = 0; i < 3; ++i) t.box({0.02 * i, 0, 0.1 + 0.2 * i});
    t.world.setMotion(t.table, SineMotion{.amplitude = {0.03, 0, 0}, .turn = {0, 0, 0.1}, .frequency = 2},
                      Vec3(1, 0, 0));
    TableMotion frame;
    frame.times = {0, 1, 2};
    frame.displacements = {Vec3(0, 0, 0), Vec3(0, 0.1, 0), Vec3(0, 0, 0)};
    t.world.setFrameMotion(frame);
    t.world.setGravity({0, 0, -10}, SineMotion{.amplitude = {1, 0, 3}, .frequency = 0.7});
    t.run(0.3);
    RollbackState moment;
    t.world.keep(moment);
    World restored = World::restore(t.world.save());
    World other;
    other.load(moment);
    for (int i = 0; i < 100; ++i) {
        t.world.step();
        restored.step();
        other.step();
    }
    EXPECT_EQ(restored.stateHash(), t.world.stateHash());
    EXPECT_EQ(other.stateHash(), t.world.stateHash());
    EXPECT_EQ(restored.save(), t.world.save());
}

TEST(Motion, RefusesWhatNoLawIs) {
    MovedTable t;
    const double nan = std::nan("");
    const BodyId box = t.box({0, 0, 0.1});
    EXPECT_THROW(t.world.setMotion(box, ConstantMotion{}), InputError) << "dynamic";
    EXPECT_THROW(t.world.setMotion(t.table, ConstantMotion{.velocity = {nan, 0, 0}}), InputError);
    EXPECT_THROW(t.world.setMotion(t.table, SineMotion{.frequency = 0}), InputError);
    EXPECT_THROW(t.world.setMotion(t.table, ConstantMotion{}, Vec3(nan, 0, 0)), InputError);
    TableMotion table;
    EXPECT_THROW(t.world.setMotion(t.table, table), InputError);
    table.times = {0, 1};
    EXPECT_THROW(t.world.setMotion(t.table, table), InputError) << "no column";
    table.displacements = {Vec3::Zero()};
    EXPECT_THROW(t.world.setMotion(t.table, table), InputError) << "too few";
    table.displacements = {Vec3::Zero(), Vec3::Ones()};
    table.end = TableEnd::repeat;
    EXPECT_THROW(t.world.setMotion(t.table, table), InputError) << "it would jump";
    table.end = TableEnd::hold;
    table.times = {1, 1};
    EXPECT_THROW(t.world.setMotion(t.table, table), InputError) << "times do not ascend";
    table.times = {0, 1e-300, 1};
    table.displacements = {Vec3::Zero(), Vec3::Ones(), Vec3::Zero()};
    try {
        t.world.setMotion(t.table, table);
        FAIL() << "its curve overshoots without bounds";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("farther apart than 1e-300 s"), std::string::npos) << error.what();
    }
    table.times[1] = 1e-3;
    t.world.setMotion(t.table, table);
    EXPECT_THROW(t.world.setFrameMotion(ConstantMotion{.spin = {0, 0, 1}}), InputError);
    t.world.setMotion(t.table, ConstantMotion{});
    EXPECT_TRUE(t.world.motion(t.table));
    EXPECT_THROW(t.world.setPose(t.table, Pose{}), InputError);
    EXPECT_THROW(t.world.setFixed(t.table, false), InputError);
    EXPECT_THROW(t.world.addJoint({.kind = JointKind::ball, .a = box, .b = t.table}), InputError);
    t.world.addJoint({.kind = JointKind::ball, .a = box});
    t.world.removeBody(t.table);
    t.world.step();
}

TEST(Motion, AWallPressesWithTheForceOfItsMotor) {
    MovedTable t;
    const BodyId box = t.box({0, 0, 0.1});
    const BodyId wall = t.world.addBody({.shape = Box{{1, 1, 0.1}},
                                         .material = t.stone,
                                         .mass = 5.0,
                                         .pose = Pose{Vec3(0, 0, 0.5)},
                                         .gravity_factor = 0});
    t.world.addJoint({.kind = JointKind::slider,
                      .a = wall,
                      .anchor = {0, 0, 0.5},
                      .axis = Vec3::UnitZ(),
                      .motor = JointMotor{.speed = -0.5, .limit = 200}});
    t.run(0.2);
    EXPECT_NEAR(t.world.linearVelocity(wall).z(), -0.5, 1e-6) << "no faster than its speed";
    t.run(1.5);
    double pressing = 0;
    double bearing = 0;
    for (const ContactInfo& contact : t.world.contacts()) {
        double& sum = contact.a == t.table || contact.b == t.table ? bearing : pressing;
        sum += std::abs(contact.impulse.z()) / t.world.settings().timeStep();
    }
    EXPECT_NEAR(pressing, 200, 0.5);
    EXPECT_NEAR(bearing, 200 + 10 * t.world.mass(box), 0.5);
}

/// A heap on a shaken table with a belt and a sensor. @return the hash of every step, and whom the sensor held
std::pair<std::vector<std::uint64_t>, std::vector<Sensed>> shakenHeap(std::int64_t threads) {
    Settings settings = Settings::preset(Preset::performance);
    settings.parallel = {threads, true};
    MovedTable t(settings);
    t.world.addBody({.shape = Box{{1, 4, 0.2}},
                     .material = t.stone,
                     .pose = Pose{Vec3(1, 0, 0.1)},
                     .fixed = true,
                     .surface_velocity = {0, 1, 0}});
    t.world.addBody(
        {.shape = Box{{2, 2, 1}}, .material = t.stone, .pose = Pose{Vec3(0, 0, 1)}, .fixed = true, .sensor = true});
    const GroupId light = t.world.addGroup("light");
    t.world.setGroupsTouch(light, light, Touch::never);
    for (int i = 0; i < 400; ++i) {
        const BodyId id = t.box({0.3 * (i % 8) - 1, 0.3 * (i / 8 % 8) - 1, 0.5 + 0.3 * (i / 64)});
        if (i % 5 == 0) t.world.setGroups(id, std::span(&light, 1));
        t.world.setGravityFactor(id, 0.5 + 0.1 * (i % 10));
        t.world.setDamping(id, 0.1 * (i % 3), 0.5);
    }
    t.world.setMotion(t.table, SineMotion{.amplitude = {0.05, 0, 0}, .turn = {0, 0, 0.05}, .frequency = 3});
    t.world.setFrameMotion(SineMotion{.amplitude = {0, 0.01, 0}, .frequency = 5});
    std::vector<std::uint64_t> hashes;
    std::vector<Sensed> sensed;
    for (int i = 0; i < 120; ++i) {
        t.world.step();
        hashes.push_back(t.world.stateHash());
        sensed.insert(sensed.end(), t.world.sensed().begin(), t.world.sensed().end());
    }
    return {hashes, sensed};
}

TEST(Motion, IsTheSameOnAnyNumberOfThreads) {
    const auto alone = shakenHeap(1);
    EXPECT_GT(alone.second.size(), 1000U);
    EXPECT_EQ(shakenHeap(2), alone);
    EXPECT_EQ(shakenHeap(5), alone);
}

TEST(Accelerogram, StraightLinesAreIntegratedExactly) {
    std::vector<Vec3> samples;
    for (int i = 0; i <= 100; ++i) samples.emplace_back(2 - 0.03 * i, 1, 0);  // a = 2 − 3t, 1
    const TableMotion motion = integrateAccelerogram(0.01, samples, Baseline::none);
    EXPECT_NEAR(motion.velocities.back().x(), 2 - 1.5, 1e-13);
    EXPECT_NEAR(motion.displacements.back().x(), 1 - 0.5, 1e-13);
    EXPECT_NEAR(motion.displacements.back().y(), 0.5, 1e-13);
}

TEST(Accelerogram, TheBaselineTakesDriftAndLeavesTheRest) {
    std::vector<Vec3> samples;
    for (int i = 0; i <= 1000; ++i) {
        const double t = 0.01 * i;
        samples.emplace_back(3 * std::sin(2 * std::numbers::pi * t) + 0.2 + 0.01 * t, 0, 0);
    }
    const TableMotion motion = integrateAccelerogram(0.01, samples, Baseline::at_rest);
    EXPECT_EQ(motion.velocities.back(), Vec3(0, 0, 0));
    EXPECT_EQ(motion.displacements.back(), Vec3(0, 0, 0));
    // Of the sine alone less its own line: x = 3/(2π)·(t − sin(2πt)/(2π)) − drift.
    EXPECT_NEAR(motion.velocities[525].x() - motion.velocities[500].x(), 3 / (2 * std::numbers::pi), 0.05);
    EXPECT_THROW(integrateAccelerogram(0, samples, Baseline::none), InputError);
    EXPECT_THROW(integrateAccelerogram(0.1, std::span(samples).first(1), Baseline::none), InputError);
}

TEST(SurfaceVelocity, BeltsThatStopLetSleep) {
    MovedTable t(Settings::preset(Preset::performance));
    const BodyId box = t.box({0, 0, 0.1});
    t.world.setSurfaceVelocity(t.table, {0.01, 0, 0});
    t.run(2);
    EXPECT_FALSE(t.world.isAsleep(box));
    EXPECT_NEAR(t.world.linearVelocity(box).x(), 0.01, 1e-4);
    t.world.setSurfaceVelocity(t.table, Vec3::Zero());
    t.run(2);
    EXPECT_TRUE(t.world.isAsleep(box));
}

TEST(Motion, FramesThatStopLetSleep) {
    MovedTable t(Settings::preset(Preset::performance));
    const BodyId box = t.box({0, 0, 0.1});
    t.world.setFrameMotion(SineMotion{.amplitude = {0.01, 0, 0}, .frequency = 1});
    t.run(2);
    EXPECT_FALSE(t.world.isAsleep(box));
    t.world.setFrameMotion(std::nullopt);
    t.run(2);
    EXPECT_TRUE(t.world.isAsleep(box));
}

TEST(SurfaceVelocity, ABeltDragsUntilWhatLiesOnItGoesAlong) {
    MovedTable t;
    const BodyId box = t.box({-1.5, 0, 0.1});
    t.run(0.2);
    const double x = t.world.pose(box).position.x();
    t.world.setSurfaceVelocity(t.table, {1, 0, 0});
    t.run(0.5);
    // Speeding up with µg: v²/(2µg) behind.
    EXPECT_NEAR(t.world.linearVelocity(box).x(), 1, 1e-3);
    EXPECT_NEAR(t.world.pose(box).position.x() - x, 0.5 - 1 / 16.0, 5e-3);
    EXPECT_EQ(t.world.pose(t.table).position.x(), 0);
    EXPECT_GT(t.drives, 0.5 * t.world.mass(box)) << "the drive pays for sliding, too";
}

TEST(SurfaceVelocity, FacesAcrossItDoNotPush) {
    MovedTable t;
    const BodyId belt = t.world.addBody({.shape = Box{{1, 1, 1}},
                                         .material = t.stone,
                                         .pose = Pose{Vec3(0, 0, 0.5)},
                                         .fixed = true,
                                         .surface_velocity = {3, 0, 0}});
    const BodyId before = t.box({0.6, 0, 0.1});
    const BodyId beside = t.box({0, 0.6, 0.1});
    t.run(1);
    EXPECT_NEAR(t.world.pose(before).position.x(), 0.6, 1e-3);
    EXPECT_NEAR(t.world.pose(beside).position.x(), 0, 0.05) << "it leans on the side without a force";
    EXPECT_EQ(t.world.surfaceVelocity(belt), Vec3(3, 0, 0));
    EXPECT_THROW(t.world.setFixed(belt, false), InputError);
    EXPECT_THROW(t.world.setSurfaceVelocity(before, Vec3::Zero()), InputError);
}

TEST(SurfaceVelocity, AllResolutionsDragAlike) {
    for (const Preset preset : {Preset::performance, Preset::accuracy, Preset::thesis, Preset::thesis_accuracy}) {
        Settings settings = Settings::preset(preset);
        settings.diagnostics.diagnostics = true;
        MovedTable t(settings);
        t.world.setSurfaceVelocity(t.table, {0, 0.4, 0});
        const BodyId box = t.box({0, -1, 0.1});
        t.run(0.5);
        EXPECT_NEAR(t.world.linearVelocity(box).y(), 0.4, 0.02) << static_cast<int>(preset);
    }
}

}  // namespace
}  // namespace cairn
