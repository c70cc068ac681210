/// Groups, exceptions, sensors and what bodies feel of their own.
#include <gtest/gtest.h>

#include <cmath>

#include "cairn/world.h"

namespace cairn {
namespace {

/// A world with a floor whose surface is z = 0.
struct FilteredFloor {
    World world;
    MaterialId stone;
    BodyId floor;

    explicit FilteredFloor(const Settings& settings = Settings::preset(Preset::performance)) : world(settings) {
        stone = world.addMaterial({"stone", 1000});
        world.setGravity({0, 0, -10});
        floor = world.addBody({.shape = HalfSpace{}, .material = stone, .fixed = true});
    }
    BodyId ball(const Vec3& at, std::vector<GroupId> groups = {}) {
        return world.addBody({.shape = Sphere{0.1}, .material = stone, .pose = Pose{at}, .groups = std::move(groups)});
    }
    double height(BodyId id) const { return world.pose(id).position.z(); }
    void run(double seconds) {
        const double end = world.time() + seconds;
        while (world.time() < end) world.step();
    }
};

TEST(Filters, GroupsThatAreApartPassThroughEachOther) {
    FilteredFloor f;
    const GroupId ghosts = f.world.addGroup("ghosts");
    const GroupId ground = f.world.addGroup("ground");
    const GroupId both[] = {ghosts, ground};
    f.world.setGroups(f.floor, std::span(both).subspan(1));
    f.world.setGroupsTouch(ghosts, ground, Touch::never);
    EXPECT_EQ(f.world.groupsTouch(ground, ghosts), Touch::never);
    const BodyId ghost = f.ball({0, 0, 1}, {ghosts});
    const BodyId solid = f.ball({1, 0, 1});
    const BodyId half = f.ball({2, 0, 1}, {ground, ghosts});
    f.run(2);
    EXPECT_LT(f.height(ghost), -15);
    EXPECT_NEAR(f.height(solid), 0.1, 1e-3);
    EXPECT_LT(f.height(half), -15) << "one group that is apart is enough";
    EXPECT_EQ(f.world.groups(half).size(), 2U);
    EXPECT_EQ(f.world.groupNames()[1], "ground");
}

TEST(Filters, AGroupMayBeApartFromItself) {
    FilteredFloor f;
    const GroupId dust = f.world.addGroup("dust");
    f.world.setGroupsTouch(dust, dust, Touch::never);
    const BodyId lower = f.ball({0, 0, 0.1}, {dust});
    const BodyId upper = f.ball({0, 0, 0.5}, {dust});
    f.run(2);
    EXPECT_NEAR(f.height(lower), 0.1, 1e-3);
    EXPECT_NEAR(f.height(upper), 0.1, 1e-3);
    for (const ContactInfo& contact : f.world.contacts()) EXPECT_EQ(contact.a, f.floor);
}

TEST(Filters, ExceptionsOfPairsGoBeforeTheirGroups) {
    FilteredFloor f;
    const GroupId dust = f.world.addGroup("dust");
    f.world.setGroupsTouch(dust, dust, Touch::never);
    const BodyId lower = f.ball({0, 0, 0.1}, {dust});
    const BodyId upper = f.ball({0, 0, 0.5}, {dust});
    const BodyId faller = f.ball({1, 0, 0.5});
    f.world.setPairTouch(upper, lower, Touch::always);
    f.world.setPairTouch(f.floor, faller, Touch::never);
    EXPECT_EQ(f.world.pairTouch(lower, upper), Touch::always);
    f.run(0.5);
    EXPECT_GT(f.height(upper), 0.28);
    EXPECT_LT(f.height(faller), -0.5);
    f.world.setPairTouch(lower, upper, std::nullopt);
    EXPECT_EQ(f.world.pairTouch(lower, upper), std::nullopt);
    f.run(2);
    EXPECT_NEAR(f.height(upper), 0.1, 1e-3) << "it fell through when the exception ended";
    EXPECT_THROW(f.world.setPairTouch(lower, lower, Touch::never), InputError);
}

TEST(Filters, ExceptionsEndWithTheirBodies) {
    FilteredFloor f;
    const BodyId first = f.ball({0, 0, 1});
    f.world.setPairTouch(f.floor, first, Touch::never);
    f.world.removeBody(first);
    const BodyId second = f.ball({0, 0, 1});
    ASSERT_EQ(second.index, first.index);
    EXPECT_EQ(f.world.pairTouch(f.floor, second), std::nullopt);
    EXPECT_THROW(static_cast<void>(f.world.pairTouch(f.floor, first)), StaleIdError);
}

TEST(Filters, ChangesWakeAndFindSleepersAnew) {
    FilteredFloor f;
    const GroupId dust = f.world.addGroup("dust");
    const BodyId lower = f.ball({0, 0, 0.1}, {dust});
    f.world.setGroups(f.floor, std::span(&dust, 1));
    f.run(1);
    ASSERT_TRUE(f.world.isAsleep(lower));
    f.world.setGroupsTouch(dust, dust, Touch::never);
    f.run(0.2);
    EXPECT_LT(f.height(lower), 0);
}

TEST(Filters, RefuseWhatDoesNotExist) {
    FilteredFloor f;
    EXPECT_THROW(f.world.addGroup(""), InputError);
    const GroupId a = f.world.addGroup("a");
    EXPECT_THROW(f.world.addGroup("a"), InputError);
    EXPECT_THROW(f.world.setGroupsTouch(a, static_cast<GroupId>(1), Touch::never), InputError);
    const GroupId unknown[] = {static_cast<GroupId>(64)};
    EXPECT_THROW(f.world.setGroups(f.floor, unknown), InputError);
    EXPECT_THROW(f.ball({0, 0, 1}, {static_cast<GroupId>(1)}), InputError);
    for (std::size_t i = 1; i < most_groups; ++i) f.world.addGroup(std::to_string(i));
    EXPECT_THROW(f.world.addGroup("one too many"), InputError);
}

TEST(Sensors, ReportWhoEntersAndLeavesAndTouchNobody) {
    FilteredFloor f;
    f.world.setEventLevel(EventLevel::changes);
    const BodyId gate = f.world.addBody(
        {.shape = Box{{4, 4, 0.5}}, .material = f.stone, .pose = Pose{Vec3(0, 0, 2)}, .fixed = true, .sensor = true});
    const BodyId left = f.ball({-1, 0, 3});
    const BodyId right = f.ball({1, 0, 3});
    std::vector<std::pair<EventKind, BodyId>> told;
    for (int i = 0; i < 480; ++i) {
        f.world.step();
        for (const Event& event : f.world.events()) {
            if (event.kind != EventKind::sensor_entered && event.kind != EventKind::sensor_left) continue;
            EXPECT_EQ(event.a, gate);
            told.emplace_back(event.kind, event.b);
        }
        for (const Sensed& sensed : f.world.sensed()) {
            EXPECT_EQ(sensed.sensor, gate);
            EXPECT_LT(std::abs(f.height(sensed.body) - 2), 0.4);
        }
    }
    const std::vector<std::pair<EventKind, BodyId>> expected = {{EventKind::sensor_entered, left},
                                                                {EventKind::sensor_entered, right},
                                                                {EventKind::sensor_left, left},
                                                                {EventKind::sensor_left, right}};
    EXPECT_EQ(told, expected);
    // They fell as if it were not there.
    EXPECT_NEAR(f.height(left), 0.1, 1e-3);
    EXPECT_TRUE(f.world.isSensor(gate));
    EXPECT_FALSE(f.world.castRay({Vec3(0, 0, 5), -Vec3::UnitZ(), 4})) << "rays go through";
}

TEST(Sensors, TellOfBodiesThatAreRemovedInside) {
    FilteredFloor f;
    f.world.setGravity(Vec3::Zero());
    f.world.setEventLevel(EventLevel::changes);
    f.world.addBody(
        {.shape = Sphere{1}, .material = f.stone, .pose = Pose{Vec3(0, 0, 5)}, .fixed = true, .sensor = true});
    const BodyId ball = f.ball({0, 0, 5});
    f.world.step();
    ASSERT_EQ(f.world.sensed().size(), 1U);
    const World copy = World::restore(f.world.save());
    EXPECT_EQ(copy.sensed().size(), 1U);
    f.world.removeBody(ball);
    f.world.step();
    ASSERT_EQ(f.world.events().size(), 1U);
    EXPECT_EQ(f.world.events()[0].kind, EventKind::sensor_left);
    EXPECT_EQ(f.world.events()[0].b, ball);
}

TEST(Sensors, SeeWhatTheirGroupsTouchOnly) {
    FilteredFloor f;
    const GroupId eyes = f.world.addGroup("eyes");
    const GroupId hidden = f.world.addGroup("hidden");
    f.world.setGroupsTouch(eyes, hidden, Touch::never);
    f.world.setGravity(Vec3::Zero());
    f.world.addBody({.shape = Sphere{1},
                     .material = f.stone,
                     .pose = Pose{Vec3(0, 0, 5)},
                     .fixed = true,
                     .groups = {eyes},
                     .sensor = true});
    f.ball({0, 0.5, 5}, {hidden});
    const BodyId seen = f.ball({0, -0.5, 5});
    f.world.step();
    ASSERT_EQ(f.world.sensed().size(), 1U);
    EXPECT_EQ(f.world.sensed()[0].body, seen);
}

TEST(OwnGravity, FactorsScaleTheFall) {
    Settings settings = Settings::preset(Preset::performance);
    settings.sleep.damping = 0;
    FilteredFloor f(settings);
    const BodyId falls = f.ball({0, 0, 50});
    const BodyId floats = f.ball({1, 0, 50});
    const BodyId rises = f.ball({2, 0, 50});
    const BodyId faster = f.ball({3, 0, 50});
    f.world.setGravityFactor(floats, 0);
    f.world.setGravityFactor(rises, -0.5);
    f.world.setGravityFactor(faster, 2);
    f.world.setLinearVelocity(floats, Vec3(1e-6, 0, 0));
    f.run(2);
    const double fall = 50 - f.height(falls);
    EXPECT_NEAR(fall, 20, 0.1);
    EXPECT_EQ(f.height(floats), 50);
    EXPECT_NEAR(f.height(rises), 50 + 0.5 * fall, 1e-9);
    EXPECT_NEAR(f.height(faster), 50 - 2 * fall, 1e-9);
    EXPECT_FALSE(f.world.isAsleep(floats)) << "it would lose its momentum";
    EXPECT_EQ(f.world.linearVelocity(floats).x(), 1e-6);
    EXPECT_THROW(f.world.setGravityFactor(floats, std::nan("")), InputError);
}

TEST(OwnGravity, HeavyAndLightBodiesRestAndSleep) {
    FilteredFloor f;
    const BodyId light = f.ball({0, 0, 0.1});
    const BodyId heavy = f.ball({1, 0, 0.1});
    const BodyId top = f.ball({1, 0, 0.3});
    f.world.setGravityFactor(light, 0.1);
    f.world.setGravityFactor(heavy, 3);
    f.world.setGravityFactor(top, 0.5);
    f.world.setChecks(Checks::on);
    f.run(3);
    for (const BodyId id : {light, heavy, top}) EXPECT_TRUE(f.world.isAsleep(id));
    EXPECT_NEAR(f.height(light), 0.1, 1e-3);
    EXPECT_NEAR(f.height(top), 0.3, 1e-3);
}

TEST(Damping, DecaysExponentially) {
    FilteredFloor f;
    f.world.setGravity(Vec3::Zero());
    const BodyId ball = f.ball({0, 0, 5});
    f.world.setDamping(ball, 0.7, 30);
    f.world.setLinearVelocity(ball, {2, 0, 0});
    f.world.setAngularVelocity(ball, {0, 3, 0});
    const auto start = f.world.stepCount();
    for (int i = 0; i < 100; ++i) f.world.step();
    const double t = static_cast<double>(f.world.stepCount() - start) * f.world.settings().timeStep();
    EXPECT_NEAR(f.world.linearVelocity(ball).x(), 2 * std::exp(-0.7 * t), 1e-12);
    EXPECT_NEAR(f.world.angularVelocity(ball).y(), 3 * std::exp(-30 * t), 1e-12);
    EXPECT_THROW(f.world.setDamping(ball, -1, 0), InputError);
    EXPECT_THROW(f.world.setDamping(ball, 0, 2e6), InputError);
}

TEST(Damping, StandsInTheEnergyAccountWithTheOwnGravity) {
    Settings settings = Settings::preset(Preset::performance);
    settings.diagnostics.diagnostics = true;
    settings.sleep.sleeping = false;
    FilteredFloor f(settings);
    for (int i = 0; i < 8; ++i) {
        const BodyId ball = f.ball({0.15 * i, 0.01 * i, 0.4 + 0.1 * i});
        f.world.setGravityFactor(ball, 0.5 + 0.3 * i);
        f.world.setDamping(ball, 0.4, 2);
    }
    double damped = 0;
    for (int i = 0; i < 400; ++i) {
        f.world.step();
        const Diagnostics& d = f.world.statistics().diagnostics;
        ASSERT_LT(std::abs(d.energy_error), 1e-11 * (1 + std::abs(d.energy)));
        ASSERT_LT(d.momentum_error, 1e-11);
        damped += d.energy_damping;
    }
    EXPECT_LT(damped, -0.1);
}

TEST(Filters, GoOnFromSnapshotsAndMoments) {
    FilteredFloor f;
    const GroupId dust = f.world.addGroup("dust");
    f.world.setGroupsTouch(dust, dust, Touch::never);
    for (int i = 0; i < 6; ++i) f.ball({0.02 * i, 0, 0.2 + 0.2 * i}, {dust});
    const std::vector<BodyId> ids = f.world.bodies();
    f.world.setPairTouch(ids[1], ids[2], Touch::always);
    f.world.setGravityFactor(ids[3], 0.3);
    f.world.setDamping(ids[4], 1, 1);
    f.world.setUserData(ids[5], UINT64_MAX);
    RollbackState moment;
    f.world.keep(moment);
    World restored = World::restore(f.world.save());
    for (int i = 0; i < 200; ++i) {
        f.world.step();
        restored.step();
    }
    EXPECT_EQ(restored.stateHash(), f.world.stateHash());
    EXPECT_EQ(restored.userData(ids[5]), UINT64_MAX);
    EXPECT_EQ(restored.groupNames()[0], "dust");
    World other;
    other.load(moment);
    for (int i = 0; i < 200; ++i) other.step();
    EXPECT_EQ(other.stateHash(), f.world.stateHash());
    EXPECT_EQ(other.pairTouch(ids[1], ids[2]), Touch::always);
}

}  // namespace
}  // namespace cairn
