/// Joints in scene files.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene_testing.h"

namespace cairn {
namespace {

using testing::parseMessage;
using testing::sceneText;

/// A scene whose body 0 is fixed and whose bodies 1 and 2 move, with one joint.
std::string withJoint(const std::string& joint) {
    return sceneText(R"(,"joints":[)" + joint + "]");
}

TEST(SceneJoints, AreWrittenAndReadExactly) {
    Scene scene = parseScene(sceneText(), "test");
    scene.joints.reserve(6);
    const auto add = [&](JointKind kind) -> JointDescription& {
        scene.joints.push_back({1, 2, {.kind = kind, .anchor = Vec3(1.0 / 3, 0, -2)}});
        return scene.joints.back().joint;
    };
    add(JointKind::distance).anchor_b = Vec3(1, 2, 3);
    JointDescription& rope = add(JointKind::rope);
    rope.anchor_b = Vec3::Zero();
    rope.length = 7.0 / 3;
    add(JointKind::ball).break_force = 12.5;
    JointDescription& hinge = add(JointKind::hinge);
    hinge.axis = Vec3(0, 1, 1);
    hinge.lower = -0.5;
    hinge.upper = 1.0 / 7;
    hinge.motor = JointMotor{-2, 30};
    hinge.break_torque = 4;
    JointDescription& slider = add(JointKind::slider);
    slider.axis = Vec3(1, 0, 0);
    slider.upper = 2;
    slider.collide = true;
    add(JointKind::fixed);
    scene.joints.back().b.reset();
    const std::string text = formatScene(scene);
    const Scene read = parseScene(text, "test");
    EXPECT_EQ(formatScene(read), text);
    ASSERT_EQ(read.joints.size(), 6U);
    EXPECT_EQ(read.joints[3].joint.upper, hinge.upper);
    EXPECT_EQ(read.joints[1].joint.length, rope.length);
    EXPECT_TRUE(std::isinf(read.joints[1].joint.break_force));
    EXPECT_FALSE(read.joints[5].b);
}

TEST(SceneJoints, OfAllKindsWithAllThatActsOnThemAreWrittenAndReadExactly) {
    Scene scene = parseScene(sceneText(), "test");
    const JointAxis rich{.along = JointAlong::turn_y,
                         .lower = -9.5,
                         .upper = 1.0 / 7,
                         .restitution = 0.5,
                         .servo = JointServo{1, 2, 3, 4, 5},
                         .spring = JointSpring{6, -0.5},
                         .damping = 7,
                         .friction = 8,
                         .rotor_inertia = 9};
    const JointAxis driven{.along = JointAlong::z, .motor = JointMotor{1, 2}};
    const auto add = [&](JointDescription joint) { scene.joints.push_back({1, 2, std::move(joint)}); };
    add({.kind = JointKind::hinge, .axis = {1, 0, 0}, .servo = JointServo{.stiffness = 1e30}, .friction = 2});
    add({.kind = JointKind::screw, .axis = {1, 0, 0}, .lead = 0.1, .spring = JointSpring{3, 0}, .rotor_inertia = 1});
    add({.kind = JointKind::universal, .axis = {1, 0, 0}, .axis_2 = Vec3(0, 1, 0), .axes = {{}, {.damping = 1}}});
    add({.kind = JointKind::planar, .axis = {1, 0, 0}, .axes = {{}, {}, {.friction = 1}}, .break_torque = 2});
    add({.kind = JointKind::cylindrical, .axis = {1, 0, 0}});
    add({.kind = JointKind::generic, .axis = {1, 0, 0}, .axis_2 = Vec3(0, 1, 0), .axes = {rich, driven}});
    add({.kind = JointKind::ball, .cone = 0.5, .axes = {{.lower = -1}, {}, {.spring = JointSpring{1, 0}}}});
    const auto couple = [&](JointKind kind, std::size_t first, std::size_t second, std::size_t second_axis) {
        JointDescription joint{.kind = kind, .second_axis = second_axis, .ratio = 1.0 / 3};
        (kind == JointKind::rack ? joint.break_force : joint.break_torque) = 1e3;
        scene.joints.push_back({.a = 0, .b = {}, .joint = joint, .first = first, .second = second});
    };
    couple(JointKind::gear, 0, 1, 0);
    couple(JointKind::rack, 0, 4, 0);
    couple(JointKind::mimic, 4, 4, 1);
    const std::string text = formatScene(scene);
    const Scene read = parseScene(text, "test");
    EXPECT_EQ(formatScene(read), text);
    const JointAxis& axis = read.joints[5].joint.axes.at(0);
    EXPECT_EQ(axis.along, JointAlong::turn_y);
    EXPECT_EQ(axis.servo->limit, 5);
    EXPECT_EQ(axis.spring->rest, -0.5);
    EXPECT_EQ(read.joints[9].second, 4U);
    EXPECT_EQ(read.joints[7].joint.break_torque, 1e3);
    EXPECT_EQ(read.joints[8].joint.break_force, 1e3);
    EXPECT_EQ(SceneRun(read, settingsFor(read)).world().joints().size(), 10U);
}

TEST(SceneJoints, RefuseWhatMeansNothing) {
    const auto expect = [](const std::string& joint, const std::string& part) {
        EXPECT_NE(parseMessage(withJoint(joint)).find(part), std::string::npos) << parseMessage(withJoint(joint));
    };
    expect(R"({"a":1})", "joints[0].type is missing");
    expect(R"({"type":"glue","a":1})", "distance, rope, ball, hinge, slider, fixed");
    expect(R"({"type":"fixed","a":1,"axis":[0,0,1]})", "unknown key \"axis\"");
    expect(R"({"type":"ball","a":1,"b":1})", "is the same body as a");
    expect(R"({"type":"ball","a":0})", "joins nothing that can move");
    expect(R"({"type":"ball","a":99})", "does not exist");
    expect(R"({"type":"hinge","a":1})", "axis is missing");
    expect(R"({"type":"hinge","a":1,"axis":[0,0,0]})", "axis is [0,0,0];");
    expect(R"({"type":"slider","a":1,"axis":[1,0,0],"lower":1,"upper":0})", "has lower 1 above upper 0; swap them");
    expect(R"({"type":"slider","a":1,"axis":[1,0,0],"motor":{"speed":1}})", "motor.limit is missing");
    expect(R"({"type":"rope","a":1})", "anchor_b is missing");
    expect(R"({"type":"ball","a":1,"break_force":-3})", "break_force is -3;");
    expect(R"({"type":"screw","a":1,"axis":[1,0,0]})", "lead is missing");
    expect(R"({"type":"generic","a":1,"axis":[1,0,0],"axes":[{}]})", "along is missing");
    expect(R"({"type":"generic","a":1,"axis":[1,0,0],"axes":[{"along":"w"}]})", "x, y, z, turn_x");
    expect(R"({"type":"cylindrical","a":1,"axis":[1,0,0],"axes":[{"along":"x"}]})", "unknown key \"along\"");
    expect(R"({"type":"hinge","a":1,"axis":[1,0,0],"servo":{"gain":1}})", "unknown key \"gain\"");
    expect(R"({"type":"hinge","a":1,"axis":[1,0,0],"spring":{"rest":1}})", "stiffness is missing");
    expect(R"({"type":"gear","first":0,"second":1,"ratio":2})", "a joint that stands before this one");
    expect(R"({"type":"gear","a":1})", "unknown key \"a\"");
}

TEST(SceneJoints, WhatOnlyAWorldCanSeeIsRefusedWithTheJointsNumber) {
    const Scene scene =
        parseScene(withJoint(R"({"type":"hinge","a":1,"axis":[1,0,0],"lower":-9e9,"upper":1})"), "test");
    try {
        const SceneRun run(scene, settingsFor(scene));
        FAIL() << "limits beyond all turns";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("joint 0"), std::string::npos) << error.what();
    }
}

/// The energy that a run lost or gained, as a part of that of one ball pulled aside.
double energyChange(SceneRun& run, double seconds) {
    const World& world = run.world();
    const auto energy = [&] { return world.kineticEnergy() + world.potentialEnergy(); };
    const double before = energy();
    while (world.time() < seconds) run.step();
    return (energy() - before) / (world.mass(run.ids()[0]) * 9.81 * (1 - std::cos(0.3)));
}

/// Of a ball of radius r = 0.05 m on a rod of l = 1 m: √((l + 2r²/5l)/g) times 1 + θ²/16.
double cradlePeriod() {
    return 2 * std::numbers::pi * std::sqrt((1 + 0.4 * 0.05 * 0.05) / 9.81) * (1 + 0.3 * 0.3 / 16);
}

TEST(SceneJoints, AsManyBallsLeaveTheSwingingCradleAsArrive) {
    const Scene scene = builtInScene("cradle_swing:5:2");
    SceneRun run(scene, settingsFor(scene));
    EXPECT_LE(std::abs(energyChange(run, 0.5 * cradlePeriod())), 2e-5);
    const World& world = run.world();
    const std::vector<JointId> joints = world.joints();
    for (const std::size_t i : {0U, 1U, 2U, 3U, 4U}) {
        EXPECT_LE(world.linearVelocity(run.ids()[i]).norm(), 5e-3) << i;
        // Angles are counted from the beginning.
        EXPECT_NEAR(world.joint(joints[i]).position, i == 2 ? 0 : -0.3, 5e-3) << i;
    }
}

TEST(SceneJoints, TheSwingingCradleKeepsItsEnergy) {
    const Scene scene = builtInScene("cradle_swing");
    SceneRun run(scene, settingsFor(scene));
    EXPECT_LE(std::abs(energyChange(run, 10 * cradlePeriod())), 1e-6);
    EXPECT_FALSE(run.world().joints().empty());
    for (const JointId joint : run.world().joints()) EXPECT_LE(run.world().joint(joint).error, 1e-9);
    while (run.world().time() < 10.25 * cradlePeriod()) run.step();
    EXPECT_GT(run.world().kineticEnergy(), 0.9 * run.world().mass(run.ids()[0]) * 9.81 * (1 - std::cos(0.3)));
}

}  // namespace
}  // namespace cairn
