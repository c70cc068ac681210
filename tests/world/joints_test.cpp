/// Joints in a world: what is refused, ids, events, sleep, snapshots and threads.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "cairn/world.h"

namespace cairn {
namespace {

struct Site {
    World world;
    MaterialId oak = world.addMaterial({"oak", 800});

    explicit Site(const Settings& settings = Settings::preset(Preset::performance)) : world(settings) {
        world.setGravity(Vec3(0, 0, -10));
    }
    BodyId box(const Vec3& place, bool fixed = false) {
        return world.addBody(
            {.shape = Box{{0.2, 0.2, 0.2}}, .material = oak, .pose = {place, Quat::Identity()}, .fixed = fixed});
    }
    std::string refusal(const JointDescription& description) {
        try {
            world.addJoint(description);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    void run(int steps) {
        for (int i = 0; i < steps; ++i) world.step();
    }
};

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(WorldJoints, RefuseBodiesThatTheyCannotJoin) {
    Site s;
    const BodyId a = s.box({0, 0, 1});
    const BodyId wall = s.box({1, 0, 1}, true);
    const BodyId floor = s.box({2, 0, 1}, true);
    EXPECT_TRUE(has(s.refusal({.a = a, .b = a}), "two different bodies"));
    EXPECT_TRUE(has(s.refusal({.a = wall}), "cannot move"));
    EXPECT_TRUE(has(s.refusal({.a = wall, .b = floor}), "cannot move"));
    EXPECT_EQ(s.refusal({.a = wall, .b = a}), "");
    const BodyId gone = s.box({3, 0, 1});
    s.world.removeBody(gone);
    EXPECT_THROW(s.world.addJoint({.a = gone}), StaleIdError);
    EXPECT_THROW(s.world.addJoint({.a = a, .b = gone}), StaleIdError);
}

TEST(WorldJoints, RefuseValuesThatMeanNothing) {
    Site s;
    const BodyId a = s.box({0, 0, 1});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(has(s.refusal({.a = a, .anchor = Vec3(nan, 0, 0)}), "anchor of a ball joint"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::hinge, .a = a, .axis = Vec3::Zero()}), "axis of a hinge"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::slider, .a = a, .axis = Vec3(0, nan, 0)}), "axis of a slider"));
    EXPECT_TRUE(has(s.refusal({.a = a, .break_force = -1}), "break_force of a ball joint is -1"));
    EXPECT_TRUE(has(s.refusal({.a = a, .break_force = nan}), "break_force"));
    EXPECT_TRUE(has(s.refusal({.a = a, .break_torque = 5}), "no torque"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::slider, .a = a, .lower = 1, .upper = -1}), "reversed"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::hinge, .a = a, .lower = -4e7, .upper = 1}), "within ±1000000 rad"));
    EXPECT_TRUE(has(s.refusal({.a = a, .lower = -1, .upper = 1}), "no limits"));
    EXPECT_TRUE(has(s.refusal({.a = a, .motor = JointMotor{1, 1}}), "no motor"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::hinge, .a = a, .motor = JointMotor{1, -1}}), "limit of a motor"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::hinge, .a = a, .motor = JointMotor{nan, 1}}), "speed of a motor"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::distance, .a = a}), "give anchor_b"));
    EXPECT_TRUE(has(s.refusal({.a = a, .anchor_b = Vec3::Zero()}), "one anchor"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::rope, .a = a, .anchor_b = Vec3::Zero()}), "on each other"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::rope, .a = a, .anchor_b = Vec3::Zero(), .length = -2.0}), "length"));
    EXPECT_TRUE(s.world.joints().empty()) << "nothing refused stays";
}

TEST(WorldJoints, RefuseAxesThatMeanNothing) {
    Site s;
    const BodyId a = s.box({0, 0, 1});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto hinge = [&](const JointAxis& axis) {
        JointDescription d{.kind = JointKind::hinge, .a = a};
        d.lower = axis.lower;
        d.restitution = axis.restitution;
        d.motor = axis.motor;
        d.servo = axis.servo;
        d.spring = axis.spring;
        d.damping = axis.damping;
        d.friction = axis.friction;
        d.rotor_inertia = axis.rotor_inertia;
        return s.refusal(d);
    };
    EXPECT_TRUE(has(hinge({.servo = JointServo{.stiffness = nan}}), "stiffness of a servo"));
    EXPECT_TRUE(has(hinge({.servo = JointServo{.stiffness = 1e31}}), "stiffness of a servo"));
    EXPECT_TRUE(has(hinge({.servo = JointServo{.damping = -1}}), "damping of a servo"));
    EXPECT_TRUE(has(hinge({.servo = JointServo{.position = nan, .damping = 1}}), "position of a servo"));
    EXPECT_TRUE(has(hinge({.servo = JointServo{.speed = nan, .damping = 1}}), "speed of a servo"));
    EXPECT_TRUE(has(hinge({.servo = JointServo{.damping = 1, .limit = nan}}), "limit of a servo"));
    EXPECT_TRUE(has(hinge({.servo = JointServo{.position = 1}}), "neither stiffness nor damping"));
    EXPECT_TRUE(has(hinge({.motor = JointMotor{1, 1}, .servo = JointServo{.damping = 1}}), "a motor and a servo"));
    EXPECT_TRUE(has(hinge({.spring = JointSpring{-1, 0}}), "stiffness of a spring"));
    EXPECT_TRUE(has(hinge({.spring = JointSpring{1, nan}}), "rest of a spring"));
    EXPECT_TRUE(has(hinge({.lower = nan}), "a limit of a hinge"));
    EXPECT_TRUE(has(hinge({.restitution = 1.5}), "restitution of a hinge"));
    EXPECT_TRUE(has(hinge({.damping = nan}), "damping of a hinge"));
    EXPECT_TRUE(has(hinge({.friction = -1}), "friction of a hinge"));
    EXPECT_TRUE(has(hinge({.rotor_inertia = -1}), "rotor_inertia of a hinge"));
    EXPECT_TRUE(has(s.refusal({.a = a, .damping = 1}), "no damping of its own; give it in axes"));
    EXPECT_TRUE(has(s.refusal({.a = a, .axes = {{}}}), "has 3 free axes, but axes has 1"));
    EXPECT_TRUE(has(s.refusal({.a = a, .axes = {{}, {.upper = 1}, {}}}), "give the others a cone"));
    EXPECT_TRUE(has(s.refusal({.a = a, .axes = {{.upper = 4}, {}, {}}}), "beyond ±π"));
    EXPECT_TRUE(has(s.refusal({.a = a, .cone = -1}), "cone of a ball joint"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::fixed, .a = a, .cone = 1}), "no cone"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::screw, .a = a}), "needs its lead"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::hinge, .a = a, .lead = 1}), "no lead"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::hinge, .a = a, .axis_2 = Vec3::UnitX()}), "one axis only"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::universal, .a = a, .axis_2 = Vec3::UnitZ()}), "along its axis"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::generic, .a = a, .axes = {{}, {}}}), "given twice"));
    EXPECT_TRUE(s.world.joints().empty()) << "nothing refused stays";
}

TEST(WorldJoints, RefuseCouplingsOfWhatCannotBeCoupled) {
    Site s;
    const BodyId a = s.box({0, 0, 1});
    const JointId ball = s.world.addJoint({.a = a});
    const JointId hinge = s.world.addJoint({.kind = JointKind::hinge, .a = a});
    const JointId fixed = s.world.addJoint({.kind = JointKind::fixed, .a = a});
    const auto couple = [&](JointKind kind, JointId first, JointId second, double ratio = 1) {
        return s.refusal({.kind = kind, .first = first, .second = second, .ratio = ratio});
    };
    EXPECT_TRUE(has(couple(JointKind::gear, hinge, fixed), "no free axis 0"));
    EXPECT_TRUE(has(couple(JointKind::gear, hinge, hinge), "to itself"));
    EXPECT_TRUE(has(couple(JointKind::rack, hinge, ball), "displacement of the second"));
    EXPECT_TRUE(has(couple(JointKind::mimic, hinge, ball, 0), "ratio of a mimic is 0"));
    EXPECT_TRUE(has(s.refusal({.kind = JointKind::gear, .damping = 1}), "nothing else"));
    const auto breaking = [&](double force, double torque) {
        return s.refusal(
            {.kind = JointKind::gear, .break_force = force, .break_torque = torque, .first = hinge, .second = ball});
    };
    constexpr double never = JointDescription::infinite;
    EXPECT_TRUE(has(breaking(5, never), "an angle breaks at a break_torque; leave break_force out"));
    EXPECT_TRUE(has(breaking(never, -1), "break_torque of a gear is -1"));
    EXPECT_THROW(s.world.addJoint({.kind = JointKind::gear, .first = hinge, .second = {99, 0}}), StaleIdError);
    const JointId gear = s.world.addJoint({.kind = JointKind::gear, .first = hinge, .second = ball});
    EXPECT_TRUE(has(couple(JointKind::mimic, hinge, gear), "is a gear itself"));
    s.world.removeBody(a);
    EXPECT_FALSE(s.world.contains(gear));
}

TEST(WorldJoints, AxesAreSetAnewWhileTheWorldRuns) {
    Site s;
    s.world.setGravity(Vec3::Zero());
    const BodyId a = s.box({0, 0, 1});
    const JointId joint = s.world.addJoint({.kind = JointKind::cylindrical, .a = a, .anchor = {0, 0, 1}});
    s.world.setJointAxis(joint, 1, {.motor = JointMotor{3, 1e6}});
    s.run(10);
    EXPECT_NEAR(s.world.joint(joint).speeds[1], 3, 1e-9);
    EXPECT_THROW(s.world.setJointAxis(joint, 2, {}), InputError);
    EXPECT_THROW(s.world.setJointServo(joint, {.damping = 1}), InputError) << "it has two axes";
    const JointId hinge = s.world.addJoint({.kind = JointKind::hinge, .a = s.box({1, 0, 1}), .anchor = {1, 0, 1}});
    s.world.setJointServo(hinge, {.position = 0.5, .stiffness = 1e20, .damping = 1e10});
    s.run(10);
    EXPECT_NEAR(s.world.joint(hinge).position, 0.5, 1e-6);
    EXPECT_THROW(s.world.setJointMotor(hinge, {1, 1}), InputError) << "it has a servo";
}

TEST(WorldJoints, IdsOfRemovedOnesAreStale) {
    Site s;
    const BodyId a = s.box({0, 0, 1});
    const JointId first = s.world.addJoint({.a = a});
    s.world.removeJoint(first);
    const JointId second = s.world.addJoint({.a = a});
    EXPECT_EQ(second.index, first.index);
    EXPECT_FALSE(s.world.contains(first));
    EXPECT_TRUE(s.world.contains(second));
    EXPECT_THROW(s.world.removeJoint(first), StaleIdError);
    EXPECT_THROW(s.world.joint(first), StaleIdError);
    EXPECT_THROW(s.world.setJointMotor(first, {}), StaleIdError);
    EXPECT_THROW(s.world.setJointLimits(first, {}, {}), StaleIdError);
    EXPECT_THROW(s.world.setJointMotor(second, {}), InputError) << "a ball joint has none";
    s.world.removeBody(a);
    EXPECT_FALSE(s.world.contains(second)) << "joints go with their bodies";
}

TEST(WorldJoints, BreakAtTheirForceAndSayIt) {
    for (const double strength : {0.99, 1.01}) {
        Site s(Settings::preset(Preset::accuracy));
        s.world.setEventLevel(EventLevel::changes);
        const BodyId box = s.box({0, 0, 1});
        const double weight = 10 * s.world.mass(box);
        Settings settings = s.world.settings();
        settings.sleep.damping = 0;
        s.world.setSettings(settings);
        const JointId joint = s.world.addJoint({.kind = JointKind::fixed, .a = box, .break_force = strength * weight});
        std::vector<Event> broke;
        for (int i = 0; i < 20; ++i) {
            s.world.step();
            for (const Event& event : s.world.events()) {
                if (event.kind == EventKind::joint_broke) broke.push_back(event);
            }
        }
        EXPECT_EQ(s.world.contains(joint), strength > 1);
        ASSERT_EQ(broke.size(), strength > 1 ? 0U : 1U);
        if (strength > 1) continue;
        EXPECT_EQ(broke[0].joint, joint);
        EXPECT_EQ(broke[0].a, box);
        EXPECT_NEAR(broke[0].impulse.z() * s.world.settings().steps_per_second, weight, 1e-9);
        EXPECT_LT(s.world.linearVelocity(box).z(), -0.1) << "it falls from then on";
    }
}

TEST(WorldJoints, AMotorThatBreaksItsJointMayHaveAddedEnergy) {
    Site s;
    s.world.setGravity(Vec3::Zero());
    s.world.setChecks(Checks::on);
    const BodyId box = s.box({0, 0, 1});
    const JointId joint = s.world.addJoint(
        {.kind = JointKind::hinge, .a = box, .anchor = {0.5, 0, 1}, .motor = JointMotor{10, 1e4}, .break_force = 1});
    s.world.step();
    EXPECT_FALSE(s.world.contains(joint));
    EXPECT_GT(s.world.kineticEnergy(), 1);
}

TEST(WorldJoints, BreakAtTheirTorque) {
    Site s;
    const BodyId box = s.box({1, 0, 1});
    const double torque = 10 * s.world.mass(box);
    const JointId strong = s.world.addJoint({.kind = JointKind::fixed, .a = box, .break_torque = 1.1 * torque});
    s.run(3);
    EXPECT_TRUE(s.world.contains(strong));
    s.world.applyTorque(box, Vec3(0, 2 * torque, 0));
    s.run(1);
    EXPECT_FALSE(s.world.contains(strong));
}

TEST(WorldJoints, JointedBodiesTouchOnlyWhereTheyShall) {
    for (const bool collide : {false, true}) {
        Site s;
        const BodyId a = s.box({0, 0, 1});
        const BodyId b = s.box({0.15, 0, 1});
        s.world.addJoint({.a = a, .b = b, .anchor = Vec3(0.1, 0, 1), .collide = collide});
        s.run(1);
        EXPECT_EQ(s.world.contacts().empty(), !collide);
    }
}

TEST(WorldJoints, SleepAndWakeTogether) {
    Site s;
    const BodyId a = s.box({0, 0, 1});
    const BodyId b = s.box({0, 0, 0.5});
    s.world.addJoint({.a = a, .anchor = Vec3(0, 0, 1.2)});
    s.world.addJoint({.a = b, .b = a, .anchor = Vec3(0, 0, 0.75)});
    s.run(1);
    ASSERT_FALSE(s.world.isAsleep(a) || s.world.isAsleep(b));
    for (int i = 0; i < 500; ++i) {
        s.run(1);
        ASSERT_EQ(s.world.isAsleep(a), s.world.isAsleep(b)) << "step " << i;
    }
    EXPECT_TRUE(s.world.isAsleep(a) && s.world.isAsleep(b)) << "joints bear them";
    const std::uint64_t state = s.world.stateHash();
    s.run(100);
    EXPECT_EQ(s.world.stateHash(), state) << "asleep, nothing changes";
    s.world.setEventLevel(EventLevel::changes);
    s.world.applyImpulse(b, Vec3(1, 0, 0));
    s.run(1);
    EXPECT_FALSE(s.world.isAsleep(a) || s.world.isAsleep(b));
    std::set<BodyId> woke;
    for (const Event& event : s.world.events()) {
        EXPECT_NE(event.kind, EventKind::fell_asleep);
        if (event.kind == EventKind::woke) woke.insert(event.a);
    }
    EXPECT_EQ(woke, (std::set<BodyId>{a, b}));
    s.run(3000);
    EXPECT_EQ(s.world.isAsleep(a), s.world.isAsleep(b));
}

class JointedSleepers : public testing::TestWithParam<Preset> {};

TEST_P(JointedSleepers, SleepOnInSilence) {
    Site s(Settings::preset(GetParam()));
    s.world.addBody({.shape = HalfSpace{}, .material = s.oak, .fixed = true});
    const BodyId a = s.box({0, 0, 0.1});
    const BodyId b = s.box({0.25, 0, 0.1});
    const BodyId lamp = s.box({0, 5, 1});
    s.world.addJoint({.kind = JointKind::hinge, .a = a, .b = b, .anchor = Vec3(0.125, 0, 0.1)});
    const JointId hook = s.world.addJoint({.kind = JointKind::ball, .a = lamp, .anchor = Vec3(0, 5, 1.2)});
    s.run(1000);
    ASSERT_EQ(s.world.statistics().asleep, 3);
    const Vec3 impulse = s.world.joint(hook).impulse;
    const double part = 1 - s.world.settings().sleep.damping;
    EXPECT_GE(impulse.z(), 0.99 * part * 6.4 * 10 * s.world.settings().timeStep()) << "bears the lamp";
    s.world.setEventLevel(EventLevel::changes);
    for (int i = 0; i < 20; ++i) {
        s.run(1);
        EXPECT_EQ(s.world.statistics().asleep, 3);
        EXPECT_EQ(s.world.statistics().woken, 0);
        EXPECT_TRUE(s.world.events().empty());
        EXPECT_EQ(s.world.joint(hook).impulse, impulse) << "and goes on to";
    }
    s.world.applyImpulse(b, Vec3(0, 0, 5));
    s.run(1);
    EXPECT_EQ(s.world.statistics().woken, 2);
}

/// A small ball that rolls over heavy sleeping boxes, of which a joint ties two, wakes none.
TEST(WorldJoints, DoNotWakeTheirPile) {
    Site s;
    s.world.addBody({.shape = HalfSpace{}, .material = s.oak, .fixed = true});
    std::vector<BodyId> boxes;
    for (int i = 0; i < 10; ++i) boxes.push_back(s.box({0.2 * i, 0, 0.1}));
    s.world.addJoint({.kind = JointKind::hinge, .a = boxes[6], .b = boxes[7], .anchor = Vec3(1.3, 0, 0.1)});
    s.run(1000);
    ASSERT_EQ(s.world.statistics().asleep, 10);
    s.world.addBody({.shape = Sphere{0.01},
                     .material = s.oak,
                     .pose = {Vec3(0.7, 0, 0.21), Quat::Identity()},
                     .linear_velocity = Vec3(0.5, 0, 0),
                     .angular_velocity = Vec3(0, 50, 0)});
    for (int i = 0; i < 240; ++i) {
        s.run(1);
        ASSERT_EQ(s.world.statistics().woken, 0) << "step " << i;
        ASSERT_EQ(s.world.statistics().largest_batch, s.world.statistics().contacts) << "all in one batch";
    }
}

INSTANTIATE_TEST_SUITE_P(Presets, JointedSleepers,
                         testing::Values(Preset::performance, Preset::accuracy, Preset::thesis),
                         [](const auto& test) { return std::string(nameOf(test.param)); });

TEST(WorldJoints, ARemovedOneLetsItsSleepingBodiesFall) {
    Site s;
    const BodyId a = s.box({0, 0, 1});
    const JointId joint = s.world.addJoint({.kind = JointKind::fixed, .a = a});
    s.run(500);
    ASSERT_TRUE(s.world.isAsleep(a));
    s.world.removeJoint(joint);
    s.run(60);
    EXPECT_LT(s.world.pose(a).position.z(), 0.9);
}

TEST(WorldJoints, ASlowMotorDoesNotFallAsleep) {
    Site s;
    const BodyId a = s.box({0, 0, 1});
    const JointId joint =
        s.world.addJoint({.kind = JointKind::hinge, .a = a, .anchor = Vec3(0, 0, 1), .motor = JointMotor{1e-3, 100}});
    s.run(2400);
    EXPECT_NEAR(s.world.joint(joint).position, 0.01, 1e-5);
}

TEST(WorldJoints, BodiesPutSomewhereElseComeBackSlowly) {
    Site s;
    s.world.setGravity(Vec3::Zero());
    const BodyId a = s.box({0, 0, 1});
    const JointId joint = s.world.addJoint({.a = a, .anchor = Vec3(0, 0, 1)});
    s.world.setPose(a, {Vec3(0.5, 0, 1), Quat::Identity()});
    s.run(1);
    EXPECT_NEAR(s.world.joint(joint).error, 0.4, 1e-9);
    s.run(100);
    EXPECT_LE(s.world.joint(joint).error, 1e-9);
    EXPECT_LE(s.world.linearVelocity(a).norm(), 1e-6) << "without gaining speed";
}

/// Chains, wheels and a bridge over boxes: everything at once.
void build(Site& s) {
    s.world.addBody({.shape = HalfSpace{}, .material = s.oak, .fixed = true});
    for (int row = 0; row < 6; ++row) {
        std::optional<BodyId> last;
        for (int i = 0; i < 6; ++i) {
            const Vec3 place(0.25 * i, row, 1.5);
            const BodyId body = s.box(place);
            const auto kind = static_cast<JointKind>((row + i) % 6);
            JointDescription d{.kind = kind, .a = body, .b = last, .anchor = place - Vec3(0.125, 0, 0)};
            if (kind == JointKind::distance || kind == JointKind::rope) d.anchor_b = place - Vec3(0.25, 0, -0.1);
            if (kind == JointKind::hinge) d.axis = Vec3::UnitY();
            if (kind == JointKind::slider) d.axis = Vec3::UnitX();
            if (kind == JointKind::hinge || kind == JointKind::slider) {
                d.lower = -0.4;
                d.upper = 0.4;
                d.motor = JointMotor{1, 3};
            }
            if (row == 3) d.break_force = 300;
            s.world.addJoint(d);
            last = body;
            s.box(Vec3(0.25 * i, row, 0.1 + 0.2 * (i % 3)));
        }
    }
}

std::vector<std::uint64_t> hashes(World& world, int steps) {
    std::vector<std::uint64_t> result;
    for (int i = 0; i < steps; ++i) {
        world.step();
        result.push_back(world.stateHash());
    }
    return result;
}

class JointsOf : public ::testing::TestWithParam<ResolutionKind> {
  protected:
    Settings settings(std::int64_t threads = 1) const {
        Settings result = Settings::preset(Preset::performance);
        result.resolution.resolution = GetParam();
        result.parallel = {threads, true};
        return result;
    }
};
INSTANTIATE_TEST_SUITE_P(Resolutions, JointsOf,
                         ::testing::Values(ResolutionKind::impulse_queue, ResolutionKind::sweep,
                                           ResolutionKind::accelerated_sweeps));

TEST_P(JointsOf, AreBitIdenticalOnAnyNumberOfThreads) {
    Site one(settings());
    build(one);
    const auto expected = hashes(one.world, 300);
    for (const std::int64_t threads : {2, 5}) {
        Site other(settings(threads));
        build(other);
        EXPECT_EQ(hashes(other.world, 300), expected) << threads;
    }
}

TEST_P(JointsOf, GoOnFromASnapshotBitByBit) {
    Site s(settings());
    build(s);
    s.world.setEventLevel(EventLevel::all);
    s.run(60);
    World copy = World::restore(s.world.save());
    EXPECT_EQ(copy.joints(), s.world.joints());
    EXPECT_EQ(copy.save(), s.world.save());
    EXPECT_EQ(hashes(copy, 200), hashes(s.world, 200));
}

TEST_P(JointsOf, HoldInAPileAndKeepItsChecks) {
    Site s(settings());
    build(s);
    s.world.setChecks(Checks::on);
    s.run(600);
    EXPECT_GE(s.world.joints().size(), 30U) << "only those of one row may break";
    EXPECT_FALSE(s.world.contacts().empty());
    for (const JointId id : s.world.joints()) {
        const JointInfo joint = s.world.joint(id);
        EXPECT_LE(joint.error, 5e-3) << id.index;
    }
    EXPECT_TRUE(s.world.faults().empty());
}

}  // namespace
}  // namespace cairn
