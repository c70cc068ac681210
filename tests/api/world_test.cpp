#include "cairn/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cairn {
namespace {

const double nan = std::nan("");

Settings exact() {
    Settings s = Settings::preset(Preset::performance);
    s.sleep.damping = 0;
    return s;
}

/// A world with one material, e = 0 and µ = 0.5.
struct Ground {
    explicit Ground(const Settings& settings = exact()) : world(settings) {
        oak = world.addMaterial({"oak", 800});
        world.setDefaultPairProperties({.restitution = 0, .static_friction = 0.5, .kinetic_friction = 0.5});
        world.setGravity(Vec3(0, 0, -10));
        ground = world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true});
    }
    BodyId box(const Vec3& position, bool asleep = false) {
        return world.addBody({.shape = Box{Vec3::Constant(0.1)},
                              .material = oak,
                              .pose = {position, Quat::Identity()},
                              .asleep = asleep});
    }
    World world;
    MaterialId oak{};
    BodyId ground;
};

TEST(Bodies, AStaleIdGivesAnErrorNeverAnotherBody) {
    Ground g;
    const BodyId first = g.box(Vec3(0, 0, 1));
    g.world.removeBody(first);
    const BodyId second = g.box(Vec3(0, 0, 2));
    EXPECT_FALSE(g.world.contains(first));
    EXPECT_THROW(g.world.pose(first), StaleIdError);
    EXPECT_THROW(g.world.removeBody(first), StaleIdError);
    EXPECT_THROW(g.world.applyForce(first, Vec3::Zero()), StaleIdError);
    EXPECT_THROW(g.world.setLinearVelocity(first, Vec3::Zero()), StaleIdError);
    EXPECT_EQ(g.world.pose(second).position.z(), 2);
    EXPECT_EQ(g.world.bodies(), (std::vector<BodyId>{g.ground, second}));
    EXPECT_EQ(g.world.bodyCount(), 2U);
}

TEST(Bodies, MassFollowsDensityAndVolumeOrIsGiven) {
    Ground g;
    const BodyId box = g.box(Vec3::Zero());
    EXPECT_NEAR(g.world.mass(box), 0.8, 1e-12);
    EXPECT_TRUE(g.world.principalInertia(box).isApprox(Vec3::Constant(0.8 * 0.01 / 6)));
    const BodyId ball = g.world.addBody({.shape = Sphere{0.5}, .material = g.oak, .mass = 5});
    EXPECT_EQ(g.world.mass(ball), 5);
    EXPECT_TRUE(g.world.principalInertia(ball).isApprox(Vec3::Constant(0.4 * 5 * 0.25)));
    EXPECT_EQ(g.world.mass(g.ground), std::numeric_limits<double>::infinity());
}

TEST(Bodies, NonsenseIsRefusedAndLeavesTheWorldAsItWas) {
    Ground g;
    const auto refused = [&](BodyDescription d) {
        d.material = g.oak;
        EXPECT_THROW(g.world.addBody(d), InputError);
    };
    refused({.shape = Sphere{0}});
    refused({.shape = Sphere{nan}});
    refused({.shape = Box{Vec3(1, -1, 1)}});
    refused({.shape = Capsule{0.1, 0}});
    refused({.shape = HalfSpace{Vec3::Zero(), 0}, .fixed = true});
    refused({.shape = HalfSpace{}});
    refused({.mass = 0});
    refused({.mass = -1});
    refused({.mass = std::numeric_limits<double>::infinity()});
    refused({.pose = {Vec3(nan, 0, 0), Quat::Identity()}});
    refused({.pose = {Vec3::Zero(), Quat(0, 0, 0, 0)}});
    refused({.linear_velocity = Vec3(0, nan, 0)});
    refused({.linear_velocity = Vec3(1, 0, 0), .fixed = true});
    refused({.angular_velocity = Vec3(1, 0, 0), .asleep = true});
    EXPECT_THROW(g.world.addBody({.material = MaterialId{9}}), InputError);
    EXPECT_EQ(g.world.bodyCount(), 1U);
    const BodyId box = g.box(Vec3(0, 0, 1));
    EXPECT_THROW(g.world.setPose(box, {Vec3(nan, 0, 0), Quat::Identity()}), InputError);
    EXPECT_THROW(g.world.applyImpulse(box, Vec3(nan, 0, 0)), InputError);
    EXPECT_THROW(g.world.setLinearVelocity(g.ground, Vec3(1, 0, 0)), InputError);
    EXPECT_THROW(g.world.setFixed(g.ground, false), InputError);
    EXPECT_THROW(g.world.setGravity(Vec3(nan, 0, 0)), InputError);
    EXPECT_EQ(g.world.pose(box).position, Vec3(0, 0, 1));
}

TEST(Bodies, AQuaternionIsNormalised) {
    Ground g;
    const BodyId id = g.world.addBody({.material = g.oak, .pose = {Vec3::Zero(), Quat(2, 0, 0, 0)}});
    EXPECT_TRUE(g.world.pose(id).orientation.isApprox(Quat::Identity()));
}

TEST(Loads, ImpulsesForcesAndTorquesActAtTheirPoint) {
    Ground g(Settings::preset(Preset::performance, 240));
    g.world.setGravity(Vec3::Zero());
    const BodyId ball =
        g.world.addBody({.shape = Sphere{1}, .material = g.oak, .mass = 2, .pose = {Vec3(0, 0, 9), {1, 0, 0, 0}}});
    const double inertia = 0.4 * 2;
    g.world.applyImpulseAt(ball, Vec3(2, 0, 0), Vec3(0, 1, 9));
    EXPECT_TRUE(g.world.linearVelocity(ball).isApprox(Vec3(1, 0, 0)));
    EXPECT_TRUE(g.world.angularVelocity(ball).isApprox(Vec3(0, 0, -2 / inertia)));
    g.world.applyAngularImpulse(ball, Vec3(0, 0, 2));
    EXPECT_LT(g.world.angularVelocity(ball).norm(), 1e-12);
    g.world.applyForceAt(ball, Vec3(-480, 0, 0), Vec3(0, -1, 9));
    g.world.step();
    EXPECT_LT(g.world.linearVelocity(ball).norm(), 1e-12);
    EXPECT_TRUE(g.world.angularVelocity(ball).isApprox(Vec3(0, 0, -2 / inertia)));
    g.world.applyTorque(ball, Vec3(0, 0, 480));
    g.world.step();
    EXPECT_LT(g.world.angularVelocity(ball).norm(), 1e-12);
    g.world.setConstantForce(ball, Vec3(0, 0, 48));
    for (int i = 0; i < 10; ++i) g.world.step();
    EXPECT_NEAR(g.world.linearVelocity(ball).z(), 1, 1e-12);
}

TEST(Wake, Condition1AnyChangeFromOutsideWakes) {
    const auto sleeper = [](Ground& g) { return g.box(Vec3(0, 0, 0.05), true); };
    const auto wakes = [&](const auto& change) {
        Ground g;
        const BodyId id = sleeper(g);
        g.world.step();
        ASSERT_TRUE(g.world.isAsleep(id));
        change(g.world, id);
        EXPECT_FALSE(g.world.isAsleep(id));
    };
    wakes([](World& w, BodyId id) { w.setPose(id, w.pose(id)); });
    wakes([](World& w, BodyId id) { w.setLinearVelocity(id, Vec3(1, 0, 0)); });
    wakes([](World& w, BodyId id) { w.setAngularVelocity(id, Vec3(1, 0, 0)); });
    wakes([](World& w, BodyId id) { w.applyForce(id, Vec3(1, 0, 0)); });
    wakes([](World& w, BodyId id) { w.applyForceAt(id, Vec3(1, 0, 0), Vec3::Zero()); });
    wakes([](World& w, BodyId id) { w.applyTorque(id, Vec3(1, 0, 0)); });
    wakes([](World& w, BodyId id) { w.applyImpulse(id, Vec3(1, 0, 0)); });
    wakes([](World& w, BodyId id) { w.applyAngularImpulse(id, Vec3(1, 0, 0)); });
    wakes([](World& w, BodyId id) { w.setConstantForce(id, Vec3(1, 0, 0)); });
    wakes([](World& w, BodyId id) { w.setConstantTorque(id, Vec3(1, 0, 0)); });
    wakes([](World& w, BodyId id) { w.wake(id); });
}

TEST(Wake, Condition1AChangeOfGravityWakesAll) {
    Ground g;
    g.box(Vec3(0, 0, 0.05), true);
    g.box(Vec3(1, 0, 0.05), true);
    g.world.step();
    EXPECT_EQ(g.world.statistics().woken, 0);
    g.world.setGravity(Vec3(0, 0, -9));
    g.world.step();
    EXPECT_EQ(g.world.statistics().woken, 2);
    g.world.setGlobalAcceleration(Vec3(1, 0, 0));
    g.world.step();
    EXPECT_EQ(g.world.statistics().woken, 2);
}

TEST(Wake, Condition2DisplacementByTheCorrectionWakes) {
    Ground g;
    const BodyId sunk = g.box(Vec3(0, 0, 0.04), true);
    g.world.step();
    EXPECT_EQ(g.world.statistics().displaced_bodies, 1);
    EXPECT_EQ(g.world.statistics().woken, 1);
    EXPECT_GT(g.world.pose(sunk).position.z(), 0.045);
}

TEST(Wake, Condition3ACollisionWakesTheBodyThatIsHitAndNoOther) {
    Ground g;
    const BodyId hit = g.box(Vec3(0, 0, 0.05), true);
    const BodyId far = g.box(Vec3(1, 0, 0.05), true);
    const BodyId bullet = g.box(Vec3(-0.12, 0, 0.05));
    g.world.setLinearVelocity(bullet, Vec3(5, 0, 0));
    for (int i = 0; i < 3; ++i) g.world.step();
    EXPECT_FALSE(g.world.isAsleep(hit));
    EXPECT_TRUE(g.world.isAsleep(far));
}

TEST(Wake, Condition4RemovalWakesWhatTouched) {
    Ground g;
    const BodyId low = g.box(Vec3(0, 0, 0.05), true);
    const BodyId high = g.box(Vec3(0, 0, 0.15), true);
    const BodyId beside = g.box(Vec3(1, 0, 0.05), true);
    g.world.step();
    ASSERT_TRUE(g.world.isAsleep(high));
    g.world.removeBody(low);
    EXPECT_FALSE(g.world.isAsleep(high));
    EXPECT_TRUE(g.world.isAsleep(beside));
    for (int i = 0; i < 240; ++i) g.world.step();
    EXPECT_NEAR(g.world.pose(high).position.z(), 0.05, 2e-3);
}

TEST(Wake, Conditions5And6LossOfSupportWakes) {
    Ground g;
    const BodyId shelf = g.world.addBody(
        {.shape = Box{Vec3(1, 1, 0.1)}, .material = g.oak, .pose = {Vec3(0, 0, 1), {1, 0, 0, 0}}, .fixed = true});
    const BodyId box = g.box(Vec3(0, 0, 1.1), true);
    g.world.step();
    ASSERT_TRUE(g.world.isAsleep(box));
    g.world.setPose(shelf, {Vec3(5, 0, 1), Quat::Identity()});
    g.world.step();
    EXPECT_FALSE(g.world.isAsleep(box));
    const BodyId floating = g.box(Vec3(0, 0, 7), true);
    g.world.step();
    EXPECT_FALSE(g.world.isAsleep(floating));
}

TEST(Wake, ANeighbourMovingAwaySidewaysDoesNotWake) {
    Ground g;
    const BodyId sleeper = g.box(Vec3(0, 0, 0.05), true);
    const BodyId neighbour = g.box(Vec3(0.1, 0, 0.05), true);
    g.world.step();
    ASSERT_FALSE(g.world.contacts().empty());
    g.world.setPose(neighbour, {Vec3(0.5, 0, 0.05), Quat::Identity()});
    for (int i = 0; i < 10; ++i) {
        g.world.step();
        ASSERT_TRUE(g.world.isAsleep(sleeper));
    }
}

TEST(Faults, ABodyThatLeavesTheNumbersIsFixedAndReportedAndTheRestGoesOn) {
    Ground g;
    const BodyId bad = g.box(Vec3(0, 0, 1));
    const BodyId good = g.box(Vec3(0, 0, 5));
    for (int i = 0; i < 3; ++i) g.world.applyForce(bad, Vec3(1e30, 0, 0));
    g.world.step();
    ASSERT_EQ(g.world.faults().size(), 1U);
    EXPECT_EQ(g.world.faults()[0].body, bad);
    EXPECT_EQ(g.world.faults()[0].step, 1);
    EXPECT_TRUE(g.world.isFixed(bad));
    EXPECT_TRUE(g.world.pose(bad).position.allFinite());
    g.world.step();
    EXPECT_LT(g.world.linearVelocity(good).z(), 0);
}

TEST(Contacts, ReportPairsNormalsAndImpulses) {
    Ground g;
    const BodyId box = g.box(Vec3(0, 0, 0.05));
    for (int i = 0; i < 10; ++i) g.world.step();
    const auto contacts = g.world.contacts();
    ASSERT_EQ(contacts.size(), 4U);
    Vec3 sum = Vec3::Zero();
    for (const ContactInfo& c : contacts) {
        EXPECT_EQ(c.a, g.ground);
        EXPECT_EQ(c.b, box);
        EXPECT_TRUE(c.normal.isApprox(-Vec3::UnitZ()));
        EXPECT_NEAR(c.distance, 0, 1e-5);
        sum += c.impulse;
    }
    // The ground receives the weight of one step.
    EXPECT_NEAR(sum.z(), -g.world.mass(box) * 10 / 240, 1e-4);
    ASSERT_EQ(g.world.batches().size(), 1U);
    EXPECT_EQ(g.world.batches()[0].bodies, std::vector<BodyId>{box});
    g.world.removeBody(box);
    EXPECT_TRUE(g.world.contacts().empty());
}

TEST(Time, CountsStepsExactlyAlsoWhenTheStepLengthChanges) {
    World world;
    for (int i = 0; i < 240; ++i) world.step();
    EXPECT_EQ(world.time(), 1);
    world.setSettings(Settings::preset(Preset::accuracy));
    for (int i = 0; i < 960; ++i) world.step();
    EXPECT_EQ(world.time(), 2);
    EXPECT_EQ(world.stepCount(), 1200);
}

TEST(SettingsOfWorld, ContradictionsAreRefusedAtRunTime) {
    World world;
    EXPECT_THROW(world.setGravity(Vec3(0, 0, -1)), InputError);
    Settings s = Settings::preset(Preset::performance);
    s.resolution.iterations = -1;
    EXPECT_THROW(world.setSettings(s), InputError);
    EXPECT_THROW(World{s}, InputError);
    world.setSettings(Settings::preset(Preset::performance, 240, 1));
    EXPECT_NO_THROW(world.setGravity(Vec3(0, 0, -1)));
}

TEST(Hash, EqualStatesHaveEqualHashesAndAnyChangeShows) {
    Ground a;
    Ground b;
    const BodyId box = a.box(Vec3(0, 0, 1));
    b.box(Vec3(0, 0, 1));
    EXPECT_EQ(a.world.stateHash(), b.world.stateHash());
    a.world.setPose(box, {Vec3(0, 0, std::nextafter(1.0, 2.0)), Quat::Identity()});
    EXPECT_NE(a.world.stateHash(), b.world.stateHash());
}

TEST(SpringsOfWorld, GoWithTheirBodyAndRefuseNonsense) {
    Ground g;
    const BodyId box = g.box(Vec3(0, 0, 1));
    const SpringId spring =
        g.world.addSpring({.a = box, .anchor_b = Vec3(0, 0, 2), .stiffness = 100, .rest_length = 1});
    EXPECT_NO_THROW(g.world.setSpringAnchor(spring, Vec3(0, 0, 3)));
    EXPECT_THROW(g.world.addSpring({.a = box, .stiffness = -1}), InputError);
    EXPECT_THROW(g.world.addSpring({.a = box, .b = box, .stiffness = 1}), InputError);
    EXPECT_THROW(g.world.addSpring({.a = g.ground, .stiffness = 1}), InputError);
    g.world.removeBody(box);
    EXPECT_THROW(g.world.removeSpring(spring), StaleIdError);
    EXPECT_NO_THROW(g.world.step());
}

TEST(EmptyWorld, Steps) {
    World world;
    for (int i = 0; i < 10; ++i) world.step();
    EXPECT_EQ(world.statistics().contacts, 0);
    EXPECT_EQ(world.kineticEnergy(), 0);
}

}  // namespace
}  // namespace cairn
