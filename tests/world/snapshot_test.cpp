/// Snapshots of a world: bit by bit the same future, and damage refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "cairn/world.h"
#include "world/byte_stream.h"

namespace cairn {
namespace {

using Bytes = std::vector<std::byte>;

/// A pile that is poured, pulled by springs, thinned out and grown, by the number of the step alone.
class Pile {
  public:
    explicit Pile(ResolutionKind resolution = ResolutionKind::impulse_queue) : world_(settings(resolution)) {
        oak_ = world_.addMaterial({"oak", 800});
        steel_ = world_.addMaterial({"steel", 7800});
        world_.setDefaultPairProperties({.restitution = 0.2, .static_friction = 0.5, .kinetic_friction = 0.4});
        world_.setPairProperties(oak_, steel_, {.restitution = 0.5, .static_friction = 0.3, .kinetic_friction = 0.3});
        world_.setGravity(Vec3(0, 0, -10));
        world_.setEventLevel(EventLevel::all);
        world_.addBody({.shape = HalfSpace{}, .material = steel_, .fixed = true, .name = "floor"});
        for (int i = 0; i < 60; ++i) add(i);
        // Falls asleep whatever the others do.
        world_.addBody(
            {.shape = Box{Vec3(0.2, 0.2, 0.2)}, .material = oak_, .pose = {Vec3(3, 3, 0.1), Quat::Identity()}});
        const std::vector<BodyId> ids = world_.bodies();
        world_.addSpring({.a = ids[1], .b = ids[2], .stiffness = 20, .damping = 1, .rest_length = 0.2});
        world_.addSpring({.a = ids[3], .anchor_b = Vec3(0, 0, 1), .stiffness = 20, .damping = 1, .rest_length = 0.2});
    }

    World& world() { return world_; }

    /// Changes from outside that every copy of the world makes in the same step.
    void act(World& world) const {
        const auto step = static_cast<int>(world.stepCount());
        const std::vector<BodyId> ids = world.bodies();
        if (step % 17 == 5 && ids.size() > 8) world.removeBody(ids[1 + static_cast<std::size_t>(step) % 7]);
        if (step % 23 == 7) world.addBody(body(step));
        if (step % 61 == 11) world.applyForce(ids.back(), Vec3(3, 0, 0));
        if (step == 230) world.setGravity(Vec3(1, 0, -9));
    }

  private:
    static Settings settings(ResolutionKind resolution) {
        Settings s = Settings::preset(Preset::performance);
        s.resolution.resolution = resolution;
        return s;
    }

    BodyDescription body(int i) const {
        BodyDescription d;
        const double size = 0.08 + 0.01 * (i % 5);
        if (i % 3 == 0) d.shape = Sphere{size / 2};
        if (i % 3 == 1) d.shape = Box{Vec3(size, size, 1.5 * size)};
        if (i % 3 == 2) d.shape = Capsule{size / 2, size};
        if (i % 6 == 5) d.shape = Cylinder{size / 2, size};
        d.material = i % 2 == 0 ? oak_ : steel_;
        d.pose = {Vec3(0.13 * (i % 4), 0.13 * (i / 4 % 3), 0.1 + 0.15 * (i % 11)), Quat(1, 0.1 * (i % 7), 0.2, 0)};
        d.name = i % 4 == 0 ? "body " + std::to_string(i) : "";
        return d;
    }
    void add(int i) { world_.addBody(body(i)); }

    World world_;
    MaterialId oak_{}, steel_{};
};

World copyWithThreads(const Bytes& snapshot, std::int64_t threads) {
    World copy = World::restore(snapshot);
    Settings settings = copy.settings();
    settings.parallel = {threads, true};
    copy.setSettings(settings);
    return copy;
}

class Continued : public testing::TestWithParam<ResolutionKind> {};

TEST_P(Continued, IsBitIdenticalAtEveryStepOnAnyNumberOfThreads) {
    Pile pile(GetParam());
    std::vector<World> copies;
    bool slept = false;
    for (int step = 0; step < 260; ++step) {
        if (step == 0 || step == 45 || step == 200) {
            const Bytes snapshot = pile.world().save();
            for (const int threads : {1, 2}) copies.push_back(copyWithThreads(snapshot, threads));
        }
        pile.act(pile.world());
        pile.world().step();
        slept = slept || pile.world().statistics().asleep > 0;
        for (World& copy : copies) {
            pile.act(copy);
            copy.step();
            ASSERT_EQ(copy.stateHash(), pile.world().stateHash()) << "step " << step;
            ASSERT_EQ(copy.bodies(), pile.world().bodies()) << "step " << step;
            ASSERT_EQ(copy.events().size(), pile.world().events().size()) << "step " << step;
        }
    }
    EXPECT_TRUE(slept) << "the sleeping history was not exercised";
    // Threads are a setting and so are in the snapshot; everything else must be equal byte by byte.
    const Bytes last = pile.world().save();
    for (World& copy : copies) {
        copy.setSettings(pile.world().settings());
        EXPECT_TRUE(copy.save() == last);
    }
}

INSTANTIATE_TEST_SUITE_P(Resolutions, Continued,
                         testing::Values(ResolutionKind::impulse_queue, ResolutionKind::sweep,
                                         ResolutionKind::accelerated_sweeps));

TEST(Snapshot, IsWhatTheWorldWas) {
    Pile pile;
    for (int i = 0; i < 150; ++i) {
        pile.act(pile.world());
        pile.world().step();
    }
    const World& world = pile.world();
    const World copy = World::restore(world.save());
    EXPECT_EQ(copy.stateHash(), world.stateHash());
    EXPECT_EQ(copy.time(), world.time());
    EXPECT_EQ(copy.stepCount(), 150);
    EXPECT_EQ(copy.gravity(), world.gravity());
    ASSERT_EQ(copy.bodies(), world.bodies());
    for (const BodyId id : world.bodies()) {
        EXPECT_EQ(copy.name(id), world.name(id));
        EXPECT_EQ(copy.shape(id).index(), world.shape(id).index());
        EXPECT_EQ(copy.mass(id), world.mass(id));
    }
    EXPECT_EQ(copy.materials().size(), 2U);
    EXPECT_EQ(copy.pairProperties(MaterialId{1}, MaterialId{0}).restitution, 0.5);
    ASSERT_FALSE(world.contacts().empty());
    ASSERT_EQ(copy.contacts().size(), world.contacts().size());
    for (std::size_t i = 0; i < world.contacts().size(); ++i) {
        EXPECT_EQ(copy.contacts()[i].a, world.contacts()[i].a);
        EXPECT_EQ(copy.contacts()[i].point, world.contacts()[i].point);
        EXPECT_EQ(copy.contacts()[i].impulse, world.contacts()[i].impulse);
        EXPECT_EQ(copy.contacts()[i].batch, world.contacts()[i].batch);
    }
    EXPECT_EQ(copy.batches().size(), world.batches().size());
    EXPECT_EQ(copy.statistics().contacts, world.statistics().contacts);
    ASSERT_EQ(copy.events().size(), world.events().size());
    EXPECT_EQ(copy.eventLevel(), EventLevel::all);
}

TEST(Snapshot, KeepsFaultsAndStaleIdsStale) {
    Pile pile;
    const BodyId first = pile.world().bodies()[5];
    const BodyId second = pile.world().bodies()[6];
    pile.world().removeBody(first);
    for (int i = 0; i < 30; ++i) pile.world().applyImpulse(second, Vec3(1e30, 0, 0));
    pile.world().step();
    ASSERT_EQ(pile.world().faults().size(), 1U);
    World copy = World::restore(pile.world().save());
    EXPECT_FALSE(copy.contains(first));
    ASSERT_EQ(copy.faults().size(), 1U);
    EXPECT_EQ(copy.faults()[0].body, second);
    EXPECT_EQ(copy.faults()[0].what, pile.world().faults()[0].what);
    EXPECT_EQ(copy.addBody({.material = MaterialId{0}}), pile.world().addBody({.material = MaterialId{0}}));
}

TEST(Snapshot, RollingBackAndReplayingGivesTheSameBits) {
    Pile pile;
    std::vector<Bytes> saved;
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < 121; ++i) {
        pile.world().saveTo(saved.emplace_back());
        pile.act(pile.world());
        pile.world().step();
        hashes.push_back(pile.world().stateHash());
    }
    pile.world().load(saved[60]);
    EXPECT_EQ(pile.world().stepCount(), 60);
    Bytes buffer;
    for (std::size_t i = 60; i < 121; ++i) {
        pile.world().saveTo(buffer);
        ASSERT_TRUE(buffer == saved[i]) << "step " << i;
        pile.act(pile.world());
        pile.world().step();
        ASSERT_EQ(pile.world().stateHash(), hashes[i]) << "step " << i;
    }
}

std::string refusal(std::span<const std::byte> snapshot) {
    try {
        World::restore(snapshot);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

Bytes somePile() {
    Pile pile;
    for (int i = 0; i < 60; ++i) pile.world().step();
    return pile.world().save();
}

TEST(Snapshot, TruncatedIsRefusedAtEveryLengthWithTheOffset) {
    const Bytes whole = somePile();
    ASSERT_EQ(refusal(whole), "");
    for (std::size_t length = 0; length < whole.size(); length += length < 64 ? 1 : 997) {
        const std::string text = refusal(std::span(whole).first(length));
        EXPECT_NE(text.find("truncated at byte " + std::to_string(length)), std::string::npos) << text;
    }
    Bytes longer = whole;
    longer.push_back(std::byte{0});
    EXPECT_NE(refusal(longer).find("ends at byte " + std::to_string(whole.size())), std::string::npos);
}

TEST(Snapshot, EveryFlippedByteIsNoticed) {
    Bytes bytes = somePile();
    for (std::size_t i = 0; i < bytes.size(); i += i < 64 ? 1 : 211) {
        bytes[i] ^= std::byte{0x10};
        EXPECT_NE(refusal(bytes).find("byte"), std::string::npos) << "byte " << i;
        bytes[i] ^= std::byte{0x10};
    }
    bytes[500] ^= std::byte{1};
    EXPECT_NE(refusal(bytes).find("damaged within bytes 32 and "), std::string::npos) << refusal(bytes);
}

TEST(Snapshot, AnotherVersionIsRefusedByItsNumberWithTheRemedy) {
    Bytes bytes = somePile();
    for (const std::uint32_t version : {0U, snapshot_version + 1}) {
        sealFrame(bytes, FrameKind::world, version);
        EXPECT_NE(refusal(bytes).find("has version " + std::to_string(version)), std::string::npos);
        EXPECT_NE(refusal(bytes).find("use the Cairn that wrote it"), std::string::npos);
    }
}

TEST(Snapshot, AFileOfAnotherKindIsRefusedWithTheRemedy) {
    Bytes bytes = somePile();
    std::memcpy(bytes.data(), "CAIRNSNP", 8);  // how snapshots began before version 1 began again
    EXPECT_NE(refusal(bytes).find("use that one or run the scene again"), std::string::npos) << refusal(bytes);
}

TEST(Snapshot, NonsenseBehindARightChecksumIsRefusedOrHarmless) {
    const Bytes whole = somePile();
    std::size_t refused = 0;
    std::uint64_t random = 1;
    for (int i = 0; i < 3000; ++i) {
        Bytes bytes = whole;
        random = random * 6364136223846793005U + 1442695040888963407U;
        const std::size_t at = frameHeadSize() + (random >> 20U) % (whole.size() - frameHeadSize());
        bytes[at] = static_cast<std::byte>(random >> 8U);
        sealFrame(bytes, FrameKind::world, snapshot_version);
        try {
            World world = World::restore(bytes);
            world.step();
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 10U);
}

TEST(Snapshot, AWorldStaysAsItWasWhenLoadingFails) {
    Pile pile;
    pile.world().step();
    const std::uint64_t before = pile.world().stateHash();
    Bytes bytes = pile.world().save();
    bytes.back() ^= std::byte{1};
    EXPECT_THROW(pile.world().load(bytes), InputError);
    EXPECT_EQ(pile.world().stateHash(), before);
    pile.world().step();
    EXPECT_EQ(pile.world().stepCount(), 2);
}

TEST(Snapshot, WhatIsTakenCanBeRestored) {
    // The moments of such bodies about their own lengths are less than what rounding leaves, of either sign.
    int taken = 0;
    int refused = 0;
    for (int i = 0; i < 100; ++i) {
        const Vec3 end(std::cos(i), std::sin(i), std::sin(3 * i));
        Compound thin;
        for (const double side : {-1.0, 1.0})
            thin.parts.push_back({Sphere{1e-6}, {side * 100 * end, Quat::Identity()}});
        World world;
        world.addMaterial({"oak", 800});
        try {
            world.addBody({.shape = thin, .mass = 1, .fixed = i % 2 == 0});
        } catch (const InputError&) {
            ++refused;
            continue;
        }
        ++taken;
        EXPECT_NO_THROW(World::restore(world.save())) << end.transpose();
    }
    EXPECT_GT(taken, 10);
    EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace cairn
