/// @file The measure of quality, against poses whose overlap, energy and rest are known.
#include "bench/quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/common.h"

namespace cairn::bench {
namespace {

constexpr double time_step = 1.0 / 240;
constexpr double g = 10;

/// Two boxes of 0.1 m and 0.8 kg above a ground, the second on the first.
Scene twoBoxes() {
    return builtInScene("tower:2");
}

Pose shifted(Pose pose, const Vec3& by) {
    pose.position += by;
    return pose;
}

std::vector<Pose> startOf(const RigidScene& scene) {
    std::vector<Pose> poses;
    for (const RigidBody& body : scene.bodies()) poses.push_back(body.pose);
    return poses;
}

/// Frames in which nothing moves.
Trajectory standing(const std::vector<Pose>& poses, std::size_t frames) {
    return Trajectory(frames, poses);
}

TEST(Quality, OfATowerThatStandsIsPerfect) {
    const Scene scene = twoBoxes();
    const RigidScene rigid(scene);
    const Quality quality = measureQuality(scene, rigid, standing(startOf(rigid), 20), time_step);
    EXPECT_NEAR(quality.largest_overlap, 0, 1e-12);
    EXPECT_NEAR(quality.mean_overlap, 0, 1e-12);
    EXPECT_EQ(quality.moving, 0U);
    EXPECT_EQ(quality.lost, 0U);
    EXPECT_EQ(quality.drift, 0);
    EXPECT_NEAR(quality.highest, 0.15, 1e-12);
    EXPECT_NEAR(quality.energy_gain, 0, 1e-12);
}

TEST(Quality, FindsTheOverlapWhoeverMadeIt) {
    const Scene scene = twoBoxes();
    const RigidScene rigid(scene);
    std::vector<Pose> poses = startOf(rigid);
    poses[2] = shifted(poses[2], {0, 0, -0.003});
    Trajectory trajectory = standing(poses, 2);
    trajectory[1] = startOf(rigid);
    const Quality quality = measureQuality(scene, rigid, trajectory, time_step);
    EXPECT_NEAR(quality.largest_overlap, 0.003, 1e-9);
    EXPECT_NEAR(quality.resting_largest, 0, 1e-9);
    EXPECT_GT(quality.mean_overlap, 0.0005);
    EXPECT_LE(quality.mean_overlap, 0.0015 + 1e-9);
}

TEST(Quality, SeesABodyOfWhichAPeerLostThePose) {
    const Scene scene = twoBoxes();
    const RigidScene rigid(scene);
    std::vector<Pose> poses = startOf(rigid);
    poses[1].position.x() = std::numeric_limits<double>::quiet_NaN();
    poses[2] = shifted(poses[2], {0, 0, -1});  // through the ground
    const Quality quality = measureQuality(scene, rigid, standing(poses, 3), time_step);
    EXPECT_EQ(quality.lost, 2U);
    EXPECT_TRUE(std::isfinite(quality.energy_gain));
    EXPECT_TRUE(std::isfinite(quality.mean_overlap));
}

/// The middle of a chord of the parabola lies below the parabola: by so much the energy of free flight is measured too
/// low [J/kg].
constexpr double chord = g * g / (8 * simulation_steps_per_second * simulation_steps_per_second);

/// A ball thrown upwards, on its parabola.
Trajectory thrown(const RigidScene& scene, double speed, double gravity, int frames) {
    Trajectory trajectory;
    for (int frame = 1; frame <= frames; ++frame) {
        const double time = frame / simulation_steps_per_second;
        std::vector<Pose> poses = startOf(scene);
        poses[1].position.z() += speed * time - 0.5 * gravity * time * time;
        trajectory.push_back(std::move(poses));
    }
    return trajectory;
}

Scene oneBall(double speed) {
    Scene scene = builtInScene("tower:1");
    scene.bodies[1].shape = Sphere{0.05};
    scene.bodies[1].position = {0, 0, 2};
    scene.bodies[1].linear_velocity = {0, 0, speed};
    return scene;
}

TEST(Quality, KeepsTheEnergyOfAThrownBall) {
    const Scene scene = oneBall(3);
    const RigidScene rigid(scene);
    const Quality quality = measureQuality(scene, rigid, thrown(rigid, 3, g, 20), time_step);
    EXPECT_EQ(quality.energy_gain, 0);
    EXPECT_EQ(quality.moving, 1U);
}

TEST(Quality, SeesEnergyThatComesFromNowhere) {
    const Scene scene = oneBall(3);
    const RigidScene rigid(scene);
    const double mass = rigid.bodies()[1].mass;
    const Quality quality = measureQuality(scene, rigid, thrown(rigid, 4, g, 20), time_step);
    const double gain = mass * (0.5 * (16 - 9) - chord);
    EXPECT_NEAR(quality.energy_gain, gain, 1e-9);
    EXPECT_NEAR(quality.energy_gain_part, gain / (0.5 * mass * 9), 1e-9);
}

TEST(Quality, SeesTheErrorOfASchemeThatStartsHalfAStepOff) {
    // A scheme of first order that moves with the velocity before gravity has changed it flies the parabola of a ball
    // that was thrown faster by half a step's gravity.
    const double speed = 3;
    const Scene scene = oneBall(speed);
    const RigidScene rigid(scene);
    const double mass = rigid.bodies()[1].mass;
    const Quality quality = measureQuality(scene, rigid, thrown(rigid, speed + g * time_step / 2, g, 20), time_step);
    const double off = g * time_step / 2;
    EXPECT_NEAR(quality.energy_gain, mass * (speed * off + 0.5 * off * off - chord), 1e-9);
}

TEST(Quality, TakesAChangeOfGravityForNoGain) {
    Scene scene = oneBall(0);
    scene.gravity.setZero();
    scene.events = {{0.1, SetGravity{{0, 0, -g}}}};
    const RigidScene rigid(scene);
    EXPECT_EQ(rigid.gravityAt(23 * time_step, time_step).z(), 0);
    EXPECT_EQ(rigid.gravityAt(24 * time_step, time_step).z(), -g);
    Trajectory trajectory = thrown(rigid, 0, 0, 3);
    for (const std::vector<Pose>& poses : thrown(rigid, 0, g, 10)) trajectory.push_back(poses);
    EXPECT_EQ(measureQuality(scene, rigid, trajectory, time_step).energy_gain, 0);
}

TEST(Quality, TakesTheRemovalOfAnOverlapForNoSpeed) {
    // An engine that moves a body by 2 mm within one time step of 1/240 s has not given it half a metre per second.
    const Scene scene = twoBoxes();
    const RigidScene rigid(scene);
    std::vector<Pose> poses = startOf(rigid);
    Trajectory trajectory = standing(poses, 2);
    trajectory[0][2] = shifted(poses[2], {0, 0, -0.002});
    const double speed = 0.002 * simulation_steps_per_second;
    const double mass = rigid.bodies()[2].mass;
    EXPECT_LE(measureQuality(scene, rigid, trajectory, time_step).energy_gain, 0.5 * mass * speed * speed);
}

TEST(RigidScene, RefusesWhatNotAllEnginesHave) {
    Scene scene = twoBoxes();
    scene.springs.emplace_back();
    EXPECT_THROW(RigidScene{scene}, InputError);
    scene = twoBoxes();
    scene.joints.push_back({1, 2, {}});
    EXPECT_THROW(RigidScene{scene}, InputError);
    for (const Shape& shape : {Shape(Cylinder{}), Shape(Compound{{{Sphere{}}, {Box{}}}}),
                               Shape(ConvexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}))}) {
        scene = twoBoxes();
        scene.bodies[1].shape = shape;
        EXPECT_THROW(RigidScene{scene}, InputError);
    }
    scene = twoBoxes();
    scene.bodies[1].inertia = Mat3::Identity();
    EXPECT_THROW(RigidScene{scene}, InputError);
    scene = twoBoxes();
    scene.events.push_back({1, RemoveBody{1}});
    EXPECT_THROW(RigidScene{scene}, InputError);
}

TEST(BenchScene, PutsAHeavyBoxOnALightOne) {
    const Scene scene = benchScene("heavy:1000");
    ASSERT_EQ(scene.bodies.size(), 3U);
    EXPECT_NEAR(*scene.bodies[2].mass / *scene.bodies[1].mass, 1000, 1e-9);
    EXPECT_GT(scene.bodies[2].position.z(), scene.bodies[1].position.z());
    for (const char* wrong : {"heavy:", "heavy:0", "heavy:x", "heavy:10x", "heavy:nan", "nonsense"}) {
        EXPECT_THROW(benchScene(wrong), InputError) << wrong;
    }
}

}  // namespace
}  // namespace cairn::bench
