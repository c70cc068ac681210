/// @file What viewers can do with a live world, and the messages about it.
#include "view/live_world.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "view/frame_message.h"

namespace cairn::view {
namespace {

LiveWorld tower(int boxes = 4) {
    Scene scene = builtInScene("tower:" + std::to_string(boxes));
    return LiveWorld(scene, "tower", settingsFor(scene));
}

BodyId lastBody(const LiveWorld& world) {
    return world.bodies().back();
}

TEST(LiveWorld, StepsExactlyAsTheLibraryDoes) {
    const Scene scene = builtInScene("tower:4");
    SceneRun run(scene, settingsFor(scene));
    LiveWorld world = tower();
    int samples = 0;
    for (int i = 0; i < 80; ++i) {
        run.step();
        if (world.step()) ++samples;
    }
    EXPECT_EQ(world.world().stateHash(), run.world().stateHash());
    EXPECT_EQ(samples, 10);
    world.reset();
    EXPECT_EQ(world.world().stepCount(), 0);
}

TEST(LiveWorld, TheRosterFollowsTheWorld) {
    LiveWorld world = tower();
    const std::uint32_t epoch = world.epoch();
    const BodyId ball = world.throwBall({{0, -3, 1}, {0, 10, 0}, 0.1, "iron"});
    const RosterChange added = world.updateRoster();
    ASSERT_EQ(added.added.size(), 1U);
    EXPECT_EQ(added.added[0], ball);
    EXPECT_EQ(world.epoch(), epoch + 1);
    EXPECT_EQ(world.describeChange(added)["added"][0]["shape"]["type"], "sphere");
    world.remove(ball);
    EXPECT_EQ(world.updateRoster().removed, (std::vector<std::uint32_t>{ball.index}));
    EXPECT_TRUE(world.updateRoster().added.empty());
    EXPECT_EQ(world.epoch(), epoch + 2);
    EXPECT_THROW(world.remove(ball), StaleIdError);
}

TEST(LiveWorld, UnknownMaterialsAreRefusedAndCommonOnesAreThere) {
    Scene empty;
    empty.name = "empty";
    empty.duration = 1;
    LiveWorld world(empty, "empty", settingsFor(empty));
    EXPECT_THROW(world.throwBall({{0, 0, 1}, {0, 0, 0}, 0.1, "butter"}), InputError);
    EXPECT_NO_THROW(world.throwBall({{0, 0, 1}, {0, 0, 0}, 0.1, "oak"}));
}

TEST(LiveWorld, AGrabbedBodyComesToWhereItIsDragged) {
    LiveWorld world = tower(1);
    const BodyId box = lastBody(world);
    const Vec3 target(0.5, 0.3, 1.2);
    world.grab(1, {box, world.world().pose(box).position});
    world.drag(1, {target});
    EXPECT_EQ(world.springLines().size(), 1U);
    for (int i = 0; i < 720; ++i) world.step();
    // Held against gravity a spring of frequency ω hangs g/ω² lower.
    EXPECT_LT((world.world().pose(box).position - target).norm(), 0.08);
    world.release(1);
    EXPECT_TRUE(world.springLines().empty());
    EXPECT_THROW(world.drag(1, {target}), InputError);
}

TEST(LiveWorld, GripsEndWithTheirBodyAndFixedBodiesCannotBeGrabbed) {
    LiveWorld world = tower(2);
    const BodyId box = lastBody(world);
    world.grab(1, {box, world.world().pose(box).position});
    world.remove(box);
    EXPECT_THROW(world.drag(1, {Vec3::Zero()}), InputError);
    world.updateRoster();
    const BodyId other = lastBody(world);
    world.freeze({other, true});
    EXPECT_TRUE(world.world().isFixed(other));
    EXPECT_THROW(world.grab(1, {other, Vec3::Zero()}), InputError);
    world.freeze({other, false});
    EXPECT_NO_THROW(world.grab(1, {other, Vec3::Zero()}));
}

TEST(LiveWorld, TheDialGoesFromPresetToPreset) {
    LiveWorld world = tower();
    EXPECT_EQ(world.dial(), 0.0);
    world.setDial(1);
    EXPECT_EQ(world.world().settings().steps_per_second, 960);
    const double fine = Settings::preset(Preset::accuracy).correction.allowed_overlap;
    EXPECT_EQ(world.world().settings().correction.allowed_overlap, fine);
    world.setDial(0.5);
    const Settings middle = world.world().settings();
    EXPECT_EQ(middle.steps_per_second, 480);
    EXPECT_NEAR(middle.correction.allowed_overlap, std::sqrt(0.0145 * fine), 1e-9);
    world.setField({"damping", 0.1});
    EXPECT_EQ(world.dial(), std::nullopt);
    EXPECT_THROW(world.setField({"damping", 7.0}), InputError);
    EXPECT_THROW(world.setField({"no_such_field", 7.0}), InputError);
    EXPECT_EQ(world.world().settings().sleep.damping, 0.1);
}

TEST(LiveWorld, ChangingThreadsKeepsTheDial) {
    LiveWorld world = tower();
    world.setField({"threads", std::int64_t{2}});
    EXPECT_EQ(world.dial(), 0.0);
    world.setDial(1);
    EXPECT_EQ(world.world().settings().parallel.threads, 2);
}

TEST(LiveWorld, ABadSceneLeavesTheOldOne) {
    LiveWorld world = tower();
    world.step();
    EXPECT_THROW(world.load(parseScene("{}", "a.json"), "a.json"), InputError);
    EXPECT_EQ(world.world().stepCount(), 1);
    const std::uint32_t epoch = world.epoch();
    world.load(builtInScene("tower:2"), "tower:2");
    EXPECT_GT(world.epoch(), epoch);
    EXPECT_EQ(world.world().stepCount(), 0);
}

TEST(LiveWorld, TheSelectionTellsStateContactsAndBatch) {
    LiveWorld world = tower(3);
    for (int i = 0; i < 20; ++i) world.step();
    const BodyId box = world.bodies()[2];
    const auto selection = world.describeSelection(box);
    EXPECT_EQ(selection["position"][2], world.world().pose(box).position.z());
    EXPECT_EQ(selection["mass"], world.world().mass(box));
    std::size_t contacts = 0;
    for (const ContactInfo& contact : world.world().contacts())
        contacts += contact.a == box || contact.b == box ? 1U : 0U;
    EXPECT_EQ(selection["contacts"].size(), contacts);
    EXPECT_GT(contacts, 3U);
    EXPECT_EQ(selection["batch"]["bodies"], 3);
}

TEST(FrameMessage, HoldsThePosesAndTheLayersAskedFor) {
    LiveWorld world = tower(3);
    for (int i = 0; i < 20; ++i) world.step();
    const Layers all = 511;
    const SharedMessage message =
        makeFrameMessage(world.world(), world.bodies(), 9, all, {{{Vec3::Zero(), Vec3::UnitX()}}, {}});
    ASSERT_EQ(message->kind, Message::Kind::binary);
    const std::string& bytes = message->bytes;
    const auto read = [&](std::size_t at, auto value) {
        std::memcpy(&value, bytes.data() + at, sizeof(value));
        return value;
    };
    EXPECT_EQ(read(0, std::uint32_t{}), 1U);
    EXPECT_EQ(read(4, std::uint32_t{}), 9U);
    EXPECT_EQ(read(8, std::uint64_t{}), 20U);
    EXPECT_EQ(read(16, double{}), world.world().time());
    const std::size_t slots = read(24, std::uint32_t{});
    EXPECT_EQ(slots, world.bodies().back().index + 1U);
    std::vector<std::uint32_t> kinds;
    for (std::size_t at = 32; at < bytes.size();) {
        const auto kind = read(at, std::uint32_t{});
        const auto size = read(at + 4, std::uint32_t{});
        kinds.push_back(kind);
        if (kind == 1) {
            ASSERT_EQ(size, 12 * slots);
            for (const BodyId id : world.bodies()) {
                EXPECT_EQ(read(at + 8 + 12 * id.index + 8, float{}),
                          static_cast<float>(world.world().pose(id).position.z()));
            }
        }
        if (kind == 11) {
            EXPECT_EQ(size, 48 * world.world().contacts().size());
        }
        at += 8 + (size + 3) / 4 * 4;
        ASSERT_LE(at, bytes.size());
    }
    EXPECT_EQ(kinds, (std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6, 11, 7, 8, 9, 10, 13, 12}));
    EXPECT_LT(makeFrameMessage(world.world(), world.bodies(), 9, 0, {})->bytes.size(), bytes.size());
}

TEST(FrameMessage, HoldsWhereRaysHit) {
    LiveWorld world = tower(3);
    const Vec3 above(0, 0, 10);
    const std::vector<Ray> rays = {{above, Vec3(0, 0, -0.5)}, {above, Vec3::UnitZ()}, {above, Vec3(1, 0, -0.2)}};
    const SharedMessage message = makeFrameMessage(world.world(), world.bodies(), 1, 0, {{}, rays});
    const std::string& bytes = message->bytes;
    std::array<std::uint32_t, 2> head{};
    std::array<std::array<float, 9>, 2> lines{};
    ASSERT_GT(bytes.size(), sizeof(head) + sizeof(lines));
    std::memcpy(head.data(), bytes.data() + bytes.size() - sizeof(lines) - sizeof(head), sizeof(head));
    std::memcpy(lines.data(), bytes.data() + bytes.size() - sizeof(lines), sizeof(lines));
    EXPECT_EQ(head, (std::array<std::uint32_t, 2>{14, sizeof(lines)})) << "the ray to the sky hits nothing";
    const auto hit = world.world().castRay(rays.front());
    ASSERT_TRUE(hit);
    EXPECT_EQ(lines[0], (std::array<float, 9>{0, 0, 10, 0, 0, static_cast<float>(hit->point.z()), 0, 0, 1}));
    EXPECT_EQ(lines[1][5], 0) << "the ground";
}

TEST(FrameMessage, HoldsTheJointsWhereTheyAre) {
    const Scene scene = builtInScene("cradle_swing:2:1");
    LiveWorld world(scene, "cradle", settingsFor(scene));
    for (int i = 0; i < 8; ++i) world.step();
    const SharedMessage message = makeFrameMessage(world.world(), world.bodies(), 1, bit(Layer::joints), {});
    const std::string& bytes = message->bytes;
    const std::vector<JointId> ids = world.world().joints();
    ASSERT_FALSE(ids.empty());
    const std::size_t begin = bytes.size() - 48 * ids.size();
    std::array<std::uint32_t, 5> head{};  // kind of section, its bytes, kind of joint, A, B
    std::memcpy(head.data(), bytes.data() + begin - 8, sizeof(head));
    const JointInfo joint = world.world().joint(ids.front());
    EXPECT_EQ(head, (std::array<std::uint32_t, 5>{13, static_cast<std::uint32_t>(48 * ids.size()),
                                                  static_cast<std::uint32_t>(JointKind::hinge), joint.a.index,
                                                  joint.b ? joint.b->index : UINT32_MAX}));
    std::array<float, 9> points{};
    std::memcpy(points.data(), bytes.data() + begin + 12, sizeof(points));
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(points[k], static_cast<float>(joint.anchor_a[static_cast<int>(k)]));
        EXPECT_EQ(points[3 + k], static_cast<float>(joint.anchor_b[static_cast<int>(k)]));
    }
}

TEST(LiveWorld, TheSelectionTellsTheJoints) {
    const Scene scene = builtInScene("cradle_swing:2:1");
    LiveWorld world(scene, "cradle", settingsFor(scene));
    world.step();
    const JointInfo joint = world.world().joint(world.world().joints().front());
    const auto joints = world.describeSelection(joint.a)["joints"];
    ASSERT_GE(joints.size(), 1U);
    EXPECT_EQ(joints[0]["kind"], static_cast<int>(JointKind::hinge));
    EXPECT_EQ(joints[0]["force"], joint.force.norm());
}

}  // namespace
}  // namespace cairn::view
