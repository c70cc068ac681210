/// Worlds that ranks share from the start, so that none of them ever has all bodies.
#include <gtest/gtest.h>

#include <atomic>
#include <span>
#include <string>
#include <vector>

#include "shared_worlds.h"

namespace cairn {
namespace {

BodyDescription described(const SceneBody& body, MaterialId material) {
    BodyDescription description;
    description.shape = body.shape;
    description.material = material;
    description.name = body.name;
    description.pose = {body.position, body.orientation};
    description.linear_velocity = body.linear_velocity;
    description.fixed = body.fixed;
    description.motion = body.motion;
    return description;
}

/// Adds what falls onto ground and onto a plate that moves. @return the ids
std::vector<BodyId> addFalling(World& world, MaterialId material, int count) {
    std::vector<BodyId> ids;
    const Scene scene = row(count);
    for (SceneBody body : scene.bodies) {
        body.name = "number " + std::to_string(ids.size());
        if (ids.size() % 3 == 1) body.shape = Box{{0.2, 0.3, 0.2}};
        if (ids.size() == 5) body.linear_velocity = {40, 3, 0};
        ids.push_back(world.addBody(described(body, material)));
        if (ids.size() != 4) continue;
        body.shape = Box{{0.5, 0.5, 0.05}};
        body.fixed = true;
        body.motion = SineMotion{.amplitude = {0, 0, 0.05}, .frequency = 1};
        body.linear_velocity.setZero();
        body.position.z() = 0;
        ids.push_back(world.addBody(described(body, material)));
    }
    return ids;
}

TEST(DealtWorld, DealsOutBodiesThatNoRankHasAllOf) {
    const auto begin = [](World& world) {
        world.setGravity({0, 0, -9.81});
        return world.addMaterial({"stone", 2500});
    };
    World alone(Settings::preset(Preset::performance));
    const std::vector<BodyId> ids = addFalling(alone, begin(alone), 16);
    std::vector<Vec3> places;
    for (const BodyId id : ids) places.push_back(alone.pose(id).position);
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < 120; ++i) {
        alone.step();
        hashes.push_back(alone.stateHash());
    }
    for (const Partition& partition : {Partition{}, Partition{.kind = PartitionKind::x}, by_hash, restless}) {
        for (const int count : {1, 3}) {
            runRanks(count, [&](Ranks& ranks) {
                World world(Settings::preset(Preset::performance));
                const MaterialId material = begin(world);
                world.share(ranks, partition, std::span(places).subspan(1));
                EXPECT_EQ(addFalling(world, material, 16), ids);
                for (int i = 0; i < 120; ++i) {
                    world.step();
                    ASSERT_EQ(sumOverRanks(ranks, world.stateHash()), hashes[static_cast<std::size_t>(i)]) << i;
                }
                world.gather();
                EXPECT_TRUE(world.save() == alone.save());
            });
        }
    }
}

TEST(DealtWorld, DealsOutWhatIsGatheredBeforeAStep) {
    World alone(Settings::preset(Preset::performance));
    addFalling(alone, alone.addMaterial({"stone", 2500}), 8);
    runRanks(3, [&](Ranks& ranks) {
        World world(Settings::preset(Preset::performance));
        const MaterialId material = world.addMaterial({"stone", 2500});
        world.share(ranks, by_hash, {});
        addFalling(world, material, 8);
        EXPECT_EQ(world.sums().state_hash, alone.stateHash());
        EXPECT_LT(world.bodyCount(), 9U);
        world.gather();
        EXPECT_TRUE(world.save() == alone.save());
        EXPECT_NE(world.addBody(described(ballAt({0, 9, 1}), material)), BodyId{});
    });
}

TEST(DealtWorld, RefusesToDealOutWhatOthersWouldHaveToKnow) {
    runRanks(2, [&](Ranks& ranks) {
        World world(Settings::preset(Preset::performance));
        const MaterialId material = world.addMaterial({"stone", 2500});
        const Vec3 far(2e12, 0, 0);
        EXPECT_NE(errorOf([&] { world.share(ranks, {}, std::span(&far, 1)); }).find("a place"), std::string::npos);
        world.share(ranks, {}, {});
        EXPECT_NE(errorOf([&] { world.addMaterial({"oak", 800}); }), "no error");
        BodyDescription body = described(ballAt(Vec3::Zero()), material);
        body.locked = {JointAlong::x};
        EXPECT_NE(errorOf([&] { world.addBody(body); }).find("without places"), std::string::npos);
        body.locked.clear();
        body.shape = ConvexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
        EXPECT_NE(errorOf([&] { world.addBody(body); }).find("that moves cannot be dealt out"), std::string::npos);
        body.fixed = true;
        EXPECT_TRUE(world.contains(world.addBody(body)));
        // A mass that nobody can reckon with fails on all ranks, and leaves a slot that the next body takes.
        body.fixed = false;
        body.shape = Sphere{0.1};
        body.mass = 1e-300;
        EXPECT_NE(errorOf([&] { world.addBody(body); }), "no error");
        body.mass.reset();
        EXPECT_EQ(world.addBody(body), (BodyId{1, 1}));
        EXPECT_NE(errorOf([&] { world.share(ranks, {}, {}); }), "no error");
        world.step();
        EXPECT_EQ(sumOverRanks(ranks, std::uint64_t{world.bodyCount()}), 3U) << "the hull is on both ranks";
        EXPECT_NE(errorOf([&] { world.addBody(body); }), "no error");
    });
}

TEST(DealtWorld, LetsBodiesMeetAndPartAcrossCutsAllTheTime) {
    // Most steps bring some of a gas to another rank, and most of these need no comparison after that.
    const SceneSource gas = builtInSource("gas:1500");
    for (const int ranks : {2, 4, 7}) expectSameSteps(gas, 200, {}, ranks);
    expectSameSteps(gas, 120, {.kind = PartitionKind::x, .rebalance_every = 50}, 4);
    // Piles apart from each other, none of which lies in the way of a cut.
    expectSameSteps(builtInSource("pits:9:25"), 150, {}, 4);
}

TEST(DealtWorld, DealsOutTheBodiesOfScenes) {
    for (const char* name : {"stacks5", "heap:60"}) {
        const Scene scene = builtInScene(name);
        const std::size_t bodies = scene.bodies.size();
        runRanks(3, [&](Ranks& ranks) {
            SceneRun run(scene, settingsFor(scene), ranks, by_hash);
            EXPECT_TRUE(run.world().isDivided());
            EXPECT_LT(run.world().bodyCount(), bodies);
            EXPECT_EQ(run.ids().size(), bodies);
        });
        for (const Partition& partition : {Partition{}, by_hash, restless}) expectSameSteps(scene, 90, partition);
    }
    for (const char* name : {"heap:60", "pits:3:15", "bed:5:4:3"}) {
        const SceneSource source = builtInSource(name);
        runRanks(3, [&](Ranks& ranks) {
            const SceneRun run(source, settingsFor(source), ranks, by_hash);
            EXPECT_TRUE(run.scene().bodies.empty());
            EXPECT_LT(run.world().bodyCount(), run.ids().size());
        });
        for (const Partition& partition : {Partition{}, restless}) expectSameSteps(source, 60, partition);
    }
    // Others are divided by the first step.
    const Scene chain = builtInScene("cradle_swing:5:2");
    runRanks(2, [&](Ranks& ranks) {
        SceneRun run(chain, settingsFor(chain), ranks);
        EXPECT_FALSE(run.world().isDivided());
        run.step();
        EXPECT_TRUE(run.world().isDivided());
    });
}

/// What ranks saved of a run.
struct Saved {
    std::vector<SavedPart> parts;
    SavedPart common;

    ReadPart reader() const {
        return [this](std::size_t rank) { return parts.at(rank); };
    }
};

/// Steps a scene on ranks and saves it. @param change what is done to the whole world before
template <class Change>
Saved savedAfter(int steps, const SceneSource& source, int count, const Partition& partition, const Change& change) {
    Saved saved{std::vector<SavedPart>(static_cast<std::size_t>(count)), {{}, "common"}};
    runRanks(count, [&](Ranks& ranks) {
        SceneRun run(source, settingsFor(source), ranks, partition);
        run.world().gather();
        change(run);
        for (int i = 0; i < steps; ++i) run.step();
        saved.parts[static_cast<std::size_t>(ranks.rank())] = {run.world().savePart(), "part"};
        if (ranks.rank() == 0) saved.common.bytes = run.saveCommon();
    });
    return saved;
}

/// A scene with a body that fails, a sensor, a plate that moves and a hole.
Scene eventful() {
    Scene scene = row(12);
    SceneBody plate = scene.bodies[3];
    plate.shape = Box{{0.5, 0.5, 0.05}};
    plate.fixed = true;
    plate.motion = SineMotion{.amplitude = {0, 0, 0.05}, .frequency = 1};
    plate.position.z() = 0;
    scene.bodies.insert(scene.bodies.begin() + 4, plate);
    scene.bodies[7].sensor = true;
    scene.events.push_back({0.02, RemoveBody{5}});
    scene.events.push_back({0.35, SetGravity{{1, 0, -5}}});
    return scene;
}

TEST(DealtWorld, GoesOnFromSomeOfThePartsOnEachRank) {
    const SceneSource source = eventful();
    const auto change = [](SceneRun& run) { run.world().setEventLevel(EventLevel::all); };
    SceneRun alone(source, settingsFor(source));
    change(alone);
    for (int i = 0; i < 100; ++i) alone.step();
    for (const Partition& partition : {Partition{}, by_hash, restless}) {
        const Saved saved = savedAfter(40, source, 4, partition, change);
        for (const int count : {1, 2, 3, 4, 6}) {
            std::atomic<std::size_t> read = 0;
            runRanks(count, [&](Ranks& ranks) {
                const auto part = [&](std::size_t rank) {
                    ++read;
                    return saved.parts.at(rank);
                };
                SceneRun run = SceneRun::restoreParts(source, saved.common, part, ranks, partition);
                EXPECT_TRUE(run.world().isDivided());
                run.world().setSettings(run.world().settings());
                for (int i = 40; i < 100; ++i) run.step();
                EXPECT_EQ(run.world().sums().state_hash, alone.world().stateHash());
                run.world().gather();
                EXPECT_TRUE(run.save() == alone.save()) << count;
            });
            EXPECT_EQ(read, 4U) << "each part is read by one rank";
        }
        EXPECT_EQ(SceneRun::restoreParts(source, saved.common, saved.reader()).world().stepCount(), 40);
    }
}

TEST(DealtWorld, GoesOnFromPartsOfTheBeginningAndOfAFault) {
    Scene scene = row(9);
    const auto unchanged = [](const SceneRun&) {};
    const auto push = [](SceneRun& run) { run.world().applyForce(run.ids()[4], {1e30, 0, 0}); };
    const auto expectSame = [&](int steps, std::size_t faults, const auto& change) {
        SceneRun alone(scene, settingsFor(scene));
        change(alone);
        for (int i = 0; i < steps + 20; ++i) alone.step();
        EXPECT_EQ(alone.world().faults().size(), faults);
        const Saved saved = savedAfter(steps, scene, 3, by_hash, change);
        runRanks(2, [&](Ranks& ranks) {
            SceneRun run = SceneRun::restoreParts(scene, saved.common, saved.reader(), ranks);
            for (int i = 0; i < 20; ++i) run.step();
            EXPECT_EQ(run.world().sums().state_hash, alone.world().stateHash());
            run.world().gather();
            EXPECT_TRUE(run.save() == alone.save());
        });
    };
    expectSame(3, 0, unchanged);
    // Only the rank that has the body knows yet that it was fixed.
    expectSame(1, 1, push);
    Saved saved;
    saved.parts.resize(3);
    runRanks(3, [&](Ranks& ranks) {
        const SceneRun run(scene, settingsFor(scene), ranks, by_hash);
        saved.parts[static_cast<std::size_t>(ranks.rank())] = {run.world().savePart(), "part"};
        if (ranks.rank() == 0) saved.common = {run.saveCommon(), "common"};
    });
    SceneRun alone(scene, settingsFor(scene));
    for (int i = 0; i < 20; ++i) alone.step();
    runRanks(2, [&](Ranks& ranks) {
        SceneRun run = SceneRun::restoreParts(scene, saved.common, saved.reader(), ranks);
        for (int i = 0; i < 20; ++i) run.step();
        run.world().gather();
        EXPECT_TRUE(run.save() == alone.save());
    });
}

TEST(DealtWorld, IsReadAsAWholeWhereThingsNameBodies) {
    const Scene chain = builtInScene("cradle_swing:5:2");
    SceneRun alone(chain, settingsFor(chain));
    for (int i = 0; i < 60; ++i) alone.step();
    const Saved saved = savedAfter(30, chain, 2, by_hash, [](const SceneRun&) {});
    runRanks(3, [&](Ranks& ranks) {
        SceneRun run = SceneRun::restoreParts(chain, saved.common, saved.reader(), ranks, by_hash);
        EXPECT_FALSE(run.world().isDivided());
        for (int i = 0; i < 30; ++i) run.step();
        EXPECT_EQ(run.world().sums().state_hash, alone.world().stateHash());
    });
}

}  // namespace
}  // namespace cairn
