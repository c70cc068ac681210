/// Joints against closed forms: pendulums, ropes, motors, limits, and what they pass on.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "joint_testing.h"

namespace cairn {
namespace {

constexpr double earth_gravity = mechanics::joint_gravity;

Settings precise(ResolutionKind resolution = ResolutionKind::impulse_queue) {
    Settings settings = mechanics::undamped();
    settings.resolution.resolution = resolution;
    return settings;
}

struct Workshop : mechanics::JointBench {
    explicit Workshop(const Vec3& gravity = Vec3(0, 0, -earth_gravity), const Settings& settings = precise())
        : JointBench(gravity, settings) {}
    BodyId add(const Shape& shape, double mass, const Vec3& place, const Vec3& v = Vec3::Zero(),
               const Vec3& w = Vec3::Zero()) {
        const BodyId body = JointBench::add(shape, mass, place);
        world.setLinearVelocity(body, v);
        world.setAngularVelocity(body, w);
        return body;
    }
};

/// The period of a pendulum of length l in small and large swings. @param amplitude [rad]
double period(double length, double amplitude) {
    // Gauss: 2π·√(l/g) over the arithmetic–geometric mean of 1 and cos(θ/2).
    double a = 1;
    double b = std::cos(amplitude / 2);
    for (int i = 0; i < 10; ++i) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    return 2 * std::numbers::pi * std::sqrt(length / earth_gravity) / a;
}

/// Moments at which a value goes through zero upwards, between steps by interpolation.
template <class Value>
double measuredPeriod(World& world, int periods, const Value& value) {
    double first = 0;
    double last = 0;
    int crossings = -1;
    double before = value();
    while (crossings < periods) {
        world.step();
        const double now = value();
        if (before < 0 && now >= 0) {
            last = world.time() - now / (now - before) * world.settings().timeStep();
            if (++crossings == 0) first = last;
        }
        before = now;
    }
    return (last - first) / periods;
}

class EveryResolution : public ::testing::TestWithParam<ResolutionKind> {};
INSTANTIATE_TEST_SUITE_P(Joints, EveryResolution,
                         ::testing::Values(ResolutionKind::impulse_queue, ResolutionKind::sweep,
                                           ResolutionKind::accelerated_sweeps));

TEST_P(EveryResolution, ABallOnARodSwingsWithThePeriodOfAPendulum) {
    Workshop w(Vec3(0, 0, -earth_gravity), precise(GetParam()));
    const double amplitude = 1;
    const Vec3 place(std::sin(amplitude), 0, -std::cos(amplitude));
    const BodyId ball = w.add(Sphere{1e-3}, 2, place);
    const JointId rod =
        w.world.addJoint({.kind = JointKind::distance, .a = ball, .anchor = place, .anchor_b = Vec3::Zero()});
    const double before = w.energy();
    double largest = 0;
    const double found = measuredPeriod(w.world, 10, [&] {
        largest = std::max(largest, w.world.joint(rod).error);
        return w.world.pose(ball).position.x();
    });
    EXPECT_NEAR(found, period(1, amplitude), 2e-6 * found);
    EXPECT_LE(largest, 1e-9);
    EXPECT_NEAR(w.energy(), before, 1e-5 * 2 * earth_gravity);
}

TEST_P(EveryResolution, ARodOnAHingeSwingsAsACompoundPendulum) {
    Workshop w(Vec3(0, 0, -earth_gravity), precise(GetParam()));
    const Box rod{{0.02, 0.02, 1}};
    const BodyId body = w.add(rod, 1, Vec3(0, 0, -0.5), Vec3(0.15, 0, 0), Vec3(0, -0.3, 0));
    const JointId hinge = w.world.addJoint({.kind = JointKind::hinge, .a = body, .axis = Vec3::UnitY()});
    // About its end: I = m·l²/4 + m·(l² + d²)/12, reduced length I/(m·l/2).
    const double inertia = 0.25 + (1 + 0.02 * 0.02) / 12;
    const double amplitude = 2 * std::asin(0.3 * std::sqrt(inertia / (2 * earth_gravity)));
    const double found = measuredPeriod(w.world, 10, [&] { return w.world.joint(hinge).position; });
    EXPECT_NEAR(found, period(inertia / 0.5, amplitude), 1e-5 * found);
    EXPECT_LE(w.world.joint(hinge).error, 1e-9);
}

TEST_P(EveryResolution, AHangingChainPullsWithItsWeight) {
    Workshop w(Vec3(0, 0, -earth_gravity), precise(GetParam()));
    std::vector<JointId> joints;
    std::optional<BodyId> above;
    for (int i = 0; i < 20; ++i) {
        const BodyId link = w.add(Capsule{0.02, 0.1}, i == 19 ? 100 : 1, Vec3(0, 0, -0.05 - 0.1 * i));
        joints.push_back(
            w.world.addJoint({.kind = JointKind::ball, .a = link, .b = above, .anchor = Vec3(0, 0, -0.1 * i)}));
        above = link;
    }
    w.run(0.5);
    for (int i = 0; i < 20; ++i) {
        const JointInfo joint = w.world.joint(joints[static_cast<std::size_t>(i)]);
        const double weight = (100 + 19 - i) * earth_gravity;
        EXPECT_NEAR(joint.force.z(), weight, 1e-9 * weight) << i;
        EXPECT_LE(joint.error, 1e-11);
    }
}

TEST_P(EveryResolution, AFixedJointPassesForceAndTorque) {
    Workshop w(Vec3(0, 0, -earth_gravity), precise(GetParam()));
    const BodyId arm = w.add(Box{{1, 0.1, 0.1}}, 3, Vec3(0.5, 0, 0));
    const BodyId load = w.add(Sphere{0.1}, 5, Vec3(2, 0, 0));
    const JointId wall = w.world.addJoint({.kind = JointKind::fixed, .a = arm});
    const JointId weld = w.world.addJoint({.kind = JointKind::fixed, .a = load, .b = arm, .anchor = Vec3(1, 0, 0)});
    w.run(1);
    EXPECT_NEAR(w.world.joint(wall).force.z(), 8 * earth_gravity, 1e-9);
    EXPECT_NEAR(w.world.joint(wall).torque.y(), -(3 * 0.5 + 5 * 2) * earth_gravity, 1e-8);
    EXPECT_NEAR(w.world.joint(weld).force.z(), 5 * earth_gravity, 1e-9);
    EXPECT_NEAR(w.world.joint(weld).torque.y(), -5 * earth_gravity, 1e-8);
    EXPECT_LE((w.world.pose(load).position - Vec3(2, 0, 0)).norm(), 1e-9);
}

TEST_P(EveryResolution, AMotorReachesItsSpeedWithItsTorque) {
    Workshop w(Vec3::Zero(), precise(GetParam()));
    const BodyId wheel = w.add(Cylinder{0.2, 0.1}, 10, Vec3::Zero());
    const JointId hinge = w.world.addJoint({.kind = JointKind::hinge, .a = wheel, .motor = JointMotor{20, 4}});
    const double inertia = 0.5 * 10 * 0.2 * 0.2;
    w.run(0.5);
    EXPECT_NEAR(w.world.joint(hinge).speed, 0.5 * 4 / inertia, 1e-9) << "all it can give";
    EXPECT_NEAR(w.world.joint(hinge).torque.z(), 4, 1e-9);
    w.run(1);
    EXPECT_NEAR(w.world.joint(hinge).speed, 20, 1e-9);
    EXPECT_NEAR(w.world.joint(hinge).torque.z(), 0, 1e-9);
    w.world.setJointMotor(hinge, {0, 1});
    w.run(0.5);
    EXPECT_NEAR(w.world.joint(hinge).speed, 20 - 0.5 / inertia, 1e-9) << "a brake";
}

TEST_P(EveryResolution, ASliderFallsToItsLimitAndStaysThere) {
    Workshop w(Vec3(0, 0, -earth_gravity), precise(GetParam()));
    const Vec3 axis = Vec3(1, 0, 1).normalized();
    const BodyId lift = w.add(Box{{0.1, 0.2, 0.3}}, 4, Vec3::Zero());
    const JointId slider =
        w.world.addJoint({.kind = JointKind::slider, .a = lift, .axis = axis, .lower = -0.5, .upper = 1});
    w.run(0.25);
    const double fallen = 0.5 * earth_gravity / std::sqrt(2) * 0.25 * 0.25;
    EXPECT_NEAR(w.world.joint(slider).position, -fallen, 1e-9);
    EXPECT_NEAR(w.world.joint(slider).force.dot(axis), 0, 1e-9);
    w.run(2);
    EXPECT_NEAR(w.world.joint(slider).position, -0.5, 1e-9);
    EXPECT_NEAR(w.world.joint(slider).force.z(), 4 * earth_gravity, 1e-6) << "the limit bears the weight";
    EXPECT_LE((w.world.pose(lift).position + 0.5 * axis).norm(), 1e-8);
    EXPECT_LE(w.world.pose(lift).orientation.angularDistance(Quat::Identity()), 1e-8);
}

TEST_P(EveryResolution, AHingeStopsAtItsLimit) {
    Workshop w(Vec3(0, 0, -earth_gravity), precise(GetParam()));
    const BodyId trapdoor = w.add(Box{{1, 1, 0.05}}, 10, Vec3(0.5, 0, 0));
    const JointId hinge =
        w.world.addJoint({.kind = JointKind::hinge, .a = trapdoor, .axis = Vec3::UnitY(), .lower = -0.5, .upper = 0.5});
    double beyond = 0;
    for (int i = 0; i < 2000; ++i) {
        w.world.step();
        beyond = std::max(beyond, w.world.joint(hinge).position - 0.5);
    }
    EXPECT_LE(beyond, 1e-9);
    EXPECT_NEAR(w.world.joint(hinge).position, 0.5, 1e-6);
    EXPECT_NEAR(w.world.joint(hinge).torque.y(), -10 * earth_gravity * 0.5 * std::cos(0.5), 1e-3);
}

TEST_P(EveryResolution, ARopeIsSlackUntilItIsTaut) {
    Workshop w(Vec3(0, 0, -earth_gravity), precise(GetParam()));
    const BodyId ball = w.add(Sphere{0.05}, 2, Vec3(0, 0, -0.2));
    const JointId rope = w.world.addJoint(
        {.kind = JointKind::rope, .a = ball, .anchor = Vec3(0, 0, -0.2), .anchor_b = Vec3::Zero(), .length = 1});
    w.run(0.3);
    EXPECT_NEAR(w.world.pose(ball).position.z(), -0.2 - 0.5 * earth_gravity * 0.09, 1e-9);
    EXPECT_TRUE(w.world.joint(rope).impulse.isZero(0));
    w.run(1);
    EXPECT_NEAR(w.world.joint(rope).position, 1, 1e-9);
    EXPECT_NEAR(w.world.joint(rope).force.z(), 2 * earth_gravity, 1e-6);
}

TEST_P(EveryResolution, JointedBodiesKeepTheirMomentum) {
    Workshop w(Vec3::Zero(), precise(GetParam()));
    std::optional<BodyId> last;
    for (int i = 0; i < 6; ++i) {
        const Vec3 place(0.3 * i, 0, 0);
        const BodyId body = w.add(Box{{0.2, 0.1, 0.05}}, 1 + i, place, Vec3(0.1 * i, -i, 1), Vec3(1, 2 * i, 3));
        if (last) {
            const auto kind = i % 2 == 0 ? JointKind::ball : JointKind::hinge;
            w.world.addJoint({.kind = kind, .a = body, .b = last, .anchor = place - Vec3(0.15, 0, 0)});
        }
        last = body;
    }
    const Vec3 linear = w.world.linearMomentum();
    const Vec3 angular = w.world.angularMomentum();
    w.run(2);
    EXPECT_LE((w.world.linearMomentum() - linear).norm(), 1e-11 * linear.norm());
    EXPECT_LE((w.world.angularMomentum() - angular).norm(), 1e-8 * angular.norm());
    EXPECT_GT((w.world.pose(*last).position - Vec3(1.5, 0, 0)).norm(), 0.5) << "the last one moved";
    for (const JointId joint : w.world.joints()) EXPECT_LE(w.world.joint(joint).error, 1e-8);
}

TEST_P(EveryResolution, ABallStruckOnAHingeAnswersWithItsReducedMass) {
    // A free ball of mass m hits the end of a rod on a hinge elastically: reduced mass I/l² = M/3.
    Workshop w(Vec3::Zero(), precise(GetParam()));
    const BodyId rod = w.add(Box{{0.1, 0.1, 1}}, 3, Vec3(0, 0, -0.5));
    w.world.addJoint({.kind = JointKind::hinge, .a = rod, .axis = Vec3::UnitY()});
    const double inertia = 3 * (0.25 + (1 + 0.01) / 12);
    const BodyId ball = w.add(Sphere{0.1}, 2, Vec3(-0.2, 0, -0.9), Vec3(1, 0, 0));
    const double before = w.energy();
    w.run(0.2);
    const double reduced = inertia / (0.9 * 0.9);
    EXPECT_NEAR(w.world.linearVelocity(ball).x(), (2 - reduced) / (2 + reduced), 2e-3);
    EXPECT_NEAR(w.energy(), before, 1e-9);
}

TEST(Joints, AClosedLoopMovesThoughItsRowsAreMoreThanItsBodiesCanDo) {
    // A parallelogram of three bars and four hinges with parallel axes: 20 rows for 18 ways to move.
    Workshop w;
    const BodyId left = w.add(Box{{0.05, 0.05, 1}}, 1, Vec3(0, 0, -0.5));
    const BodyId right = w.add(Box{{0.05, 0.05, 1}}, 1, Vec3(1, 0, -0.5));
    const BodyId bar = w.add(Box{{1, 0.05, 0.05}}, 1, Vec3(0.5, 0, -1));
    const auto hinge = [&](BodyId a, std::optional<BodyId> b, const Vec3& anchor) {
        return w.world.addJoint({.kind = JointKind::hinge, .a = a, .b = b, .anchor = anchor, .axis = Vec3::UnitY()});
    };
    const JointId joint = hinge(left, {}, Vec3(0, 0, 0));
    hinge(right, {}, Vec3(1, 0, 0));
    hinge(bar, left, Vec3(0, 0, -1));
    hinge(bar, right, Vec3(1, 0, -1));
    for (const BodyId body : {left, right}) {
        w.world.setAngularVelocity(body, Vec3(0, -1, 0));
        w.world.setLinearVelocity(body, Vec3(0.5, 0, 0));
    }
    w.world.setLinearVelocity(bar, Vec3(1, 0, 0));
    // Both swinging bars and the one that they carry: I = 2·(l²/3 + d²/12) + l², moment of weight (2·½ +
    // 1)·earth_gravity·sin θ.
    const double inertia = 2 * (0.25 + (1 + 0.0025) / 12) + 1;
    const double amplitude = 2 * std::asin(std::sqrt(inertia / (4 * 2 * earth_gravity)));
    const double before = w.energy();
    const double found = measuredPeriod(w.world, 5, [&] { return w.world.joint(joint).position; });
    EXPECT_NEAR(found, period(inertia / 2, amplitude), 1e-5 * found);
    EXPECT_NEAR(w.energy(), before, 1e-5);
    for (const JointId each : w.world.joints()) EXPECT_LE(w.world.joint(each).error, 1e-9);
    EXPECT_NEAR(w.world.pose(bar).orientation.angularDistance(Quat::Identity()), 0, 1e-7);
}

/// What a hinge keeps from moving in all directions but one cannot bounce and stop its sliding at once.
TEST(Joints, AHingedBallBouncesWithItsRestitutionHoweverAskewItStrikes) {
    for (const ResolutionKind resolution : {ResolutionKind::impulse_queue, ResolutionKind::sweep}) {
        for (const double angle : {0.0, 0.5, 1.0, 1.4}) {
            Workshop shop(Vec3::Zero(), precise(resolution));
            shop.world.setDefaultPairProperties({0.5, 0.3, 0.3});
            const BodyId ball = shop.add(Sphere{0.1}, 1, Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
            shop.world.addJoint({.kind = JointKind::hinge, .a = ball, .anchor = Vec3::Zero(), .axis = Vec3::UnitZ()});
            const Vec3 to_other(std::sin(angle), std::cos(angle), 0);
            shop.world.addBody({.shape = Sphere{0.1},
                                .material = shop.steel,
                                .pose = {Vec3(1, 0, 0) + 0.2001 * to_other, Quat::Identity()},
                                .fixed = true});
            shop.run(0.01);
            EXPECT_NEAR(shop.world.angularVelocity(ball).z(), -0.5, 1e-6) << angle;
        }
    }
}

TEST(Joints, BallsOnHingesBetweenCradleRodsKeepTheirEnergyForALongTime) {
    Settings settings = precise();
    settings.correction.correction = CorrectionKind::none;
    Workshop w(Vec3(0, 0, -earth_gravity), settings);
    const double radius = 0.05;
    const double length = 1;
    std::vector<BodyId> balls;
    for (int i = 0; i < 3; ++i) {
        const double angle = i == 0 ? -0.3 : 0;
        const Vec3 pivot(2 * radius * i, 0, 0);
        const Vec3 place = pivot + length * Vec3(std::sin(angle), 0, -std::cos(angle));
        balls.push_back(w.add(Sphere{radius}, 1, place));
        w.world.addJoint({.kind = JointKind::hinge, .a = balls.back(), .anchor = pivot, .axis = Vec3::UnitY()});
    }
    const double before = w.energy() + 3 * earth_gravity * length;
    double worst = 0;
    double farthest = 0;
    for (int i = 0; i < 20 * 2 * 960; ++i) {
        w.world.step();
        worst = std::max(worst, std::abs(w.energy() + 3 * earth_gravity * length - before));
        farthest = std::max(farthest, w.world.pose(balls[2]).position.x() - 4 * radius);
    }
    EXPECT_LE(worst, 2e-4 * before);
    EXPECT_NEAR(farthest, length * std::sin(0.3), 0.01) << "the last ball swings as far as the first";
}

}  // namespace
}  // namespace cairn
