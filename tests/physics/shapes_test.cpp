/// Cylinders, hulls and compounds in a world: closed forms of their motion, and piles of them that stand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cairn/scene.h"
#include "cairn/world.h"

namespace cairn {
namespace {

struct Ground {
    World world{Settings::preset(Preset::accuracy)};
    MaterialId oak = world.addMaterial({"oak", 800});

    explicit Ground(double friction = 0.5) {
        world.setDefaultPairProperties({0, friction, friction});
        world.setGravity(Vec3(0, 0, -10));
        world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true});
    }
    void run(double seconds) {
        const double end = world.time() + seconds;
        while (world.time() < end - 1e-9) world.step();
    }
};

std::vector<Vec3> cubeCorners(double size, const Vec3& centre) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        const Vec3 sign((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? 0.5 : -0.5);
        corners.push_back(centre + size * sign);
    }
    return corners;
}

/// A wooden table of a board and four legs, its origin on the floor. Height 0.22 m.
Compound table() {
    Compound result;
    result.parts.push_back({Box{{0.4, 0.3, 0.02}}, {{0, 0, 0.21}}, {}, {}});
    for (const double x : {-0.17, 0.17}) {
        for (const double y : {-0.12, 0.12}) result.parts.push_back({Cylinder{0.015, 0.2}, {{x, y, 0.1}}, {}, {}});
    }
    return result;
}

/// Stacks bodies, runs and tells how far the farthest moved.
double drift(const Shape& shape, double height, double origin, int count, double seconds) {
    Ground ground;
    std::vector<BodyId> ids;
    for (int i = 0; i < count; ++i) {
        ids.push_back(ground.world.addBody(
            {.shape = shape, .material = ground.oak, .pose = {Vec3(0, 0, origin + i * height), Quat::Identity()}}));
    }
    std::vector<Vec3> before;
    for (const BodyId id : ids) before.push_back(ground.world.pose(id).position);
    ground.run(seconds);
    EXPECT_GE(ground.world.contacts().size(), ids.size()) << "they stand on each other";
    double farthest = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        farthest = std::max(farthest, (ground.world.pose(ids[i]).position - before[i]).norm());
    }
    return farthest;
}

TEST(Shapes, ATowerOfCylindersStands) {
    EXPECT_LT(drift(Cylinder{0.05, 0.1}, 0.1, 0.05, 6, 10), 1e-3);
}

TEST(Shapes, ATowerOfHullDiceStands) {
    EXPECT_LT(drift(ConvexHull(cubeCorners(0.1, {0.3, -0.2, 0.05})), 0.1, 0, 6, 10), 1e-3);
}

TEST(Shapes, AStackOfTablesStands) {
    EXPECT_LT(drift(table(), 0.22, 0, 3, 10), 1e-3);
}

TEST(Shapes, ABodyMadeOfPartsFallsAndTurnsLikeTheWhole) {
    Ground ground;
    const Compound halves{
        {{Box{{0.1, 0.2, 0.15}}, {{1, 0, 0.075}}, {}, {}}, {Box{{0.1, 0.2, 0.15}}, {{1, 0, -0.075}}, {}, {}}}};
    std::vector<Vec3> corners;
    for (const Vec3& c : cubeCorners(1, Vec3::Zero()))
        corners.push_back(c.cwiseProduct(Vec3(0.1, 0.2, 0.3)) + Vec3(1, 0, 0));
    const Quat turned = Quat(0.8, 0.2, -0.1, 0.3).normalized();
    const Vec3 w(1, 5, 2);
    const auto add = [&](const Shape& shape, const Vec3& origin, double y) {
        const Vec3 centre(0, y, 5);
        return ground.world.addBody({.shape = shape,
                                     .material = ground.oak,
                                     .pose = {centre - turned * origin, turned},
                                     .linear_velocity = Vec3(0, 0, 3),
                                     .angular_velocity = w});
    };
    const BodyId box = add(Box{{0.1, 0.2, 0.3}}, Vec3::Zero(), 0);
    const BodyId parts = add(halves, {1, 0, 0}, 2);
    const BodyId hull = add(ConvexHull(corners), {1, 0, 0}, 4);
    ground.run(0.5);
    const Pose expected = ground.world.pose(box);
    EXPECT_NEAR(expected.position.z(), 5 + 3 * 0.5 - 0.5 * 10 * 0.25, 0.01);
    EXPECT_GT(expected.orientation.angularDistance(turned), 0.1);
    double y = 0;
    for (const BodyId id : {parts, hull}) {
        y += 2;
        EXPECT_LE((ground.world.centreOfMass(id) - expected.position - Vec3(0, y, 0)).norm(), 1e-9);
        EXPECT_LE(ground.world.pose(id).orientation.angularDistance(expected.orientation), 1e-7);
        EXPECT_LE((ground.world.angularVelocity(id) - ground.world.angularVelocity(box)).norm(), 1e-7);
    }
}

TEST(Shapes, PoseIsThatOfTheGivenFrame) {
    Ground ground;
    const Pose pose{{1, 2, 3}, Quat(0.5, 0.5, -0.5, 0.5)};
    const BodyId id =
        ground.world.addBody({.shape = ConvexHull(cubeCorners(0.1, {7, 8, 9})), .material = ground.oak, .pose = pose});
    EXPECT_LE((ground.world.pose(id).position - pose.position).norm(), 1e-13);
    EXPECT_LE((ground.world.centreOfMass(id) - pose.toOuter(Vec3(7, 8, 9))).norm(), 1e-13);
    const Pose other{{-1, 0, 5}, Quat(0.6, 0, 0.8, 0)};
    ground.world.setPose(id, other);
    EXPECT_LE((ground.world.pose(id).position - other.position).norm(), 1e-13);
    EXPECT_LE(ground.world.pose(id).orientation.angularDistance(other.orientation), 1e-12);
}

TEST(Shapes, AWeightedDieTurnsItsHeavySideDown) {
    Ground ground;
    const BodyId die = ground.world.addBody({.shape = Sphere{0.1},
                                             .material = ground.oak,
                                             .mass = 1,
                                             .centre_of_mass = Vec3(0, 0, 0.05),
                                             .pose = {Vec3(0, 0, 0.1), Quat(Eigen::AngleAxisd(0.5, Vec3::UnitX()))}});
    ground.run(0.3);
    EXPECT_LT((ground.world.pose(die).orientation * Vec3::UnitZ()).z(), 0.87) << "it has begun to roll over";
    EXPECT_NEAR(ground.world.pose(die).position.z(), 0.1, 2e-3) << "the ball stays on the floor";
}

TEST(Shapes, ACylinderRollsDownAnInclineAtTwoThirds) {
    const double angle = 0.2;
    Ground ground(1.0);
    ground.world.setGravity(10 * Vec3(std::sin(angle), 0, -std::cos(angle)));
    const Quat lying(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));
    const BodyId id =
        ground.world.addBody({.shape = Cylinder{0.1, 0.3}, .material = ground.oak, .pose = {Vec3(0, 0, 0.1), lying}});
    ground.run(1);
    const double expected = 10 * std::sin(angle) / 1.5;
    EXPECT_NEAR(ground.world.linearVelocity(id).x(), expected, 1e-2 * expected);
    EXPECT_NEAR(ground.world.linearVelocity(id).y(), 0, 1e-3 * expected);
}

TEST(Shapes, WorldsWithThemGoOnFromASnapshotBitByBit) {
    Ground ground;
    for (int i = 0; i < 3; ++i) {
        const double z = 0.3 + 0.5 * i;
        ground.world.addBody({.shape = table(), .material = ground.oak, .pose = {Vec3(0, 0, z), Quat(1, 0.1, 0.2, 0)}});
        ground.world.addBody({.shape = ConvexHull(cubeCorners(0.1, {1, 2, 3})),
                              .material = ground.oak,
                              .pose = {Vec3(-1, -2, z - 3), Quat::Identity()}});
        ground.world.addBody(
            {.shape = Cylinder{0.1, 0.2}, .material = ground.oak, .pose = {Vec3(0.5, 0, z), Quat(1, 0.3, 0, 0)}});
    }
    ground.run(0.2);
    World copy = World::restore(ground.world.save());
    for (int i = 0; i < 100; ++i) {
        ground.world.step();
        copy.step();
        ASSERT_EQ(copy.stateHash(), ground.world.stateHash()) << i;
    }
}

TEST(Shapes, ScenesKeepThemExactly) {
    Scene scene;
    scene.name = "shapes";
    scene.duration = 1;
    scene.materials = {{"oak", 800}};
    SceneBody body;
    body.material = "oak";
    body.shape = table();
    body.mass = 3;
    body.centre_of_mass = Vec3(0, 0.1, 0.2);
    Mat3 inertia = Vec3(1, 1, 1.5).asDiagonal();
    inertia(0, 1) = inertia(1, 0) = 0.1;
    body.inertia = inertia;
    scene.bodies = {body, body, body};
    scene.bodies[1].shape = ConvexHull(cubeCorners(1.0 / 3, {0, 0, 1}));
    scene.bodies[2].shape = Cylinder{0.1, 1.0 / 7};
    const std::string text = formatScene(scene);
    const Scene read = parseScene(text, "test");
    EXPECT_EQ(formatScene(read), text);
    EXPECT_EQ(*read.bodies[0].inertia, inertia);
    EXPECT_EQ(std::get<ConvexHull>(read.bodies[1].shape).points()[7],
              std::get<ConvexHull>(scene.bodies[1].shape).points()[7]);
}

}  // namespace
}  // namespace cairn
