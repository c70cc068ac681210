/// Snapshots of every version of the format stay readable: tests/world/snapshots holds one of each, with what it says.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "cairn/world.h"
#include "world/byte_stream.h"

namespace cairn {
namespace {

using Bytes = std::vector<std::byte>;

std::string placeOf(std::uint32_t version, const char* ending) {
    return fmt::format("{}/tests/world/snapshots/version_{}.{}", CAIRN_SOURCE_DIR, version, ending);
}

std::string contentOf(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

Bytes bytesOf(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

std::string textOf(const Vec3& v) {
    return fmt::format("({:.17g} {:.17g} {:.17g})", v.x(), v.y(), v.z());
}

std::string textOf(BodyId id) {
    return fmt::format("{}.{}", id.index, id.generation);
}

/// What a user sees of a world. It may only be added to where older snapshots have nothing to add.
std::string describe(const World& world) {
    std::string text = fmt::format("step {}, time {:.17g}, gravity {}, {} steps per second, damping {}\n",
                                   world.stepCount(), world.time(), textOf(world.gravity()),
                                   world.settings().steps_per_second, world.settings().gravity_damping.damping);
    for (const Material& material : world.materials()) text += fmt::format("{} {}\n", material.name, material.density);
    text += fmt::format("restitution {}\n", world.pairProperties(MaterialId{0}, MaterialId{1}).restitution);
    for (const BodyId id : world.bodies()) {
        const Pose pose = world.pose(id);
        const Quat& q = pose.orientation;
        text += fmt::format("body {} '{}' shape {} material {} fixed {} asleep {} mass {:.17g} inertia {}\n",
                            textOf(id), world.name(id), world.shape(id).index(), static_cast<int>(world.material(id)),
                            world.isFixed(id), world.isAsleep(id), world.mass(id), textOf(world.principalInertia(id)));
        text += fmt::format("  at {} turned {:.17g} {} v {} w {}\n", textOf(pose.position), q.w(),
                            textOf(Vec3(q.vec())), textOf(world.linearVelocity(id)), textOf(world.angularVelocity(id)));
    }
    for (const ContactInfo& c : world.contacts()) {
        text += fmt::format("contact {} {} at {} normal {} distance {:.17g} impulse {} batch {}\n", textOf(c.a),
                            textOf(c.b), textOf(c.point), textOf(c.normal), c.distance, textOf(c.impulse), c.batch);
    }
    for (const FaultInfo& f : world.faults())
        text += fmt::format("fault {} step {} {}\n", textOf(f.body), f.step, f.what);
    for (const Event& e : world.events()) {
        text += fmt::format("event {} {} {} {} {}\n", static_cast<int>(e.kind), static_cast<int>(e.reason), textOf(e.a),
                            textOf(e.b), e.contacts);
    }
    return text;
}

/// A world with something of everything that this version can save.
World worldOfEverything() {
    Settings settings = Settings::preset(Preset::performance);
    settings.resolution.resolution = ResolutionKind::accelerated_sweeps;
    settings.parallel.threads = 1;
    settings.steps_per_second = 200;
    World world(settings);
    const MaterialId oak = world.addMaterial({"oak", 800});
    const MaterialId steel = world.addMaterial({"steel", 7800});
    world.setPairProperties(oak, steel, {.restitution = 0.25, .static_friction = 0.5, .kinetic_friction = 0.4});
    world.setGravity(Vec3(0, 0, -9.81));
    world.setEventLevel(EventLevel::all);
    world.addBody({.shape = HalfSpace{}, .material = steel, .fixed = true, .name = "floor"});
    const auto add = [&](const Shape& shape, MaterialId material, const Vec3& place) {
        return world.addBody(
            {.shape = shape, .material = material, .pose = {place, Quat::Identity()}, .name = "of everything"});
    };
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
    world.addSpring({.a = ball, .b = box, .stiffness = 5, .damping = 0.1, .rest_length = 1});
    world.addJoint({.kind = JointKind::hinge, .a = hinged, .anchor = Vec3(7, 0, 2), .axis = Vec3::UnitY()});
    world.setConstantForce(box, Vec3(0.5, 0, 0));
    for (int i = 0; i < 40; ++i) world.step();
    world.removeBody(hole);
    for (int i = 0; i < 30; ++i) world.applyImpulse(broken, Vec3(1e30, 0, 0));
    world.step();
    return world;
}

/// A new version needs its own file: run the test program once with CAIRN_WRITE_SNAPSHOT=1 and commit what it wrote.
void writeNew() {
    const World world = worldOfEverything();
    const Bytes bytes = world.save();
    std::ofstream(placeOf(snapshot_version, "bin"), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    std::ofstream(placeOf(snapshot_version, "txt")) << describe(world);
}

TEST(OldSnapshots, OfEveryVersionSayWhatTheySaidWhenWritten) {
    if (std::getenv("CAIRN_WRITE_SNAPSHOT") != nullptr) writeNew();
    for (std::uint32_t version = 1; version <= snapshot_version; ++version) {
        const std::string file = contentOf(placeOf(version, "bin"));
        ASSERT_FALSE(file.empty()) << "version " << version << " has no file in tests/world/snapshots; run this test "
                                   << "with CAIRN_WRITE_SNAPSHOT=1 in the environment and commit what it wrote";
        const World world = World::restore(bytesOf(file));
        const std::string expected = contentOf(placeOf(version, "txt"));
        ASSERT_GT(expected.size(), 1000U);
        EXPECT_EQ(describe(world), expected) << "version " << version;
    }
}

TEST(OldSnapshots, SettingsThatTheyLackMeanWhatTheWorldDidWithoutThem) {
    for (std::uint32_t version = 1; version <= 3; ++version) {
        const World world = World::restore(bytesOf(contentOf(placeOf(version, "bin"))));
        EXPECT_EQ(world.settings().correction.spread_levels, 0) << "overlaps were not spread";
        EXPECT_FALSE(world.settings().integration.exact_flight);
    }
    EXPECT_EQ(World::restore(World().save()).settings().correction.spread_levels, 8) << "what is there is read";
}

TEST(OldSnapshots, OfEveryVersionGoOn) {
    for (std::uint32_t version = 1; version <= snapshot_version; ++version) {
        World world = World::restore(bytesOf(contentOf(placeOf(version, "bin"))));
        world.setChecks(Checks::on);
        const std::int64_t before = world.stepCount();
        const std::size_t faults = world.faults().size();
        for (int i = 0; i < 100; ++i) world.step();
        EXPECT_EQ(world.stepCount(), before + 100);
        EXPECT_EQ(world.faults().size(), faults);
        World again = World::restore(world.save());
        world.step();
        again.step();
        EXPECT_EQ(world.stateHash(), again.stateHash());
    }
}

}  // namespace
}  // namespace cairn
