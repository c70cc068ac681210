/// Locked axes of bodies, and pair laws that depend on speed.
#include <gtest/gtest.h>

#include <array>

#include "joint_testing.h"

namespace cairn {
namespace {

using mechanics::joint_gravity;
using mechanics::JointBench;

constexpr std::array flat = {JointAlong::y, JointAlong::turn_x, JointAlong::turn_z};

TEST(LockedAxes, KeepABodyInItsPlaneHoweverItIsPushed) {
    JointBench bench(Vec3(0, 3, -joint_gravity));
    const BodyId body =
        bench.add(Box{{0.3, 0.2, 0.1}}, 2, Vec3(0, 0.7, 1), Quat(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized())));
    const Quat begin = bench.world.pose(body).orientation;
    bench.world.setLocked(body, flat);
    EXPECT_EQ(bench.world.locked(body), std::vector<JointAlong>(flat.begin(), flat.end()));
    EXPECT_TRUE(bench.world.joints().empty()) << "no joint that users see";
    bench.world.setLinearVelocity(body, Vec3(1, 5, 2));
    bench.world.setAngularVelocity(body, Vec3(4, 6, -2));
    bench.run(1);
    const Pose pose = bench.world.pose(body);
    EXPECT_NEAR(pose.position.x(), 1, 1e-9);
    EXPECT_NEAR(pose.position.y(), 0.7, 1e-10);
    EXPECT_NEAR(pose.position.z(), 1 + 2 - 0.5 * joint_gravity, 1e-9);
    const Vec3 axis = (pose.orientation * begin.conjugate()) * Vec3::UnitY();
    EXPECT_LE((axis - Vec3::UnitY()).norm(), 1e-9);
    EXPECT_NEAR(bench.world.angularVelocity(body).x(), 0, 1e-12);
    bench.world.setLocked(body, {});
    bench.run(1);
    EXPECT_GT(bench.world.pose(body).position.y(), 1) << "free again";
}

TEST(LockedAxes, OfAllTurnsLetABodySlideWithoutTipping) {
    JointBench bench(Vec3(0, 0, -joint_gravity));
    bench.world.setDefaultPairProperties({0, 0.5, 0.5});
    bench.world.addBody({.shape = HalfSpace{}, .material = bench.steel, .fixed = true});
    const BodyId tower = bench.world.addBody({.shape = Box{{0.1, 0.1, 1}},
                                              .material = bench.steel,
                                              .pose = {Vec3(0, 0, 0.5), Quat::Identity()},
                                              .linear_velocity = Vec3(2, 0, 0),
                                              .locked = {JointAlong::turn_x, JointAlong::turn_y, JointAlong::turn_z}});
    bench.run(0.25);
    EXPECT_NEAR(bench.world.linearVelocity(tower).x(), 2 - 0.5 * joint_gravity * 0.25, 2e-2) << "v − µ·g·t";
    EXPECT_LE(bench.world.pose(tower).orientation.angularDistance(Quat::Identity()), 1e-9);
}

TEST(LockedAxes, GoWithTheirBodyAreSavedAndMoveWhereItIsPut) {
    JointBench bench(Vec3(0, 0, -joint_gravity));
    const BodyId body = bench.add(Sphere{0.1}, 1, Vec3::Zero());
    const std::array<JointAlong, 1> z = {JointAlong::z};
    bench.world.setLocked(body, z);
    bench.run(0.2);
    EXPECT_NEAR(bench.world.pose(body).position.z(), 0, 1e-12);
    bench.world.setPose(body, {Vec3(0, 0, 4), Quat::Identity()});
    World copy = World::restore(bench.world.save());
    for (int i = 0; i < 100; ++i) copy.step();
    EXPECT_NEAR(copy.pose(body).position.z(), 4, 1e-10);
    EXPECT_EQ(copy.locked(body), std::vector<JointAlong>{JointAlong::z});
    copy.removeBody(body);
    copy.step();
}

TEST(LockedAxes, RefuseWhatCannotBe) {
    JointBench bench;
    const BodyId wall = bench.world.addBody({.shape = Box{{1, 1, 1}}, .material = bench.steel, .fixed = true});
    const BodyId body = bench.add(Sphere{0.1}, 1, Vec3(0, 0, 3));
    EXPECT_THROW(bench.world.setLocked(wall, flat), InputError);
    EXPECT_THROW(bench.world.setLocked(body, std::array{JointAlong::x, JointAlong::x}), InputError);
    EXPECT_THROW(bench.world.setLocked(body, std::array{static_cast<JointAlong>(9)}), InputError);
    EXPECT_TRUE(bench.world.locked(body).empty());
}

TEST(PairLaws, RestitutionFollowsTheSpeedOfTheImpact) {
    for (const double speed : {0.5, 2.0, 5.0, 20.0}) {
        JointBench bench;
        bench.world.setPairLaw(bench.steel, bench.steel, {.restitution = {{1, 3, 10}, {0.9, 0.7, 0.2}}});
        const BodyId ball = bench.add(Sphere{0.1}, 1, Vec3(0, 0, 0.3));
        bench.world.addBody({.shape = HalfSpace{}, .material = bench.steel, .fixed = true});
        bench.world.setLinearVelocity(ball, Vec3(0, 0, -speed));
        bench.run(0.5);
        const double wanted = speed < 1 ? 0.9 : speed == 2 ? 0.8 : speed == 5 ? 0.7 - 2.0 / 7 * 0.5 : 0.2;
        EXPECT_NEAR(bench.world.linearVelocity(ball).z(), wanted * speed, 1e-9) << speed;
    }
}

TEST(PairLaws, FrictionFollowsTheSpeedOfSliding) {
    // µ = a + b·v: v′ = −g·(a + b·v), v + a/b falls as exp(−g·b·t).
    JointBench bench(Vec3(0, 0, -joint_gravity));
    bench.world.setDefaultPairProperties({0, 0.05, 0.05});
    const double a = 0.1;
    const double b = 0.05;
    bench.world.setPairLaw(bench.steel, bench.steel, {.friction = {{0, 10}, {a, a + 10 * b}}});
    bench.world.addBody({.shape = HalfSpace{}, .material = bench.steel, .fixed = true});
    const BodyId block = bench.add(Box{{0.4, 0.4, 0.1}}, 2, Vec3(0, 0, 0.05));
    bench.world.setLinearVelocity(block, Vec3(4, 0, 0));
    bench.run(1);
    const double wanted = (4 + a / b) * std::exp(-joint_gravity * b * 1) - a / b;
    EXPECT_NEAR(bench.world.linearVelocity(block).x(), wanted, 5e-3);
    EXPECT_EQ(bench.world.pairLaw(bench.steel, bench.steel).friction.speeds.size(), 2U);
    World copy = World::restore(bench.world.save());
    for (int i = 0; i < 100; ++i) {
        copy.step();
        bench.world.step();
    }
    EXPECT_EQ(copy.stateHash(), bench.world.stateHash());
}

TEST(PairLaws, RefuseCurvesThatMeanNothing) {
    JointBench bench;
    const auto refuses = [&](const PairLaw& law) {
        EXPECT_THROW(bench.world.setPairLaw(bench.steel, bench.steel, law), InputError);
    };
    refuses({.restitution = {{1, 2}, {0.5}}});
    refuses({.restitution = {{2, 1}, {0.5, 0.5}}});
    refuses({.restitution = {{-1}, {0.5}}});
    refuses({.restitution = {{0}, {1.5}}});
    refuses({.friction = {{std::nan("")}, {0.5}}});
    refuses({.friction = {{0}, {std::nan("")}}});
    EXPECT_THROW(bench.world.setPairLaw(bench.steel, static_cast<MaterialId>(7), {}), InputError);
}

}  // namespace
}  // namespace cairn
