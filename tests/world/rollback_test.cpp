/// Moments kept in memory: a world that goes back is bit by bit what it was, whatever was called since.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "cairn/world.h"

namespace cairn {
namespace {

using Bytes = std::vector<std::byte>;

/// Bodies of every kind of shape that fall on a floor, with springs, joints and events.
struct Yard {
    explicit Yard(ResolutionKind resolution = ResolutionKind::impulse_queue) : world(settings(resolution)) {
        oak = world.addMaterial({"oak", 800});
        steel = world.addMaterial({"steel", 7800});
        world.setDefaultPairProperties({.restitution = 0.2, .static_friction = 0.5, .kinetic_friction = 0.4});
        world.setGravity(Vec3(0, 0, -10));
        world.setEventLevel(EventLevel::all);
        world.addBody({.shape = HalfSpace{}, .material = steel, .fixed = true});
        for (int i = 0; i < 30; ++i) bodies.push_back(world.addBody(body(i)));
        spring = world.addSpring({.a = bodies[0], .b = bodies[1], .stiffness = 20, .damping = 1, .rest_length = 0.2});
        hinge = world.addJoint(
            {.kind = JointKind::hinge, .a = bodies[2], .b = bodies[3], .anchor = world.pose(bodies[2]).position});
        world.addJoint({.kind = JointKind::rope, .a = bodies[4], .anchor_b = Vec3(0, 0, 2), .length = 2});
    }

    BodyDescription body(int i) const {
        const double size = 0.08 + 0.01 * (i % 5);
        const Shape shapes[] = {Sphere{size / 2},
                                Box{Vec3(size, size, 1.5 * size)},
                                Capsule{size / 2, size},
                                Cylinder{size / 2, size},
                                ConvexHull({{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}),
                                Compound{{{Box{Vec3::Constant(size)}, {}, {}, {}},
                                          {Sphere{size / 2}, {Vec3(0, 0, size), Quat::Identity()}, 0.3, {}}}}};
        return {
            .shape = shapes[i % 6],
            .material = i % 2 == 0 ? oak : steel,
            .pose = {Vec3(0.16 * (i % 4), 0.16 * (i / 4 % 3), 0.1 + 0.2 * (i % 11)), Quat(1, 0.1 * (i % 7), 0.2, 0)},
            .name = "body " + std::to_string(i)};
    }

    static Settings settings(ResolutionKind resolution) {
        Settings s = Settings::preset(Preset::performance);
        s.resolution.resolution = resolution;
        return s;
    }

    World world;
    MaterialId oak{}, steel{};
    std::vector<BodyId> bodies;
    SpringId spring;
    JointId hinge;
};

/// One call that changes the world.
struct Call {
    const char* name;
    std::function<void(Yard&)> make;
};

std::vector<Call> everyCall() {
    const auto id = [](const Yard& y) { return y.bodies[7]; };
    return {
        {"addMaterial",
         [](Yard& y) {
             y.world.addMaterial({"ice", 900});
         }},
        {"setDefaultPairProperties", [](Yard& y) { y.world.setDefaultPairProperties({.restitution = 0.9}); }},
        {"setPairProperties", [](Yard& y) { y.world.setPairProperties(y.oak, y.steel, {.restitution = 0.9}); }},
        {"addBody", [](Yard& y) { y.world.addBody(y.body(99)); }},
        {"removeBody", [](Yard& y) { y.world.removeBody(y.bodies[2]); }},
        {"remove and add", [=](Yard& y) { y.world.removeBody(id(y)), y.world.addBody(y.body(98)); }},
        {"setPose",
         [=](Yard& y) {
             y.world.setPose(id(y), {Vec3(0, 0, 3), Quat(0.6, 0.8, 0, 0)});
         }},
        {"setLinearVelocity", [=](Yard& y) { y.world.setLinearVelocity(id(y), Vec3(1, 2, 3)); }},
        {"setAngularVelocity", [=](Yard& y) { y.world.setAngularVelocity(id(y), Vec3(1, 2, 3)); }},
        {"setFixed", [=](Yard& y) { y.world.setFixed(id(y), true); }},
        {"applyForceAt", [=](Yard& y) { y.world.applyForceAt(id(y), Vec3(9, 2, 3), Vec3(0, 1, 0)); }},
        {"applyTorque", [=](Yard& y) { y.world.applyTorque(id(y), Vec3(1, 2, 3)); }},
        {"applyImpulse", [=](Yard& y) { y.world.applyImpulse(id(y), Vec3(1, 2, 3)); }},
        {"a fault",
         [=](Yard& y) {
             for (int i = 0; i < 30; ++i) y.world.applyImpulse(id(y), Vec3(1e30, 0, 0));
         }},
        {"setConstantForce", [=](Yard& y) { y.world.setConstantForce(id(y), Vec3(1, 2, 30)); }},
        {"setConstantTorque", [=](Yard& y) { y.world.setConstantTorque(id(y), Vec3(1, 2, 3)); }},
        {"addSpring", [=](Yard& y) { y.world.addSpring({.a = id(y), .stiffness = 9}); }},
        {"removeSpring", [](Yard& y) { y.world.removeSpring(y.spring); }},
        {"setSpringAnchor", [](Yard& y) { y.world.setSpringAnchor(y.spring, Vec3(0, 0, 1)); }},
        {"addJoint", [=](Yard& y) { y.world.addJoint({.a = id(y), .anchor = Vec3(0, 0, 1)}); }},
        {"removeJoint", [](Yard& y) { y.world.removeJoint(y.hinge); }},
        {"setJointMotor", [](Yard& y) { y.world.setJointMotor(y.hinge, {.speed = 3, .limit = 5}); }},
        {"setJointLimits", [](Yard& y) { y.world.setJointLimits(y.hinge, -0.1, 0.1); }},
        {"setGravity", [](Yard& y) { y.world.setGravity(Vec3(6, 0, -8)); }},
        {"setGlobalAcceleration", [](Yard& y) { y.world.setGlobalAcceleration(Vec3(3, 0, 2)); }},
        {"setEventLevel", [](Yard& y) { y.world.setEventLevel(EventLevel::none); }},
        {"setSettings",
         [](Yard& y) {
             Settings s = y.world.settings();
             s.steps_per_second = 300;
             s.parallel = {2, true};
             s.resolution.resolution = ResolutionKind::sweep;
             s.correction.correction = CorrectionKind::none;
             y.world.setSettings(s);
         }},
    };
}

TEST(Moments, EveryCallAfterwardsIsUndone) {
    for (const Call& call : everyCall()) {
        Yard yard;
        for (int i = 0; i < 60; ++i) yard.world.step();
        // The first moment leaves behind what the second one shares.
        RollbackState moment;
        for (int i = 0; i < 2; ++i) yard.world.keep(moment);
        const Bytes before = yard.world.save();
        for (int i = 0; i < 5; ++i) yard.world.step();
        const Bytes later = yard.world.save();
        yard.world.load(moment);
        call.make(yard);
        yard.world.step();
        EXPECT_FALSE(yard.world.save() == before) << call.name;
        yard.world.load(moment);
        ASSERT_TRUE(yard.world.save() == before) << call.name;
        for (int i = 0; i < 5; ++i) yard.world.step();
        ASSERT_TRUE(yard.world.save() == later) << call.name;
    }
}

TEST(Moments, WhatIsCalledBeforeThemIsKept) {
    for (const Call& call : everyCall()) {
        Yard yard;
        RollbackState earlier;
        yard.world.keep(earlier);
        for (int i = 0; i < 30; ++i) yard.world.step();
        call.make(yard);
        RollbackState moment;
        yard.world.keep(moment);
        const Bytes before = yard.world.save();
        yard.world.load(earlier);
        for (int i = 0; i < 3; ++i) yard.world.step();
        yard.world.load(moment);
        ASSERT_TRUE(yard.world.save() == before) << call.name;
    }
}

/// A restored world finds everything anew; one that went on keeps the contacts of pairs of which no pose changed.
TEST(Pairs, AreFoundAsIfAnewAfterEveryCall) {
    std::vector<Call> calls = everyCall();
    calls.push_back({"contact_margin", [](Yard& y) {
                         Settings s = y.world.settings();
                         s.detection.contact_margin = 0.01;
                         y.world.setSettings(s);
                     }});
    calls.push_back({"setFixed twice", [](Yard& y) {
                         for (const bool fixed : {true, false}) {
                             for (const BodyId id : y.bodies) y.world.setFixed(id, fixed);
                             for (int i = 0; i < 3; ++i) y.world.step();
                         }
                     }});
    Yard yard(ResolutionKind::accelerated_sweeps);
    for (int i = 0; i < 500; ++i) yard.world.step();
    ASSERT_GT(yard.world.statistics().asleep, 10) << "there must be something still";
    RollbackState settled;
    yard.world.keep(settled);
    for (const Call& call : calls) {
        yard.world.load(settled);
        for (int i = 0; i < 3; ++i) yard.world.step();
        call.make(yard);
        for (int i = 0; i < 20; ++i) {
            World restored = World::restore(yard.world.save());
            yard.world.step();
            restored.step();
            ASSERT_TRUE(yard.world.save() == restored.save()) << call.name << ", step " << i;
        }
    }
}

/// What is done to the world from outside, by the number of the step alone.
void act(Yard& yard) {
    World& world = yard.world;
    const auto step = static_cast<int>(world.stepCount());
    const std::vector<BodyId> ids = world.bodies();
    if (step % 17 == 5 && ids.size() > 8) world.removeBody(ids[8 + static_cast<std::size_t>(step) % 7]);
    if (step % 23 == 7) world.addBody(yard.body(step));
    if (step % 5 == 3) world.applyForce(ids.back(), Vec3(3, 0, 0));
    if (step == 130) world.setGravity(Vec3(1, 0, -9));
}

class RollingBack : public testing::TestWithParam<ResolutionKind> {};

TEST_P(RollingBack, SixtyStepsAgainAndAgainGivesTheSameBits) {
    Yard yard(GetParam());
    std::vector<RollbackState> ring(60);
    std::vector<Bytes> straight;
    for (int i = 0; i < 180; ++i) {
        straight.push_back(yard.world.save());
        yard.world.keep(ring[static_cast<std::size_t>(i) % 60]);
        act(yard);
        yard.world.step();
    }
    for (int again = 0; again < 2; ++again) {
        yard.world.load(ring[0]);
        ASSERT_EQ(yard.world.stepCount(), 120);
        for (std::size_t i = 120; i < 180; ++i) {
            ASSERT_TRUE(yard.world.save() == straight[i]) << i;
            yard.world.keep(ring[i % 60]);
            act(yard);
            yard.world.step();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Resolutions, RollingBack,
                         testing::Values(ResolutionKind::impulse_queue, ResolutionKind::accelerated_sweeps));

TEST(Moments, FitAnotherWorldAndLeaveWhatWatchesIt) {
    Yard yard;
    for (int i = 0; i < 40; ++i) yard.world.step();
    RollbackState moment;
    yard.world.keep(moment);
    World other;
    other.setTracing(Tracing::on);
    other.load(moment);
    EXPECT_TRUE(other.save() == yard.world.save());
    EXPECT_EQ(other.trace(yard.bodies[0]).level, -1) << "no step of this world has seen the body";
    other.step();
    yard.world.step();
    EXPECT_TRUE(other.save() == yard.world.save());
    EXPECT_GE(other.trace(yard.bodies[0]).level, 0) << "steps are still traced";
}

TEST(Moments, OfOneWorldDoNotDependOnItsEnd) {
    RollbackState moment;
    Bytes before;
    {
        Yard yard;
        for (int i = 0; i < 40; ++i) yard.world.step();
        yard.world.keep(moment);
        before = yard.world.save();
    }
    const RollbackState moved = std::move(moment);
    World world;
    world.load(moved);
    EXPECT_TRUE(world.save() == before);
}

TEST(Moments, AnEmptyOneIsRefused) {
    Yard yard;
    const Bytes before = yard.world.save();
    EXPECT_THROW(yard.world.load(RollbackState()), InputError);
    EXPECT_TRUE(yard.world.save() == before);
}

}  // namespace
}  // namespace cairn
