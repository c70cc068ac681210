/// Scenes of which every value is multiplied by its unit.
#include <gtest/gtest.h>

#include <limits>

#include "cairn/scene.h"

namespace cairn {
namespace {

constexpr Scales larger{4, 2, 64};
constexpr Scales smaller{1.0 / 4, 1.0 / 2, 1.0 / 64};

TEST(ScaledScene, IsTheSameAgainWhenItIsScaledBack) {
    for (const BuiltInScene& named : builtInScenes()) {
        const Scene scene = builtInScene(named.example);
        const Scene there = scaled(scene, larger);
        EXPECT_NE(formatScene(there), formatScene(scene)) << named.name;
        EXPECT_EQ(formatScene(scaled(there, smaller)), formatScene(scene)) << named.name;
    }
}

TEST(ScaledScene, MultipliesByUnits) {
    Scene scene;
    scene.duration = 3;
    scene.gravity = {0, 0, -10};
    scene.materials = {{"oak", 800}};
    scene.default_pair.rolling_friction = 0.01;
    scene.settings = {{"steps_per_second", std::int64_t{240}}, {"contact_margin", 0.5}, {"iterations", 7.0}};
    SceneBody body;
    body.shape = Box{{1, 2, 3}};
    body.mass = 2;
    body.linear_velocity = {1, 0, 0};
    body.angular_velocity = {0, 1, 0};
    body.motion = TableMotion{{0, 1}, {Vec3::Zero(), Vec3::UnitX()}, {}, {}};
    scene.bodies.push_back(body);
    SceneJoint hinge;
    hinge.joint = {.kind = JointKind::hinge, .motor = JointMotor{3, 5}};
    SceneJoint slider;
    slider.joint = {.kind = JointKind::slider, .motor = JointMotor{3, 5}};
    SceneJoint rack;
    rack.joint = {.kind = JointKind::rack, .ratio = 0.5};
    rack.first = 0;
    rack.second = 1;
    scene.joints = {hinge, slider, rack};

    const Scene other = scaled(scene, {10, 2, 1000});
    EXPECT_EQ(other.duration, 6);
    EXPECT_EQ(other.gravity.z(), -25);
    EXPECT_EQ(other.materials[0].density, 800);
    EXPECT_EQ(other.default_pair.rolling_friction, 0.1);
    EXPECT_EQ(std::get<double>(other.settings[0].second), 120);
    EXPECT_EQ(std::get<double>(other.settings[1].second), 5);
    EXPECT_EQ(std::get<double>(other.settings[2].second), 7);
    EXPECT_EQ(std::get<Box>(other.bodies[0].shape).size, Vec3(10, 20, 30));
    EXPECT_EQ(other.bodies[0].mass, 2000);
    EXPECT_EQ(other.bodies[0].linear_velocity.x(), 5);
    EXPECT_EQ(other.bodies[0].angular_velocity.y(), 0.5);
    const auto& table = std::get<TableMotion>(*other.bodies[0].motion);
    EXPECT_EQ(table.times[1], 2);
    EXPECT_EQ(table.displacements[1].x(), 10);
    EXPECT_EQ(other.joints[0].joint.motor->speed, 1.5);
    EXPECT_EQ(other.joints[0].joint.motor->limit, 5 * 25000.0);
    EXPECT_EQ(other.joints[1].joint.motor->speed, 15);
    EXPECT_EQ(other.joints[1].joint.motor->limit, 5 * 2500.0);
    EXPECT_EQ(other.joints[2].joint.ratio, 5);
}

TEST(ScaledScene, RefusesScalesThatAreNone) {
    const Scene scene = builtInScene("cradle");
    for (const double bad :
         {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(scaled(scene, {bad, 1, 1}), InputError) << bad;
        EXPECT_THROW(scaled(scene, {1, bad, 1}), InputError) << bad;
        EXPECT_THROW(scaled(scene, {1, 1, bad}), InputError) << bad;
    }
}

}  // namespace
}  // namespace cairn
