/// What acts along the free axes of joints, against closed forms.
#include <gtest/gtest.h>

#include <numbers>

#include "joint_testing.h"

namespace cairn {
namespace {

using mechanics::joint_gravity;
using mechanics::JointBench;
using mechanics::undamped;

const Box block{{0.2, 0.2, 0.2}};

/// On a slider along x.
JointDescription sliding(BodyId body) {
    return {.kind = JointKind::slider, .a = body, .axis = Vec3::UnitX()};
}

/// A body of 2 kg on such a slider, which the test describes further, with a speed.
struct Sliding : JointBench {
    BodyId body = add(block, 2, Vec3::Zero());
    JointId joint;

    explicit Sliding(JointDescription d, double speed = 0) {
        const JointDescription slider = sliding(body);
        d.kind = slider.kind;
        d.a = slider.a;
        d.axis = slider.axis;
        joint = world.addJoint(d);
        world.setLinearVelocity(body, Vec3(speed, 0, 0));
    }
};

TEST(JointAxes, ASpringOscillatesAsItsImplicitStepSays) {
    Sliding bench({.spring = JointSpring{.stiffness = 50, .rest = 0.3}});
    const double h = bench.step();
    double x = 0;
    double v = 0;
    for (int i = 0; i < 2000; ++i) {
        bench.world.step();
        x += h * v;
        v = (v - h * 25 * (x - 0.3)) / (1 + h * h * 25);
        ASSERT_NEAR(bench.world.joint(bench.joint).position, x, 1e-12) << i;
    }
    // Period 2π·√(m/k), and the implicit step takes ω²h/2 of the amplitude per time.
    const double decay = std::exp(-25 * h / 2 * bench.world.time());
    EXPECT_NEAR(x, 0.3 - 0.3 * decay * std::cos(5 * bench.world.time()), 2e-3);
}

TEST(JointAxes, ADamperSlowsExponentially) {
    Sliding bench({.damping = 3}, 1);
    bench.run(1);
    EXPECT_NEAR(bench.world.joint(bench.joint).speed, std::pow(1 + 1.5 * bench.step(), -960), 1e-12);
    EXPECT_NEAR(bench.world.joint(bench.joint).speed, std::exp(-1.5), 1e-3);
}

TEST(JointAxes, DryFrictionStopsAndHolds) {
    Sliding bench({.friction = 4}, 1);
    bench.run(0.25);
    EXPECT_NEAR(bench.world.joint(bench.joint).speed, 0.5, 1e-12) << "v − F·t/m";
    EXPECT_NEAR(bench.world.joint(bench.joint).force.x(), -4, 1e-9);
    bench.run(0.5);
    const double stopped = bench.world.joint(bench.joint).position;
    EXPECT_EQ(bench.world.joint(bench.joint).speed, 0);
    EXPECT_NEAR(stopped, 0.25, 1e-3) << "m·v²/2F";
    bench.world.setConstantForce(bench.body, Vec3(3.9, 0, 0));
    bench.run(0.5);
    EXPECT_NEAR(bench.world.joint(bench.joint).position, stopped, 1e-14) << "less than friction moves nothing";
    bench.world.setConstantForce(bench.body, Vec3(5, 0, 0));
    const double now = bench.world.joint(bench.joint).speed;
    bench.run(0.5);
    EXPECT_NEAR(bench.world.joint(bench.joint).speed, now + 0.5 * 1 / 2, 1e-9) << "(5 − 4)·t/m";
}

/// Error of a critically damped servo's step response x(t) = 1 − (1 + ωt)·exp(−ωt), ω² = k/m, c = 2·m·ω.
double servoError(double steps_per_second) {
    JointBench bench(Vec3::Zero(), undamped(steps_per_second));
    const BodyId body = bench.add(block, 2, Vec3::Zero());
    JointDescription d = sliding(body);
    d.servo = JointServo{.position = 1, .stiffness = 2 * 100, .damping = 2 * 2 * 10};
    const JointId joint = bench.world.addJoint(d);
    double error = 0;
    while (bench.world.time() < 1) {
        bench.world.step();
        const double angle = 10 * bench.world.time();
        error = std::max(error, std::abs(bench.world.joint(joint).position - 1 + (1 + angle) * std::exp(-angle)));
    }
    return error;
}

TEST(JointAxes, AServoAnswersAStepAsItsFormulaSays) {
    const double coarse = servoError(480);
    const double fine = servoError(960);
    EXPECT_LE(fine, 5e-3);
    EXPECT_NEAR(coarse / fine, 2, 0.1) << "of first order in the time step";
}

TEST(JointAxes, AServoIsStableForAnyGain) {
    for (const double gain : {1e3, 1e9, 1e18, 1e30}) {
        for (const double limit : {JointServo::no_limit, 1e6}) {
            JointBench bench(Vec3(0, 0, -joint_gravity), undamped(60));
            const BodyId arm = bench.add(Box{{1, 0.1, 0.1}}, 3, Vec3(0.5, 0, 0));
            const JointId hinge = bench.world.addJoint(
                {.kind = JointKind::hinge,
                 .a = arm,
                 .axis = Vec3::UnitY(),
                 .servo = JointServo{.position = -0.7, .stiffness = gain, .damping = gain / 60, .limit = limit}});
            bench.run(2);
            const double torque = 3 * joint_gravity * 0.5 * std::cos(0.7);
            EXPECT_NEAR(bench.world.joint(hinge).position, -0.7, 2 * torque / gain + 1e-6) << gain;
            EXPECT_NEAR(bench.world.joint(hinge).speed, 0, 1e-6) << gain;
            EXPECT_LE(bench.largestError(), 1e-9);
        }
    }
}

TEST(JointAxes, AServoGivesNoMoreThanItsLimit) {
    Sliding bench({.servo = JointServo{.speed = 5, .damping = 1e9, .limit = 4}});
    bench.run(1);
    EXPECT_NEAR(bench.world.joint(bench.joint).speed, 2, 1e-9) << "F·t/m";
    EXPECT_NEAR(bench.world.joint(bench.joint).force.x(), 4, 1e-9);
    bench.run(2);
    EXPECT_NEAR(bench.world.joint(bench.joint).speed, 5, 1e-6);
}

TEST(JointAxes, SixStiffServosHoldAnArm) {
    JointBench bench(Vec3(0, 0, -joint_gravity), undamped(240));
    std::optional<BodyId> last;
    std::vector<JointId> joints;
    for (int i = 0; i < 6; ++i) {
        const BodyId link = bench.add(Box{{0.3, 0.05, 0.05}}, 2, Vec3(0.15 + 0.3 * i, 0, 0));
        joints.push_back(
            bench.world.addJoint({.kind = JointKind::hinge,
                                  .a = link,
                                  .b = last,
                                  .anchor = Vec3(0.3 * i, 0, 0),
                                  .axis = i % 2 == 0 ? Vec3::UnitY() : Vec3::UnitZ(),
                                  .servo = JointServo{.position = 0.1 * i, .stiffness = 1e12, .damping = 1e9}}));
        last = link;
    }
    bench.run(3);
    for (int i = 0; i < 6; ++i) {
        EXPECT_NEAR(bench.world.joint(joints[static_cast<std::size_t>(i)]).position, 0.1 * i, 1e-8) << i;
    }
    EXPECT_LE(bench.largestError(), 1e-9);
}

TEST(JointAxes, ARotorAddsItsInertia) {
    JointBench bench;
    const BodyId wheel = bench.add(Cylinder{0.2, 0.1}, 10, Vec3::Zero());
    const JointId hinge = bench.world.addJoint(
        {.kind = JointKind::hinge, .a = wheel, .motor = JointMotor{1000, 4}, .rotor_inertia = 1.3});
    bench.run(0.5);
    EXPECT_NEAR(bench.world.joint(hinge).speed, 0.5 * 4 / (0.5 * 10 * 0.04 + 1.3), 1e-9);
    // What a blow gives to the wheel the rotor shares.
    bench.world.setJointMotor(hinge, {});
    const double before = bench.world.joint(hinge).speed;
    bench.world.setConstantTorque(wheel, Vec3(0, 0, 3));
    bench.run(0.5);
    EXPECT_NEAR(bench.world.joint(hinge).speed, before + 0.5 * 3 / 1.5, 1e-9);
}

TEST(JointAxes, APendulumWithARotorSwingsSlower) {
    JointBench bench(Vec3(0, 0, -joint_gravity));
    const BodyId bob = bench.add(Sphere{1e-3}, 2, Vec3(0.02, 0, -1));
    const JointId hinge =
        bench.world.addJoint({.kind = JointKind::hinge, .a = bob, .axis = Vec3::UnitY(), .rotor_inertia = 6});
    // I = m·l² + J, ω² = m·g·l/I; from rest at the angle 0.02 on the other side of the lowest point.
    const double length = std::hypot(0.02, 1);
    const double rate = std::sqrt(2 * joint_gravity * length / (2 * length * length + 6));
    bench.run(std::numbers::pi / rate);
    EXPECT_NEAR(bench.world.joint(hinge).position, 2 * std::atan(0.02), 1e-5);
    EXPECT_NEAR(bench.world.joint(hinge).speed, 0, 1e-3);
}

TEST(JointAxes, ALimitThrowsBackWithItsRestitution) {
    Sliding bench({.lower = -0.5, .upper = 0.5, .restitution = 0.6}, 3);
    bench.run(0.25);
    EXPECT_NEAR(bench.world.joint(bench.joint).speed, -1.8, 1e-12);
    bench.run(0.6);
    EXPECT_NEAR(bench.world.joint(bench.joint).speed, 1.08, 1e-12);
    EXPECT_LE(bench.largestError(), 1e-9);
}

TEST(JointAxes, AHingeCountsItsTurnsAndStopsAfterAsManyAsItMay) {
    JointBench bench;
    const BodyId wheel = bench.add(Cylinder{0.2, 0.1}, 10, Vec3::Zero());
    const double stop = 7 * std::numbers::pi;
    const JointId hinge =
        bench.world.addJoint({.kind = JointKind::hinge, .a = wheel, .upper = stop, .motor = JointMotor{10, 1e3}});
    bench.run(2);
    EXPECT_NEAR(bench.world.joint(hinge).position, 20, 0.1);
    bench.run(1);
    EXPECT_NEAR(bench.world.joint(hinge).position, stop, 1e-9);
    bench.world.setJointMotor(hinge, {-10, 1e3});
    bench.run(10);
    EXPECT_NEAR(bench.world.joint(hinge).position, stop - 100, 0.1);
}

/// Faster than half a turn in a step, where the nearest angle is another one.
TEST(JointAxes, AHingeCountsTheTurnsOfAFastWheelAndItsGear) {
    JointBench bench;
    const BodyId fast = bench.add(Cylinder{0.02, 0.1}, 1, Vec3::Zero());
    const BodyId slow = bench.add(Cylinder{0.2, 0.1}, 10, Vec3(1, 0, 0));
    const JointId pinion = bench.world.addJoint({.kind = JointKind::hinge, .a = fast});
    const JointId wheel = bench.world.addJoint({.kind = JointKind::hinge, .a = slow, .anchor = Vec3(1, 0, 0)});
    const JointId gear =
        bench.world.addJoint({.kind = JointKind::gear, .first = pinion, .second = wheel, .ratio = 0.001});
    const double speed = 1.3 * 2 * std::numbers::pi / bench.step();
    bench.world.setAngularVelocity(fast, Vec3(0, 0, speed));
    bench.world.setAngularVelocity(slow, Vec3(0, 0, -0.001 * speed));
    bench.run(0.5);
    const World resumed = World::restore(bench.world.save());
    EXPECT_EQ(resumed.joint(pinion).position, bench.world.joint(pinion).position);
    bench.run(0.5);
    EXPECT_NEAR(bench.world.joint(pinion).position, speed, 1e-9 * speed);
    EXPECT_NEAR(bench.world.joint(wheel).position, -0.001 * speed, 1e-9 * speed);
    EXPECT_LE(bench.world.joint(gear).error, 1e-9);
}

/// Fifty times as heavy as what it presses against a stop: impulses of an impact are far from those of the next step.
TEST(JointAxes, AHeavyWallThatPressesBouncesOffNoFasterThanItCame) {
    for (const int boxes : {1, 5}) {
        World world(Settings::preset(Preset::performance, 240));
        const MaterialId oak = world.addMaterial({"oak", 800});
        world.setGravity(Vec3(0, 0, -10));
        world.setDefaultPairProperties({.restitution = 0.25, .static_friction = 0.2, .kinetic_friction = 0.2});
        world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true});
        world.addBody({.shape = Box{{0.2, 2, 2}}, .material = oak, .pose = {Vec3(-1, 0, 1)}, .fixed = true});
        for (int i = 0; i < boxes; ++i) {
            world.addBody({.shape = Box{{0.2, 0.2, 0.2}}, .material = oak, .pose = {Vec3(-0.8 + 0.3 * i, 0, 0.1)}});
        }
        const BodyId wall = world.addBody(
            {.shape = Box{{0.1, 2, 2}}, .material = oak, .pose = {Vec3(1.5, 0, 1.001)}, .gravity_factor = 0});
        world.addJoint({.kind = JointKind::slider,
                        .a = wall,
                        .anchor = Vec3(1.5, 0, 1),
                        .axis = -Vec3::UnitX(),
                        .motor = JointMotor{.speed = 0.3, .limit = 400}});
        for (int i = 0; i < 2400; ++i) {
            world.step();
            ASSERT_LT(std::abs(world.linearVelocity(wall).x()), 0.301) << boxes << " boxes, " << i;
        }
        double pressing = 0;
        for (const ContactInfo& contact : world.contacts()) {
            if (contact.a == wall || contact.b == wall) pressing += std::abs(contact.impulse.x()) * 240;
        }
        EXPECT_NEAR(pressing, 400, 40) << boxes << " boxes";
    }
}

TEST(JointAxes, RunOnAfterASnapshotAsIfNothingHappened) {
    const auto make = [](JointBench& bench) {
        std::optional<BodyId> last;
        for (int i = 0; i < 5; ++i) {
            const BodyId link = bench.add(Box{{0.3, 0.05, 0.05}}, 2, Vec3(0.15 + 0.3 * i, 0, 0));
            bench.world.addJoint({.kind = JointKind::hinge,
                                  .a = link,
                                  .b = last,
                                  .anchor = Vec3(0.3 * i, 0, 0),
                                  .axis = Vec3(0.1, 1, 0),
                                  .spring = JointSpring{3, 0.1},
                                  .damping = 0.1,
                                  .friction = 0.2,
                                  .rotor_inertia = 0.05});
            last = link;
        }
    };
    JointBench whole(Vec3(0, 0, -joint_gravity));
    make(whole);
    whole.run(1);
    World resumed = World::restore(whole.world.save());
    EXPECT_EQ(resumed.save(), whole.world.save());
    for (int i = 0; i < 500; ++i) {
        whole.world.step();
        resumed.step();
    }
    EXPECT_EQ(resumed.stateHash(), whole.world.stateHash());
}

}  // namespace
}  // namespace cairn
