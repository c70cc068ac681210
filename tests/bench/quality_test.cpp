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
    return {time_step, std::vector<Frame>(frames, Frame{poses, poses})};
}

TEST(Quality, OfATowerThatStandsIsPerfect) {
    const Scene scene = twoBoxes();
    const RigidScene rigid(scene);
    const Quality quality = measureQuality(scene, rigid, standing(startOf(rigid), 20));
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
    trajectory.frames[1] = {startOf(rigid), startOf(rigid)};
    const Quality quality = measureQuality(scene, rigid, trajectory);
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
    const Quality quality = measureQuality(scene, rigid, standing(poses, 3));
    EXPECT_EQ(quality.lost, 2U);
    EXPECT_TRUE(std::isfinite(quality.energy_gain));
    EXPECT_TRUE(std::isfinite(quality.mean_overlap));
}

/// A ball thrown upwards, on its parabola.
Trajectory thrown(const RigidScene& scene, double speed, double gravity, int frames) {
    Trajectory trajectory{time_step, {}};
    const std::vector<Pose> start = startOf(scene);
    const auto at = [&](double time) {
        std::vector<Pose> poses = start;
        poses[1].position.z() += speed * time - 0.5 * gravity * time * time;
        return poses;
    };
    for (int frame = 1; frame <= frames; ++frame) {
        const double time = 8 * frame * time_step;
        trajectory.frames.push_back({at(time - time_step), at(time)});
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
    const Quality quality = measureQuality(scene, rigid, thrown(rigid, 3, g, 20));
    const double mass = rigid.bodies()[1].mass;
    EXPECT_LT(quality.energy_gain, 1e-3 * 0.5 * mass * 9);
    EXPECT_EQ(quality.moving, 1U);
}

TEST(Quality, SeesEnergyThatComesFromNowhere) {
    const Scene scene = oneBall(3);
    const RigidScene rigid(scene);
    const double mass = rigid.bodies()[1].mass;
    const Quality quality = measureQuality(scene, rigid, thrown(rigid, 4, g, 20));
    const double gain = 0.5 * mass * (16 - 9);
    EXPECT_NEAR(quality.energy_gain, gain, 1e-3 * gain);
    EXPECT_NEAR(quality.energy_gain_part, gain / (0.5 * mass * 9), 1e-3 * gain / (0.5 * mass * 9));
}

TEST(Quality, SeesTheErrorOfASchemeThatStartsHalfAStepOff) {
    // A scheme of first order that moves with the velocity before gravity has changed it flies the parabola of a ball
    // that was thrown faster by half a step's gravity.
    const double speed = 3;
    const Scene scene = oneBall(speed);
    const RigidScene rigid(scene);
    const double mass = rigid.bodies()[1].mass;
    const Quality quality = measureQuality(scene, rigid, thrown(rigid, speed + g * time_step / 2, g, 20));
    const double gain = mass * g * speed * time_step / 2;
    EXPECT_NEAR(quality.energy_gain, gain, 0.02 * gain);
}

TEST(Quality, TakesAChangeOfGravityForNoGain) {
    Scene scene = oneBall(0);
    scene.gravity.setZero();
    scene.events = {{0.1, SetGravity{{0, 0, -g}}}};
    const RigidScene rigid(scene);
    EXPECT_EQ(rigid.gravityAt(23 * time_step, time_step).z(), 0);
    EXPECT_EQ(rigid.gravityAt(24 * time_step, time_step).z(), -g);
    Trajectory trajectory = thrown(rigid, 0, 0, 3);
    for (const Frame& frame : thrown(rigid, 0, g, 10).frames) trajectory.frames.push_back(frame);
    EXPECT_LT(measureQuality(scene, rigid, trajectory).energy_gain, 0.05);
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
