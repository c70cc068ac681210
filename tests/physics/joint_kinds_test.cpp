/// Kinds of joints with several free axes, and couplings, against closed forms.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "joint_testing.h"

namespace cairn {
namespace {

using mechanics::joint_gravity;
using mechanics::JointBench;
using mechanics::undamped;

constexpr double pi = std::numbers::pi;

TEST(JointKinds, AUniversalJointTurnsTheSecondShaftUnevenly) {
    // Two shafts at the angle β, the driven one at constant speed: tan θ₁ = cos β·tan θ₂.
    JointBench bench;
    const double bend = 0.6;
    const Vec3 along(std::cos(bend), 0, std::sin(bend));
    const BodyId drive = bench.add(Box{{1, 0.1, 0.1}}, 1, Vec3(-0.5, 0, 0));
    const BodyId follow = bench.add(Box{{1, 0.1, 0.1}}, 1, 0.5 * along, Quat::FromTwoVectors(Vec3::UnitX(), along));
    const JointId first = bench.world.addJoint(
        {.kind = JointKind::hinge, .a = drive, .axis = Vec3::UnitX(), .motor = JointMotor{7, 1e6}});
    const JointId second = bench.world.addJoint({.kind = JointKind::hinge, .a = follow, .axis = along});
    // One pin across each shaft; that of the drive lies in the plane of both shafts.
    const Vec3 pin(0, 0, 1);
    const JointId cross = bench.world.addJoint(
        {.kind = JointKind::universal, .a = follow, .b = drive, .axis = pin, .axis_2 = Vec3::UnitY()});
    bench.world.setAngularVelocity(drive, Vec3(7, 0, 0));
    for (int i = 0; i < 4000; ++i) {
        bench.world.step();
        // The pin of the second shaft begins across the plane of the shafts.
        const double one = bench.world.joint(first).position;
        const double two = bench.world.joint(second).position;
        const double wanted = std::atan2(std::sin(one), std::cos(one) * std::cos(bend));
        ASSERT_NEAR(std::remainder(two - wanted, 2 * pi), 0, 1e-8) << i;
    }
    EXPECT_GT(bench.world.joint(second).position, 9 * pi) << "turns are counted";
    EXPECT_LE(bench.largestError(), 1e-9);
    EXPECT_EQ(bench.world.joint(cross).positions.size(), 2U);
}

TEST(JointKinds, APlanarJointSlidesAndTurnsInItsPlane) {
    const double slope = 0.5;
    const Vec3 normal(-std::sin(slope), 0, std::cos(slope));
    const Vec3 down(-std::cos(slope), 0, -std::sin(slope));
    JointBench bench(Vec3(0, 0, -joint_gravity));
    const BodyId plate = bench.add(Cylinder{0.3, 0.1}, 2, Vec3::Zero(), Quat::FromTwoVectors(Vec3::UnitZ(), normal));
    const JointId joint = bench.world.addJoint({.kind = JointKind::planar, .a = plate, .axis = normal, .axis_2 = down});
    bench.world.setAngularVelocity(plate, 5 * normal);
    bench.run(1);
    const JointInfo info = bench.world.joint(joint);
    EXPECT_NEAR(info.positions[0], 0.5 * joint_gravity * std::sin(slope), 1e-9) << "½·g·sin α·t²";
    EXPECT_NEAR(info.positions[1], 0, 1e-12);
    EXPECT_NEAR(info.positions[2], 5, 1e-9);
    EXPECT_NEAR(info.force.dot(normal), 2 * joint_gravity * std::cos(slope), 1e-8);
    EXPECT_LE(info.error, 1e-11);
}

TEST(JointKinds, ACylindricalJointFallsAndSpinsFreely) {
    JointBench bench(Vec3(0, 0, -joint_gravity));
    const BodyId sleeve = bench.add(Cylinder{0.3, 0.1}, 2, Vec3(0, 0, 1));
    const JointId joint = bench.world.addJoint(
        {.kind = JointKind::cylindrical, .a = sleeve, .axes = {{.lower = -4}, {.friction = 0.01}}});
    bench.world.setAngularVelocity(sleeve, Vec3(0, 0, 20));
    bench.run(0.5);
    const JointInfo info = bench.world.joint(joint);
    EXPECT_NEAR(info.positions[0], -0.5 * joint_gravity * 0.25, 1e-2);
    EXPECT_NEAR(info.speeds[1], 20 - 0.5 * 0.01 / (0.5 * 2 * 0.09), 1e-9);
    bench.run(2);
    EXPECT_NEAR(bench.world.joint(joint).positions[0], -4, 1e-9) << "its limit";
}

TEST(JointKinds, ANutRunsDownItsScrew) {
    // a = g/(1 + I·(2π/p)²/m), one turn per lead p.
    JointBench bench(Vec3(0, 0, -joint_gravity));
    const BodyId nut = bench.add(Cylinder{0.1, 0.05}, 2, Vec3::Zero());
    const JointId joint = bench.world.addJoint({.kind = JointKind::screw, .a = nut, .lead = 0.4});
    bench.run(2);
    const double inertia = 0.5 * 2 * 0.01;
    const double acceleration = joint_gravity / (1 + inertia * std::pow(2 * pi / 0.4, 2) / 2);
    EXPECT_NEAR(bench.world.pose(nut).position.z(), -0.5 * acceleration * 4, 1e-6);
    EXPECT_NEAR(bench.world.joint(joint).position, bench.world.pose(nut).position.z() / 0.4 * 2 * pi, 1e-7);
    EXPECT_LE(bench.largestError(), 1e-10);
    EXPECT_NEAR(bench.energy(), 0, 1e-8);
}

TEST(JointKinds, AGenericJointWithNothingFreeHoldsEverything) {
    JointBench bench(Vec3(0, 0, -joint_gravity));
    const BodyId arm = bench.add(Box{{1, 0.1, 0.1}}, 3, Vec3(0.5, 0, 0));
    const JointId wall = bench.world.addJoint({.kind = JointKind::generic, .a = arm, .axis = Vec3::UnitX()});
    bench.run(1);
    EXPECT_NEAR(bench.world.joint(wall).force.z(), 3 * joint_gravity, 1e-9);
    EXPECT_NEAR(bench.world.joint(wall).torque.y(), -3 * joint_gravity * 0.5, 1e-9);
    EXPECT_LE(bench.largestError(), 1e-11);
}

TEST(JointKinds, AGenericJointTurnsOnAboutAnyOneAxis) {
    for (const JointAlong along : {JointAlong::turn_x, JointAlong::turn_y, JointAlong::turn_z}) {
        JointBench bench;
        const BodyId wheel = bench.add(Box{{0.3, 0.2, 0.1}}, 3, Vec3::Zero());
        const JointId joint = bench.world.addJoint({.kind = JointKind::generic,
                                                    .a = wheel,
                                                    .axis = Vec3::UnitX(),
                                                    .axis_2 = Vec3::UnitY(),
                                                    .axes = {{.along = along, .motor = JointMotor{6, 1e3}}}});
        bench.run(3);
        EXPECT_NEAR(bench.world.joint(joint).position, 18, 0.1);
        EXPECT_LE(bench.largestError(), 1e-9);
    }
}

TEST(JointKinds, ABallStaysInItsConeAndTwist) {
    JointBench bench(Vec3(3, 0, -joint_gravity));
    const BodyId bob = bench.add(Box{{0.1, 0.2, 1}}, 2, Vec3(0, 0, -0.5));
    const JointId ball = bench.world.addJoint(
        {.kind = JointKind::ball, .a = bob, .cone = 0.3, .axes = {{.lower = -0.4, .upper = 0.5}, {}, {}}});
    bench.world.setAngularVelocity(bob, Vec3(0.5, 2, 4));
    double swing = 0;
    double twist = 0;
    for (int i = 0; i < 3000; ++i) {
        bench.world.step();
        const Quat turn = bench.world.pose(bob).orientation;
        swing = std::max(swing, std::acos((turn * Vec3::UnitZ()).z()));
        twist = std::max(twist, std::abs(2 * std::atan2(turn.z(), turn.w())));
        ASSERT_LE(bench.world.joint(ball).error, 1e-8) << i;
    }
    EXPECT_NEAR(swing, 0.3, 1e-6) << "reaches its cone";
    EXPECT_NEAR(twist, 0.5, 1e-6);
}

TEST(JointKinds, ASpringInABallPullsBackTowardsTheRest) {
    JointBench bench;
    const BodyId body = bench.add(Sphere{0.5}, 10, Vec3::Zero());
    const JointAxis spring{.spring = JointSpring{.stiffness = 40}};
    bench.world.addJoint({.kind = JointKind::ball, .a = body, .axes = {spring, spring, spring}});
    bench.world.setAngularVelocity(body, Vec3(0.3, -0.2, 0.1));
    // I = 1 kg·m²: a rotation about one axis, with ω = √40, which the step takes ω²h/2 from.
    const double rate = std::sqrt(40.0);
    bench.run(0.5);
    const Vec3 axis = Vec3(0.3, -0.2, 0.1).normalized();
    const double angle =
        Vec3(0.3, -0.2, 0.1).norm() / rate * std::sin(rate * 0.5) * std::exp(-40 * bench.step() / 2 * 0.5);
    const Eigen::AngleAxisd turned(bench.world.pose(body).orientation);
    EXPECT_NEAR((turned.angle() * turned.axis()).dot(axis), angle, 2e-4);
    EXPECT_NEAR((turned.angle() * turned.axis()).cross(axis).norm(), 0, 1e-12);
}

/// Two wheels on hinges about y.
struct GearTrain {
    JointBench bench;
    BodyId small = bench.add(Cylinder{0.1, 0.1}, 2, Vec3(0, 0, 0));
    BodyId large = bench.add(Cylinder{0.3, 0.1}, 18, Vec3(1, 0, 0));
    JointId first = bench.world.addJoint({.kind = JointKind::hinge, .a = small});
    JointId second = bench.world.addJoint({.kind = JointKind::hinge, .a = large, .anchor = Vec3(1, 0, 0)});
};

TEST(JointKinds, AGearDividesSpeedAndSharesEnergy) {
    GearTrain train;
    World& world = train.bench.world;
    const JointId gear =
        world.addJoint({.kind = JointKind::gear, .first = train.first, .second = train.second, .ratio = 1.0 / 3});
    world.setConstantTorque(train.small, Vec3(0, 0, 0.5));
    train.bench.run(1);
    // I₁ + I₂/9 as seen from the small wheel.
    const double inertia = 0.5 * 2 * 0.01 + 0.5 * 18 * 0.09 / 9;
    const double speed = world.joint(train.first).speed;
    EXPECT_NEAR(speed, 0.5 / inertia, 1e-9);
    EXPECT_NEAR(world.joint(train.second).speed, -speed / 3, 1e-12);
    EXPECT_NEAR(world.kineticEnergy(), 0.5 * inertia * speed * speed, 1e-9);
    EXPECT_NEAR(world.joint(train.second).position, -world.joint(train.first).position / 3, 1e-10);
    EXPECT_LE(world.joint(gear).error, 1e-10);
    world.removeJoint(train.second);
    EXPECT_FALSE(world.contains(gear)) << "nothing is left to couple";
    train.bench.run(0.1);
}

/// What the second axis of a coupling receives, torque or force, is what its inertia takes.
void expectBreaks(JointKind kind, double load, const std::function<JointId(GearTrain&)>& second) {
    for (const double strength : {0.99, 1.01}) {
        GearTrain train;
        World& world = train.bench.world;
        world.setEventLevel(EventLevel::changes);
        JointDescription d{.kind = kind, .first = train.first, .second = second(train), .ratio = 1.0 / 3};
        (kind == JointKind::gear ? d.break_torque : d.break_force) = strength * load;
        const JointId coupling = world.addJoint(d);
        world.setConstantTorque(train.small, Vec3(0, 0, 0.5));
        bool told = false;
        for (int i = 0; i < 20; ++i) {
            world.step();
            for (const Event& event : world.events()) {
                told = told || (event.kind == EventKind::joint_broke && event.joint == coupling);
            }
        }
        EXPECT_EQ(world.contains(coupling), strength > 1);
        EXPECT_EQ(told, strength < 1);
        EXPECT_TRUE(world.contains(train.first) && world.contains(d.second)) << "they go on by themselves";
    }
}

TEST(JointKinds, CouplingsBreakAtWhatTheirSecondAxisReceives) {
    const double inertia_1 = 0.5 * 2 * 0.01, inertia_2 = 0.5 * 18 * 0.09;
    const double turned = 0.5 / (inertia_1 + inertia_2 / 9) / 3 * inertia_2;
    expectBreaks(JointKind::gear, turned, [](GearTrain& train) { return train.second; });
    const double pushed = 0.5 / (inertia_1 + 18.0 / 9) / 3 * 18;
    const auto rail = [](GearTrain& train) {
        train.bench.world.removeJoint(train.second);
        return train.bench.world.addJoint(
            {.kind = JointKind::slider, .a = train.large, .anchor = Vec3(1, 0, 0), .axis = Vec3(1, 0, 0)});
    };
    expectBreaks(JointKind::rack, pushed, rail);
    expectBreaks(JointKind::mimic, pushed, rail);
}

TEST(JointKinds, ARackIsDrivenByItsPinion) {
    JointBench bench;
    const BodyId pinion = bench.add(Cylinder{0.1, 0.1}, 2, Vec3::Zero());
    const BodyId rack = bench.add(Box{{1, 0.05, 0.05}}, 5, Vec3(0, 0.125, 0));
    const JointId hinge = bench.world.addJoint({.kind = JointKind::hinge, .a = pinion, .motor = JointMotor{100, 2}});
    const JointId slider = bench.world.addJoint({.kind = JointKind::slider, .a = rack, .axis = -Vec3::UnitX()});
    bench.world.addJoint({.kind = JointKind::rack, .first = hinge, .second = slider, .ratio = 0.1});
    bench.run(1);
    // m·r² more inertia.
    EXPECT_NEAR(bench.world.joint(hinge).speed, 2 / (0.01 + 5 * 0.01), 1e-9);
    EXPECT_NEAR(bench.world.pose(rack).position.x(), -0.1 * bench.world.joint(hinge).position, 1e-10);
}

TEST(JointKinds, AMimicFollowsALinearLawThroughAMechanism) {
    // The wheels of an arm follow its shoulder, though both hang on bodies that move.
    JointBench bench(Vec3(0, 0, -joint_gravity));
    const BodyId upper = bench.add(Box{{1, 0.1, 0.1}}, 3, Vec3(0.5, 0, 0));
    const BodyId lower = bench.add(Box{{1, 0.1, 0.1}}, 2, Vec3(1.5, 0, 0));
    const JointId shoulder = bench.world.addJoint({.kind = JointKind::hinge, .a = upper, .axis = Vec3::UnitY()});
    const JointId elbow = bench.world.addJoint(
        {.kind = JointKind::hinge, .a = lower, .b = upper, .anchor = Vec3(1, 0, 0), .axis = Vec3::UnitY()});
    const JointId mimic =
        bench.world.addJoint({.kind = JointKind::mimic, .first = shoulder, .second = elbow, .ratio = -2});
    const double before = bench.energy();
    double lowest = 0;
    for (int i = 0; i < 3000; ++i) {
        bench.world.step();
        lowest = std::min(lowest, bench.world.pose(upper).position.z());
        ASSERT_NEAR(bench.world.joint(elbow).position, -2 * bench.world.joint(shoulder).position, 1e-9);
    }
    EXPECT_LE(bench.world.joint(mimic).error, 1e-9);
    EXPECT_NEAR(bench.energy(), before, 1e-4);
    EXPECT_LT(lowest, -0.4) << "it swings";
}

TEST(JointKinds, ABricardLinkageMovesThoughItIsOverconstrained) {
    // Five rods along edges of a cube, the sixth is the world: six hinges, one way to move, 30 conditions for 30.
    JointBench bench(Vec3(0, -joint_gravity, 0));
    const std::array<Vec3, 6> corner = {Vec3(0, 0, 0),  Vec3(1, 0, 0),  Vec3(1, -1, 0),
                                        Vec3(1, -1, 1), Vec3(0, -1, 1), Vec3(0, 0, 1)};
    std::vector<BodyId> rods;
    for (std::size_t i = 0; i < 5; ++i) {
        const Vec3 along = corner[i + 1] - corner[i];
        rods.push_back(bench.add(Box{{1, 0.05, 0.05}}, 1, 0.5 * (corner[i] + corner[i + 1]),
                                 Quat::FromTwoVectors(Vec3::UnitX(), along)));
    }
    const auto hinge = [&](std::size_t rod, std::optional<BodyId> to, std::size_t at) {
        const Vec3 before = corner[at] - corner[(at + 5) % 6];
        const Vec3 after = corner[(at + 1) % 6] - corner[at];
        bench.world.addJoint(
            {.kind = JointKind::hinge, .a = rods[rod], .b = to, .anchor = corner[at], .axis = before.cross(after)});
    };
    for (std::size_t i = 0; i < 5; ++i) hinge(i, i == 0 ? std::nullopt : std::optional(rods[i - 1]), i);
    hinge(4, std::nullopt, 5);
    const double before = bench.energy();
    double farthest = 0;
    double error = 0;
    std::size_t redundant = 0;
    for (int i = 0; i < 5000; ++i) {
        bench.world.step();
        farthest = std::max(farthest, (bench.world.pose(rods[2]).position - Vec3(1, -1, 0.5)).norm());
        if (i % 10 == 0) error = std::max(error, bench.largestError());
    }
    for (const JointId id : bench.world.joints()) redundant += bench.world.joint(id).redundant;
    EXPECT_GT(farthest, 0.5) << "it moves";
    EXPECT_EQ(redundant, 1U);
    EXPECT_LE(error, 1e-9);
    EXPECT_NEAR(bench.energy(), before, 1e-3);
}

TEST(JointKinds, AChainOfAHundredHoldsUnderAThousandTimesItsWeight) {
    JointBench bench(Vec3(0, 0, -joint_gravity));
    std::optional<BodyId> above;
    for (int i = 0; i < 100; ++i) {
        const BodyId link = bench.add(Capsule{0.02, 0.06}, i == 99 ? 1000 : 1, Vec3(0, 0, -0.05 - 0.1 * i));
        const JointKind kind = i % 3 == 0 ? JointKind::ball : i % 3 == 1 ? JointKind::universal : JointKind::hinge;
        bench.world.addJoint(
            {.kind = kind, .a = link, .b = above, .anchor = Vec3(0, 0, -0.1 * i), .axis = Vec3::UnitY()});
        above = link;
    }
    bench.world.setLinearVelocity(*above, Vec3(0.01, 0.02, 0));
    double error = 0;
    for (int i = 0; i < 960; ++i) {
        bench.world.step();
        if (i % 8 == 0) error = std::max(error, bench.largestError());
    }
    EXPECT_LE(error, 1e-9);
}

}  // namespace
}  // namespace cairn
