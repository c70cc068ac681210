/// The snapshots in tests/fuzz hold what the format holds now: from others a fuzzer would learn nothing. After a change
/// of the format run the test program once with CAIRN_WRITE_SEEDS=1 and commit what it wrote.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "scene_testing.h"
#include "world/byte_stream.h"

namespace cairn {
namespace {

using SeedBytes = std::vector<std::byte>;

std::string placeOfSeed(const std::string& name) {
    return CAIRN_SOURCE_DIR "/tests/fuzz/" + name;
}

SeedBytes readSeed(const std::string& name) {
    std::ifstream in(placeOfSeed(name), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

void writeSeed(const std::string& name, const SeedBytes& bytes) {
    std::ofstream(placeOfSeed(name), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

constexpr double odd_mass = 1.2345678912345;

/// A world with something of everything that a snapshot holds.
World worldOfEverything() {
    Settings settings = Settings::preset(Preset::performance);
    settings.parallel.threads = 1;
    World world(settings);
    const MaterialId oak = world.addMaterial({"oak", 800});
    const MaterialId steel = world.addMaterial({"steel", 7800});
    world.setPairProperties(oak, steel, {.restitution = 0.25, .static_friction = 0.5, .kinetic_friction = 0.4});
    world.setGravity(Vec3(0, 0, -9.81));
    world.setEventLevel(EventLevel::all);
    world.addBody({.shape = HalfSpace{}, .material = steel, .fixed = true, .name = "floor"});
    const auto add = [&](const Shape& shape, MaterialId material, const Vec3& place) {
        return world.addBody({.shape = shape, .material = material, .pose = {place, Quat::Identity()}});
    };
    const GroupId stones = world.addGroup("stones");
    const GroupId dust = world.addGroup("dust");
    world.setGroupsTouch(stones, dust, Touch::never);
    world.addBody({.shape = Box{Vec3(1, 1, 1)}, .material = oak, .fixed = true, .groups = {dust}, .sensor = true});
    const BodyId ball = add(Sphere{0.1}, steel, Vec3(0, 0, 0.1));
    const BodyId box = add(Box{Vec3(0.2, 0.3, 0.1)}, oak, Vec3(1, 0, 0.05));
    add(Capsule{0.05, 0.2}, oak, Vec3(1, 0, 0.15));
    add(Cylinder{0.1, 0.1}, steel, Vec3(2, 0, 0.051));
    add(ConvexHull({{0, 0, 0}, {0.2, 0, 0}, {0, 0.2, 0}, {0, 0, 0.2}}), oak, Vec3(3, 0, 0));
    add(Compound{{{Box{Vec3(0.2, 0.2, 0.1)}, {}, {}, {}},
                  {Sphere{0.05}, {Vec3(0, 0, 0.1), Quat::Identity()}, 0.3, {}}}},
        oak, Vec3(4, 0, 0.05));
    const BodyId hinged = add(Box{Vec3(0.1, 0.1, 0.5)}, oak, Vec3(7.2, 0, 2));
    const BodyId hole = add(Sphere{0.1}, oak, Vec3(5, 0, 1));
    const BodyId broken = add(Sphere{0.1}, oak, Vec3(6, 0, 1));
    world.addBody(
        {.shape = Sphere{0.1}, .material = oak, .mass = odd_mass, .pose = {Vec3(8, 0, 0.1), Quat::Identity()}});
    world.addSpring({.a = ball, .b = box, .stiffness = 5, .damping = 0.1, .rest_length = 1});
    world.addJoint({.kind = JointKind::hinge, .a = hinged, .anchor = Vec3(7, 0, 2), .axis = Vec3::UnitY()});
    world.setConstantForce(box, Vec3(0.5, 0, 0));
    for (int i = 0; i < 40; ++i) world.step();
    world.removeBody(hole);
    for (int i = 0; i < 30; ++i) world.applyImpulse(broken, Vec3(1e30, 0, 0));
    world.step();
    return world;
}

/// What fuzzing once found: a world whose body has the opposite of its inverse mass.
SeedBytes withNegativeInverseMass(SeedBytes bytes) {
    const auto right = std::bit_cast<std::array<std::byte, sizeof(double)>>(1 / odd_mass);
    const auto wrong = std::bit_cast<std::array<std::byte, sizeof(double)>>(-1 / odd_mass);
    const auto place = std::search(bytes.begin(), bytes.end(), right.begin(), right.end());
    std::copy(wrong.begin(), wrong.end(), place);
    sealFrame(bytes, FrameKind::world, snapshot_version);
    return bytes;
}

void writeSeeds() {
    const SeedBytes all = worldOfEverything().save();
    const Scene scene = parseScene(testing::sceneText(), "seed");
    SceneRun run(scene, settingsFor(scene));
    run.step();
    writeSeed("seeds/snapshot/empty", World().save());
    writeSeed("seeds/snapshot/all", all);
    writeSeed("seeds/snapshot/run", run.save());
    writeSeed("findings/snapshot/negative_inverse_mass", withNegativeInverseMass(all));
}

TEST(SnapshotSeeds, AreReadAndSavedAsTheSameBytes) {
    if (std::getenv("CAIRN_WRITE_SEEDS") != nullptr) writeSeeds();
    const SeedBytes all = readSeed("seeds/snapshot/all");
    const World world = World::restore(all);
    EXPECT_EQ(world.save(), all);
    EXPECT_EQ(world.faults().size(), 1U);
    EXPECT_EQ(world.joints().size(), 1U);
    EXPECT_GT(world.contacts().size(), 5U);
    const SeedBytes empty = readSeed("seeds/snapshot/empty");
    EXPECT_EQ(World::restore(empty).save(), empty);
    const SeedBytes run = readSeed("seeds/snapshot/run");
    EXPECT_EQ(SceneRun::restore(run).save(), run);
    EXPECT_NE(testing::messageOf([] {
                  World::restore(readSeed("findings/snapshot/negative_inverse_mass"));
              }).find("an inverse mass that is not that of its mass"),
              std::string::npos);
}

}  // namespace
}  // namespace cairn
