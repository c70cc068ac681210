/// Worlds that ranks share: scenes that move by laws, faults, what users do between steps, and what is refused.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "shared_worlds.h"

namespace cairn {
namespace {

class LawsAndMachines : public testing::TestWithParam<const char*> {};

TEST_P(LawsAndMachines, GiveTheSameStatesOnAnyNumberOfRanks) {
    expectSameSteps(builtInScene(GetParam()), 60, {});
    expectSameSteps(builtInScene(GetParam()), 60, restless);
}

// An earthquake, a turning drum with a belt, a sensor, and drives of joints.
INSTANTIATE_TEST_SUITE_P(Scenes, LawsAndMachines,
                         testing::Values("shake_table", "drum", "rockfall", "excavator", "cradle_swing:5:2"));

TEST(SharedWorld, KeepsWhatSpringsConnectTogether) {
    Scene scene = row(8);
    scene.springs.push_back(
        {.a = 1, .b = 8, .anchor_b = Vec3::Zero(), .stiffness = 300, .damping = 1, .rest_length = 3});
    scene.springs.push_back({.a = 3, .b = {}, .anchor_b = {1, 1, 1}, .stiffness = 100, .damping = 1});
    expectSameSteps(scene, 120, {.kind = PartitionKind::x});
    expectSameSteps(scene, 120, restless);
}

TEST(SharedWorld, DrivesBodiesWhereTheyAre) {
    Scene scene = row(8);
    scene.drives.push_back({.what = DriveOf::force, .target = 3, .law = ConstantMotion{.velocity = {60, 5, 0}}});
    scene.drives.push_back({.what = DriveOf::torque, .target = 6, .law = ConstantMotion{.velocity = {0, -2, 0}}});
    for (const Partition& partition : {Partition{.kind = PartitionKind::x}, by_hash, restless}) {
        expectSameSteps(scene, 120, partition);
    }
}

TEST(SharedWorld, KeepsWhatAGearCouplesTogether) {
    Scene scene = row(6);
    const auto wheel = [&](double x) {
        SceneBody box = ballAt({x, 2, 2});
        box.shape = Box{{0.4, 0.1, 0.4}};
        scene.bodies.push_back(box);
        JointDescription hinge{.kind = JointKind::hinge, .anchor = {x + 0.1, 2, 2}, .axis = Vec3::UnitY()};
        scene.joints.push_back({scene.bodies.size() - 1, {}, hinge});
    };
    wheel(0);
    wheel(5);
    SceneJoint gear;
    gear.joint.kind = JointKind::gear;
    gear.joint.ratio = -2;
    gear.first = 0;
    gear.second = 1;
    scene.joints.push_back(gear);
    expectSameSteps(scene, 120, {.kind = PartitionKind::x});
    expectSameSteps(scene, 120, restless);
}

TEST(SharedWorld, TakesBodiesLargerThanARegionAndSuchAsCrossSeveralInAStep) {
    Scene scene = row(17);
    SceneBody beam = ballAt({4, 0.3, 2.5});
    beam.shape = Box{{7, 0.3, 0.1}};
    beam.linear_velocity = {-1, 0, -3};
    scene.bodies.push_back(beam);
    SceneBody ledge = ballAt({4, -1, 0.2});
    ledge.shape = Box{{9, 0.4, 0.4}};
    ledge.fixed = true;
    scene.bodies.push_back(ledge);
    SceneBody bullet = ballAt({-6, 0, 1.6});
    bullet.linear_velocity = {500, 0, 0};
    scene.bodies.push_back(bullet);
    bullet.position = {13, 0.3, 2.4};
    bullet.linear_velocity = {-450, 0, -20};
    scene.bodies.push_back(bullet);
    for (const PartitionKind kind : {PartitionKind::x, PartitionKind::boxes, PartitionKind::hash}) {
        expectSameSteps(scene, 60, {.kind = kind}, 8);
    }
    expectSameSteps(scene, 60, {.kind = PartitionKind::x, .rebalance_every = 1}, 8);
}

TEST(SharedWorld, HasBodiesOnOneRankEach) {
    const Scene scene = row(12);
    std::atomic<int> here = 0;
    runRanks(4, [&](Ranks& ranks) {
        SceneRun run(scene, settingsFor(scene));
        run.world().share(ranks, {.kind = PartitionKind::x});
        run.step();
        int own = 0;
        for (std::size_t i = 1; i <= 12; ++i) {
            if (!run.world().contains(run.ids()[i])) continue;
            ++own;
            EXPECT_EQ((static_cast<int>(i) - 1) / 3, ranks.rank());
        }
        EXPECT_TRUE(run.world().contains(run.ids()[0]));
        EXPECT_EQ(own, 3);
        here += own;
    });
    EXPECT_EQ(here, 12);
}

TEST(SharedWorld, TakesNamesFiltersAndShapesOfAllKindsAlong) {
    Scene scene = row(6);
    const ConvexHull wedge({{0, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}});
    const Compound dumbbell{{{.shape = Sphere{0.1}, .pose = {{-0.2, 0, 0}, Quat::Identity()}},
                             {.shape = Sphere{0.15}, .pose = {{0.2, 0, 0}, Quat::Identity()}}}};
    double x = 0;
    for (const Shape& shape : {Shape(Box{{0.2, 0.3, 0.4}}), Shape(Capsule{0.1, 0.3}), Shape(Cylinder{0.1, 0.3}),
                               Shape(wedge), Shape(wedge), Shape(dumbbell), Shape(dumbbell)}) {
        SceneBody body = ballAt({x += 0.4, 0.1, 0.6});
        body.shape = shape;
        body.name = "body at " + std::to_string(x);
        body.user_data = scene.bodies.size();
        scene.bodies.push_back(body);
    }
    scene.filters.exceptions = {{3, 8, Touch::never}, {7, 12, Touch::never}};
    for (const Partition& partition : {Partition{}, by_hash, restless}) expectSameSteps(scene, 120, partition);
}

/// What a user does to a world in the middle of a run.
void meddle(SceneRun& run) {
    World& world = run.world();
    world.removeBody(run.ids()[2]);
    BodyDescription description;
    description.shape = Box{Vec3::Constant(0.3)};
    description.pose.position = {1.5, 0, 0.8};
    const BodyId box = world.addBody(description);
    world.addJoint({.kind = JointKind::distance,
                    .a = box,
                    .b = run.ids()[5],
                    .anchor = {1.5, 0, 0.8},
                    .anchor_b = Vec3(2, 0, 0.1)});
    world.setPose(run.ids()[7], {{0.1, 0, 0.6}, Quat::Identity()});
    world.applyImpulse(run.ids()[4], {3, 1, 0});
    world.setConstantForce(run.ids()[6], {-5, 0, 0});
    world.setFixed(run.ids()[8], true);
}

TEST(SharedWorld, TakesCallsOnceItIsGathered) {
    const Scene scene = row(8);
    SceneRun alone(scene, settingsFor(scene));
    for (int i = 0; i < 60; ++i) alone.step();
    meddle(alone);
    for (int i = 0; i < 120; ++i) alone.step();
    for (const Partition& partition : {Partition{}, by_hash, restless}) {
        runRanks(3, [&](Ranks& ranks) {
            SceneRun run(scene, settingsFor(scene));
            run.world().share(ranks, partition);
            for (int i = 0; i < 60; ++i) run.step();
            EXPECT_THROW(meddle(run), InputError);
            run.world().gather();
            meddle(run);
            for (int i = 0; i < 120; ++i) run.step();
            run.world().gather();
            EXPECT_TRUE(run.world().save() == alone.world().save());
        });
    }
}

/// What a step tells besides the state.
struct Told {
    std::vector<Event> events;
    Diagnostics diagnostics;
    WorldSums sums;
};

Told toldBy(const World& world) {
    const std::span<const Event> events = world.events();
    return {{events.begin(), events.end()}, world.statistics().diagnostics, world.sums()};
}

void expectEqual(const Event& one, const Event& other) {
    EXPECT_EQ(one.kind, other.kind);
    EXPECT_EQ(one.reason, other.reason);
    EXPECT_EQ(one.a, other.a);
    EXPECT_EQ(one.b, other.b);
    EXPECT_EQ(one.contacts, other.contacts);
    EXPECT_EQ(one.point, other.point);
    EXPECT_EQ(one.normal, other.normal);
    EXPECT_EQ(one.distance, other.distance);
    EXPECT_EQ(one.impulse, other.impulse);
    EXPECT_EQ(one.joint, other.joint);
}

void expectEqual(const WorldSums& one, const WorldSums& other) {
    EXPECT_EQ(one.kinetic_energy, other.kinetic_energy);
    EXPECT_EQ(one.potential_energy, other.potential_energy);
    EXPECT_EQ(one.linear_momentum, other.linear_momentum);
    EXPECT_EQ(one.angular_momentum, other.angular_momentum);
    EXPECT_EQ(one.mean_overlap, other.mean_overlap);
    EXPECT_EQ(one.asleep, other.asleep);
    EXPECT_EQ(one.state_hash, other.state_hash);
}

void expectEqual(Told one, Told other) {
    ASSERT_EQ(one.events.size(), other.events.size());
    for (std::size_t i = 0; i < one.events.size(); ++i) expectEqual(one.events[i], other.events[i]);
    expectEqual(one.sums, other.sums);
    for (const DiagnosticsField& field : diagnosticsFields()) {
        EXPECT_EQ(field.of(one.diagnostics), field.of(other.diagnostics)) << field.name;
    }
}

/// Lets a scene run on three ranks, and a user meddle in the middle, and expects what one rank tells. @return what was
/// told in all steps
template <class Meddle>
std::vector<Event> expectSameTold(const Scene& scene, int steps, const Meddle& meddleWith, const Partition& partition) {
    const auto begin = [&] {
        Settings settings = settingsFor(scene);
        settings.diagnostics.diagnostics = true;
        SceneRun run(scene, settings);
        run.world().setEventLevel(EventLevel::all);
        return run;
    };
    SceneRun alone = begin();
    std::vector<Told> told;
    for (int i = 0; i < steps; ++i) {
        if (i == steps / 2) meddleWith(alone);
        alone.step();
        told.push_back(toldBy(alone.world()));
    }
    runRanks(3, [&](Ranks& ranks) {
        SceneRun run = begin();
        run.world().share(ranks, partition);
        for (int i = 0; i < steps; ++i) {
            SCOPED_TRACE("time step " + std::to_string(i + 1));
            if (i == steps / 2) {
                run.world().gather();
                meddleWith(run);
            }
            run.step();
            expectEqual(toldBy(run.world()), told[static_cast<std::size_t>(i)]);
            if (testing::Test::HasFailure()) return;
        }
        run.world().gather();
        expectEqual(toldBy(run.world()), told.back());
        EXPECT_TRUE(run.world().save() == alone.world().save());
    });
    std::vector<Event> all;
    for (const Told& one : told) all.insert(all.end(), one.events.begin(), one.events.end());
    return all;
}

bool holds(const std::vector<Event>& events, EventKind kind) {
    return std::ranges::any_of(events, [&](const Event& event) { return event.kind == kind; });
}

TEST(SharedWorld, TellsEventsAndMeasuresAsOneRankDoes) {
    using enum EventKind;
    const auto nothing = [](SceneRun&) {};
    for (const Partition& partition : {Partition{}, by_hash, restless}) {
        // With a user's calls, removed bodies, and one that is fixed by a fault.
        Scene scene = row(8);
        scene.bodies.push_back(ballAt({0.02, 0, 0.8}));
        SceneBody gate = ballAt({1.75, 0, 0.1});
        gate.shape = Box{{0.6, 0.4, 0.3}};
        gate.sensor = true;
        gate.fixed = true;
        scene.bodies.push_back(gate);
        scene.events.push_back({0.75, SetForce{4, {1e20, 0, 0}}});
        const std::vector<Event> events = expectSameTold(scene, 240, meddle, partition);
        for (const EventKind kind : {contact_begun, contact_persisted, contact_ended, fell_asleep, woke, frozen,
                                     sensor_entered, sensor_left}) {
            EXPECT_TRUE(holds(events, kind)) << static_cast<int>(kind);
        }
        // A joint that breaks, another that holds, and springs.
        Scene hung = row(6);
        hung.joints.push_back({2, 1, {.kind = JointKind::ball, .anchor = {0.25, 0, 0.2}, .break_force = 30}});
        hung.joints.push_back({4, {}, {.kind = JointKind::ball, .anchor = {1.5, 0, 1}}});
        hung.springs.push_back({.a = 3, .b = 6, .anchor_b = Vec3::Zero(), .stiffness = 300, .damping = 1});
        EXPECT_TRUE(holds(expectSameTold(hung, 120, nothing, partition), joint_broke));
        expectSameTold(builtInScene("stacks5"), 60, nothing, partition);
        expectSameTold(builtInScene("drum"), 30, nothing, partition);
    }
}

TEST(SharedWorld, KnowsABodyThatFailedOnAllRanks) {
    Scene scene = row(8);
    // Comes by in the step in which it leaves the limits of speed, and is then in the way of others.
    scene.events.push_back({0.05, SetForce{4, {1e20, 0, 0}}});
    SceneRun alone(scene, settingsFor(scene));
    for (int i = 0; i < 60; ++i) alone.step();
    ASSERT_EQ(alone.world().faults().size(), 1U);
    for (const Partition& partition : {Partition{}, restless}) {
        runRanks(3, [&](Ranks& ranks) {
            SceneRun run(scene, settingsFor(scene));
            run.world().share(ranks, partition);
            for (int i = 0; i < 60; ++i) run.step();
            EXPECT_TRUE(run.world().contains(run.ids()[4])) << "what is fixed is on all ranks";
            EXPECT_EQ(sumOverRanks(ranks, run.world().stateHash()), alone.world().stateHash());
            run.world().gather();
            ASSERT_EQ(run.world().faults().size(), 1U);
            EXPECT_EQ(run.world().faults()[0].what, alone.world().faults()[0].what);
            EXPECT_EQ(run.world().stateHash(), alone.world().stateHash());
        });
    }
}

TEST(SharedWorld, GoesOnFromASnapshotOfAllRanksOnOthers) {
    const Scene scene = builtInScene("stacks5");
    SceneRun alone(scene, settingsFor(scene));
    for (int i = 0; i < 100; ++i) alone.step();
    std::vector<std::byte> snapshot;
    runRanks(4, [&](Ranks& ranks) {
        SceneRun run(scene, settingsFor(scene));
        run.world().share(ranks, by_hash);
        for (int i = 0; i < 50; ++i) run.step();
        run.world().gather();
        if (ranks.rank() == 0) snapshot = run.save();
    });
    for (const int count : {1, 2, 5}) {
        runRanks(count, [&](Ranks& ranks) {
            SceneRun run = SceneRun::restore(snapshot);
            run.world().share(ranks, {.kind = PartitionKind::y});
            for (int i = 0; i < 50; ++i) run.step();
            EXPECT_EQ(sumOverRanks(ranks, run.world().stateHash()), alone.world().stateHash());
        });
    }
}

TEST(SharedWorld, GoesOnFromThePartsOfAllRanksOnOthers) {
    // With joints that hold and break, springs, a sensor, a body fixed by a fault, removed ones and new ones.
    Scene scene = row(10);
    scene.joints.push_back({2, 1, {.kind = JointKind::ball, .anchor = {0.25, 0, 0.2}, .break_force = 30}});
    scene.joints.push_back({9, {}, {.kind = JointKind::ball, .anchor = {4, 0, 1}}});
    scene.springs.push_back({.a = 3, .b = 6, .anchor_b = Vec3::Zero(), .stiffness = 300, .damping = 1});
    SceneBody gate = ballAt({1.75, 0, 0.1});
    gate.shape = Box{{0.6, 0.4, 0.3}};
    gate.sensor = true;
    gate.fixed = true;
    scene.bodies.push_back(gate);
    scene.events.push_back({0.2, SetForce{4, {1e20, 0, 0}}});
    Settings settings = settingsFor(scene);
    settings.diagnostics.diagnostics = true;
    SceneRun alone(scene, settings);
    alone.world().setEventLevel(EventLevel::all);
    const auto go = [](SceneRun& run, int steps) {
        for (int i = 0; i < steps; ++i) run.step();
    };
    go(alone, 30);
    meddle(alone);
    go(alone, 50);
    for (const Partition& partition : {Partition{}, by_hash, restless}) {
        std::vector<SavedPart> parts(4);
        SavedPart common{{}, "common"};
        runRanks(4, [&](Ranks& ranks) {
            SceneRun run(scene, settings);
            run.world().setEventLevel(EventLevel::all);
            run.world().share(ranks, partition);
            go(run, 30);
            run.world().gather();
            EXPECT_THROW(run.world().savePart(), InputError);
            EXPECT_THROW(run.saveCommon(), InputError);
            meddle(run);
            go(run, 50);
            parts[static_cast<std::size_t>(ranks.rank())] = {run.world().savePart(), "part"};
            if (ranks.rank() == 0) common.bytes = run.saveCommon();
        });
        const auto restored = [&] {
            return SceneRun::restoreParts(scene, common, [&](std::size_t rank) { return parts.at(rank); });
        };
        EXPECT_TRUE(restored().save() == alone.save());
        std::swap(parts[1], parts[2]);
        EXPECT_THROW(restored(), InputError);
        parts[1] = parts[2];
        EXPECT_THROW(restored(), InputError);
        parts[1].bytes.pop_back();
        EXPECT_THROW(restored(), InputError);
    }
}

TEST(SharedWorld, RefusesWhatItCannotDo) {
    const Scene scene = row(4);
    runRanks(2, [&](Ranks& ranks) {
        SceneRun run(scene, settingsFor(scene));
        World& world = run.world();
        EXPECT_EQ(errorOf([&] {
                      world.share(ranks, {.kind = PartitionKind::grid, .parts = {3, 1, 1}});
                  }),
                  "a cut into 3x1x1 regions is not one for 2 ranks; their product must be 2");
        world.share(ranks, {.kind = PartitionKind::x});
        run.step();
        const std::string text =
            "World::castRay needs all bodies, and the world is divided among 2 ranks: call World::gather() on all of "
            "them first";
        EXPECT_EQ(errorOf([&] { world.castRay({}); }), text);
        EXPECT_NE(errorOf([&] { world.save(); }), "no error");
        EXPECT_NE(errorOf([&] { world.addBody({}); }), "no error");
        const BodyId absent = run.ids()[ranks.rank() == 0 ? 4 : 1];
        EXPECT_NE(errorOf([&] { world.pose(absent); }).find("on another rank"), std::string::npos);
    });
}

TEST(SharedWorld, EndsOnAllRanksWhenOneFails) {
    const Scene scene = row(4);
    EXPECT_THROW(runRanks(3,
                          [&](Ranks& ranks) {
                              SceneRun run(scene, settingsFor(scene));
                              run.world().share(ranks);
                              for (int i = 0; i < 100; ++i) {
                                  if (i == 50 && ranks.rank() == 1) throw IoError("disk full");
                                  run.step();
                              }
                          }),
                 IoError);
}

}  // namespace
}  // namespace cairn
