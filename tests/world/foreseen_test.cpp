/// Which contacts of bodies that are apart are foreseen, and which are not.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "cairn/world.h"

namespace cairn {
namespace {

constexpr double steps = 60;

Settings foreseeing() {
    Settings settings = Settings::preset(Preset::performance, steps);
    settings.sleep.sleeping = false;
    return settings;
}

BodyDescription at(const Shape& shape, const Vec3& position, const Vec3& velocity = Vec3::Zero()) {
    BodyDescription d;
    d.shape = shape;
    d.pose.position = position;
    d.linear_velocity = velocity;
    return d;
}

BodyDescription fixedAt(const Shape& shape, const Vec3& position) {
    BodyDescription d = at(shape, position);
    d.fixed = true;
    return d;
}

struct Scene {
    World world{foreseeing()};
    Scene() {
        world.addMaterial({"stone", 2500});
        world.setGravity(Vec3(0, 0, -9.81));
        world.setDefaultPairProperties({.restitution = 0});
    }
    double deepest() const {
        double deepest = 0;
        for (const ContactInfo& c : world.contacts()) deepest = std::min(deepest, c.distance);
        return deepest;
    }
};

TEST(ForeseenContacts, AFallingBoxStopsWhereItTouches) {
    Scene scene;
    scene.world.addBody(fixedAt(HalfSpace{}, Vec3::Zero()));
    const BodyId box = scene.world.addBody(at(Box{Vec3(0.1, 0.1, 0.1)}, Vec3(0, 0, 1.03), Vec3(0, 0, -7)));
    for (int i = 0; i < 60; ++i) {
        scene.world.step();
        ASSERT_GT(scene.deepest(), -0.0145 * 0.1) << i;
    }
    EXPECT_NEAR(scene.world.pose(box).position.z(), 0.05, 0.0145 * 0.1);
}

TEST(ForeseenContacts, AThinPlateDoesNotFlyThroughAnother) {
    Scene scene;
    scene.world.setGravity(Vec3::Zero());
    const BodyId wall = scene.world.addBody(fixedAt(Box{Vec3(0.02, 2, 2)}, Vec3(5, 0, 0)));
    const BodyId bullet = scene.world.addBody(at(Box{Vec3(0.01, 0.3, 0.3)}, Vec3(-8, 0, 0), Vec3(400, 0, 0)));
    for (int i = 0; i < 10; ++i) scene.world.step();
    EXPECT_TRUE(scene.world.contains(wall));
    EXPECT_NEAR(scene.world.pose(bullet).position.x(), 5 - 0.01 - 0.005, 1e-3);
}

TEST(ForeseenContacts, WhatFollowsSeesTheOneThatStops) {
    Scene scene;
    Settings exact = foreseeing();
    exact.resolution.tolerance = 1e-3;
    scene.world.setSettings(exact);
    scene.world.setGravity(Vec3::Zero());
    scene.world.addBody(fixedAt(Box{Vec3(1, 1, 1)}, Vec3(1.5, 0, 0)));
    std::vector<BodyId> row;
    for (int i = 0; i < 5; ++i) {
        row.push_back(scene.world.addBody(at(Sphere{0.05}, Vec3(0.8 - 0.12 * i, 0, 0), Vec3(9, 0, 0))));
    }
    for (int i = 0; i < 60; ++i) {
        scene.world.step();
        ASSERT_GT(scene.deepest(), -2 * 0.0145 * 0.1) << i;
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
        EXPECT_NEAR(scene.world.pose(row[i]).position.x(), 0.95 - 0.1 * static_cast<double>(i), 0.02) << i;
    }
}

TEST(ForeseenContacts, BodiesThatPassByDoNotMeet) {
    Scene scene;
    scene.world.setGravity(Vec3::Zero());
    scene.world.addBody(fixedAt(Box{Vec3(1, 1, 1)}, Vec3(0, 0, 0)));
    // Towards the corner of the box, and just past it.
    const Vec3 velocity(30, 0, 0);
    const BodyId ball = scene.world.addBody(at(Sphere{0.1}, Vec3(-3, 0.602, 0), velocity));
    const BodyId box = scene.world.addBody(at(Box{Vec3(0.2, 0.2, 0.2)}, Vec3(-3, -0.602, 0), velocity));
    for (int i = 0; i < 20; ++i) scene.world.step();
    EXPECT_EQ(scene.world.linearVelocity(ball), velocity);
    EXPECT_EQ(scene.world.linearVelocity(box), velocity);
}

TEST(ForeseenContacts, ABoxSlidesOverSeamsAsOverOnePiece) {
    const auto wayOver = [](int pieces) {
        Scene scene;
        scene.world.setDefaultPairProperties({.restitution = 0, .static_friction = 0.1, .kinetic_friction = 0.1});
        const double length = 8.0 / pieces;
        for (int i = 0; i < pieces; ++i) {
            scene.world.addBody(fixedAt(Box{Vec3(length, 2, 1)}, Vec3((i + 0.5) * length - 1, 0, -0.5)));
        }
        const BodyId box = scene.world.addBody(at(Box{Vec3(0.2, 0.2, 0.1)}, Vec3(0, 0, 0.05), Vec3(3, 0, 0)));
        for (int i = 0; i < 150; ++i) scene.world.step();
        return scene.world.pose(box).position.x();
    };
    EXPECT_NEAR(wayOver(16), wayOver(1), 0.03 * wayOver(1));
}

/// A ball flies to one that rests, behind which a third one rests: by the end of the step in which the first two meet
/// the second would be in the third.
struct Row {
    Scene scene;
    std::vector<BodyId> balls;
    explicit Row(double restitution) {
        scene.world.setGravity(Vec3::Zero());
        scene.world.setDefaultPairProperties({.restitution = restitution});
        balls.push_back(scene.world.addBody(at(Sphere{0.1}, Vec3(-1, 0, 0), Vec3(9, 0, 0))));
        balls.push_back(scene.world.addBody(at(Sphere{0.1}, Vec3::Zero())));
        balls.push_back(scene.world.addBody(at(Sphere{0.1}, Vec3(0.21, 0, 0))));
    }
    Vec3 velocity(std::size_t ball) const { return scene.world.linearVelocity(balls[ball]); }
};

TEST(ForeseenContacts, WhoIsStruckStopsWhereItTouches) {
    Row row(0);
    for (int i = 0; i < 10; ++i) {
        row.scene.world.step();
        EXPECT_GT(row.scene.deepest(), -0.0145 * 0.2) << i;
        EXPECT_NEAR((row.velocity(0) + row.velocity(1) + row.velocity(2)).x(), 9, 1e-12) << i;
    }
    for (std::size_t ball = 0; ball < 3; ++ball) EXPECT_NEAR(row.velocity(ball).x(), 3, 0.05);
}

TEST(ForeseenContacts, AnImpactThatFollowsAnotherBounces) {
    Row row(1);
    for (int i = 0; i < 10; ++i) {
        row.scene.world.step();
        EXPECT_GT(row.scene.deepest(), -0.0145 * 0.2) << i;
        EXPECT_NEAR(row.scene.world.kineticEnergy(), 0.5 * row.scene.world.mass(row.balls[0]) * 81, 1e-9) << i;
    }
    EXPECT_NEAR(row.velocity(0).x(), 0, 1e-9);
    EXPECT_NEAR(row.velocity(1).x(), 0, 1e-9);
    EXPECT_NEAR(row.velocity(2).x(), 9, 1e-9);
}

TEST(ForeseenContacts, AVelocityThatAUserGivesStopsAtWhatIsNear) {
    Scene scene;
    scene.world.setGravity(Vec3::Zero());
    scene.world.addBody(fixedAt(Box{Vec3(0.02, 2, 2)}, Vec3(5, 0, 0)));
    const BodyId bullet = scene.world.addBody(at(Sphere{0.01}, Vec3(4, 0, 0), Vec3(400, 0, 0)));
    scene.world.step();
    EXPECT_NEAR(scene.world.pose(bullet).position.x(), 5 - 0.01 - 0.01, 1e-4);
    scene.world.setPose(bullet, {Vec3(3, 0, 0), Quat::Identity()});
    scene.world.step();
    scene.world.setLinearVelocity(bullet, Vec3(300, 0, 0));
    const std::vector<std::byte> saved = scene.world.save();
    scene.world.step();
    EXPECT_NEAR(scene.world.pose(bullet).position.x(), 5 - 0.01 - 0.01, 1e-4);
    World restored{foreseeing()};
    restored.load(saved);
    restored.step();
    EXPECT_EQ(restored.stateHash(), scene.world.stateHash());
}

/// A ball and one behind it that a joint ties to it, launched at a wall.
struct LaunchedPair {
    Scene scene;
    BodyId front, back;
    JointId joint;

    LaunchedPair(const Vec3& velocity, const Vec3& along, const JointDescription& joined) {
        scene.world.setGravity(Vec3::Zero());
        scene.world.addBody(fixedAt(Box{Vec3(0.02, 4, 4)}, Vec3::Zero()));
        front = scene.world.addBody(at(Sphere{0.06}, Vec3(-0.4, 0, 0) + 0.1 * along));
        back = scene.world.addBody(at(Sphere{0.06}, Vec3(-0.4, 0, 0) - 0.1 * along));
        JointDescription d = joined;
        d.a = front;
        d.b = back;
        d.anchor = Vec3(-0.4, 0, 0);
        joint = scene.world.addJoint(d);
        scene.world.step();
        for (const BodyId ball : {front, back}) scene.world.setLinearVelocity(ball, velocity);
    }
};

/// Each would be beyond the wall after the step that follows.
TEST(ForeseenContacts, VelocitiesThatAUserGivesToJointedBodiesStopAtWhatIsNear) {
    for (const JointKind kind : {JointKind::ball, JointKind::hinge, JointKind::fixed}) {
        for (int i = 0; i < 12; ++i) {
            const double turn = 0.5 * i;
            const Vec3 along(std::cos(turn), 0.8 * std::sin(turn), 0.6 * std::sin(turn));
            LaunchedPair pair(Vec3(45, i - 6, 3), along, {.kind = kind, .axis = Vec3(0, 0, 1)});
            for (int step = 0; step < 5; ++step) {
                pair.scene.world.step();
                for (const BodyId ball : {pair.front, pair.back}) {
                    ASSERT_LT(pair.scene.world.pose(ball).position.x(), -0.04) << i << ", step " << step;
                }
            }
        }
    }
}

/// The ball in front stops the one behind it by an impulse m·v, a mean force over the step.
TEST(ForeseenContacts, TheImpactOfAVelocityThatAUserGivesMayBreakAJoint) {
    for (const double strength : {0.99, 1.01}) {
        const Vec3 velocity(30, 0, 0);
        const double mass = 2500 * 4.0 / 3 * std::numbers::pi * 0.06 * 0.06 * 0.06;
        LaunchedPair pair(velocity, Vec3::UnitX(),
                          {.kind = JointKind::fixed, .break_force = strength * mass * velocity.x() * steps});
        pair.scene.world.step();
        EXPECT_EQ(pair.scene.world.contains(pair.joint), strength > 1);
        EXPECT_NEAR(pair.scene.world.linearVelocity(pair.back).x(), 0, 1e-9);
        if (strength < 1) continue;
        EXPECT_NEAR(pair.scene.world.joint(pair.joint).impulse.x(), mass * velocity.x(), 1e-6 * mass * velocity.x());
    }
}

TEST(ForeseenContacts, AccountsCloseWhereJointedBodiesAreLaunched) {
    LaunchedPair pair(Vec3(45, 2, 3), Vec3(1, 0.2, 0.1), {.kind = JointKind::ball});
    World& world = pair.scene.world;
    world.addJoint({.kind = JointKind::ball, .a = pair.back, .anchor = Vec3(-0.6, 0.5, 0)});
    const JointId pinion = world.addJoint({.kind = JointKind::generic,
                                           .a = pair.front,
                                           .axes = {{.along = JointAlong::turn_x},
                                                    {.along = JointAlong::x},
                                                    {.along = JointAlong::y},
                                                    {.along = JointAlong::z}}});
    world.addJoint({.kind = JointKind::rack, .first = pinion, .second = pinion, .second_axis = 1, .ratio = 0.1});
    Settings settings = world.settings();
    settings.diagnostics.diagnostics = true;
    world.setSettings(settings);
    for (int i = 0; i < 3; ++i) {
        world.step();
        const Diagnostics& d = world.statistics().diagnostics;
        EXPECT_LT(d.momentum_error, 1e-9) << i;
        EXPECT_LT(std::abs(d.energy_error), 1e-9 * (1 + d.energy)) << i;
        for (const BodyId ball : {pair.front, pair.back}) EXPECT_LT(world.pose(ball).position.x(), -0.04);
    }
}

/// A box that lands on an edge turns, and its other edge meets the floor in the same step.
TEST(ForeseenContacts, TheSideThatAnImpactTurnsDownStopsAtTheFloor) {
    Scene scene;
    scene.world.addBody(fixedAt(HalfSpace{}, Vec3::Zero()));
    scene.world.addBody(fixedAt(Box{Vec3(1, 1, 0.2)}, Vec3(0, 0, 0.1)));
    BodyDescription plank = at(Box{Vec3(1, 0.2, 0.1)}, Vec3(0.95, 0, 0.62), Vec3(0, 0, -20));
    plank.pose.orientation = Quat(Eigen::AngleAxisd(0.1, Vec3::UnitY()));
    scene.world.addBody(plank);
    for (int i = 0; i < 30; ++i) {
        scene.world.step();
        EXPECT_GT(scene.deepest(), -0.1 * 0.1) << i;
    }
}

/// Puts bodies in layers of nine over the floor of a pit.
void throwIntoPit(Scene& scene, const Shape& shape, double size, double speed) {
    for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
        scene.world.addBody(
            fixedAt(HalfSpace{normal, 0}, normal.z() > 0 ? Vec3(0, 0, 0) : Vec3(-1.85 * size * normal)));
    }
    for (int i = 0; i < 90; ++i) {
        const Vec3 place(i % 3 - 1 + 0.012 * (i % 7 - 3), i / 3 % 3 - 1 + 0.02 * (i % 5 - 2), 1 + i / 9);
        BodyDescription d = at(shape, 1.1 * size * place, Vec3(0, 0, -speed));
        d.pose.orientation = Quat(Eigen::AngleAxisd(0.7 * i, Vec3(1, 0.1 * i, 0.5).normalized()));
        scene.world.addBody(d);
    }
}

/// How far they get into each other that are thrown by most of their size in a step [m].
double deepestOfThrown(const Shape& shape, double size, double speed) {
    Scene scene;
    scene.world.setSettings(Settings::preset(Preset::performance, 480));
    throwIntoPit(scene, shape, size, speed);
    double deepest = 0;
    for (int i = 0; i < 120; ++i) {
        scene.world.step();
        deepest = std::min(deepest, scene.deepest());
    }
    return -deepest;
}

TEST(ForeseenContacts, WhatIsThrownIntoAPitDoesNotGetFarIntoEachOther) {
    double balls = 0, cylinders = 0, rods = 0;
    int throws = 0;
    for (double speed = 15; speed <= 25; speed += 2, ++throws) {
        balls += deepestOfThrown(Sphere{0.05}, 0.1, 2 * speed) / 0.1;
        cylinders += deepestOfThrown(Cylinder{0.035, 0.07}, 0.1, speed) / 0.07;
        rods += deepestOfThrown(Capsule{0.02, 0.06}, 0.1, speed) / 0.04;
    }
    EXPECT_LT(balls / throws, 0.05);
    EXPECT_LT(cylinders / throws, 0.08);
    // They are the thinnest and turn most in a step: single ones get to a quarter.
    EXPECT_LT(rods / throws, 0.16);
}

TEST(ForeseenContacts, BallsWithoutFrictionDoNotTurn) {
    for (const double restitution : {0.0, 0.5}) {
        Scene scene;
        scene.world.setSettings(Settings::preset(Preset::performance, 480));
        scene.world.setDefaultPairProperties({.restitution = restitution, .static_friction = 0, .kinetic_friction = 0});
        throwIntoPit(scene, Sphere{0.05}, 0.1, 20);
        double fastest = 0;
        for (int i = 0; i < 240; ++i) {
            scene.world.step();
            for (const BodyId id : scene.world.bodies()) {
                fastest = std::max(fastest, scene.world.angularVelocity(id).norm());
            }
        }
        EXPECT_LT(fastest, 1e-9) << restitution;
    }
}

/// How deep grains on a floor get into a box 8000 times as heavy as one of them that falls onto them, as a part of a
/// grain.
double deepestUnderAHeavyBox(double restitution) {
    Scene scene;
    scene.world.setSettings(Settings::preset(Preset::performance, 480));
    scene.world.setDefaultPairProperties({.restitution = restitution});
    scene.world.addBody(fixedAt(HalfSpace{}, Vec3::Zero()));
    for (int i = 0; i < 16; ++i) {
        const double size = 0.05;
        BodyDescription grain =
            at(Box{Vec3::Constant(size)}, Vec3(0.23 * (i % 4 - 1.5), 0.23 * (i / 4 - 1.5), size / 2));
        grain.pose.orientation = Quat(Eigen::AngleAxisd(0.4 * i, Vec3::UnitZ()));
        scene.world.addBody(grain);
    }
    BodyDescription heavy = at(Box{Vec3::Ones()}, Vec3(0.02, -0.01, 0.75), Vec3(0, 0, -2));
    heavy.pose.orientation = Quat(Eigen::AngleAxisd(0.1, Vec3(1, 0.5, 0).normalized()));
    scene.world.addBody(heavy);
    double deepest = 0;
    for (int i = 0; i < 480; ++i) {
        scene.world.step();
        deepest = std::min(deepest, scene.deepest());
    }
    return -deepest / 0.05;
}

TEST(ForeseenContacts, GrainsUnderAHeavyBodyAreNotPressedIntoIt) {
    EXPECT_LT(deepestUnderAHeavyBox(0), 0.1) << "plastic";
    EXPECT_LT(deepestUnderAHeavyBox(0.5), 0.1) << "bouncing";
}

TEST(ForeseenContacts, AWorldThatIsRestoredGoesOnBitByBit) {
    Scene scene;
    scene.world.addBody(fixedAt(HalfSpace{}, Vec3::Zero()));
    for (int i = 0; i < 12; ++i) {
        scene.world.addBody(
            at(Box{Vec3(0.1, 0.12, 0.08)}, Vec3(0.02 * (i % 3), 0.015 * (i % 4), 0.2 + 0.16 * i), Vec3(0, 0, -6)));
    }
    for (int i = 0; i < 60; ++i) {
        World copy = World::restore(scene.world.save());
        scene.world.step();
        copy.step();
        ASSERT_EQ(copy.stateHash(), scene.world.stateHash()) << i;
    }
}

}  // namespace
}  // namespace cairn
