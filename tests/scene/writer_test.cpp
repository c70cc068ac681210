#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "scene_testing.h"

namespace cairn {
namespace {

using testing::messageOf;

/// A scene that uses every member, with numbers that are hard to write.
Scene fullScene() {
    Scene scene;
    scene.name = "täst \"quoted\"\n";
    scene.duration = 0.1 + 0.2;
    scene.gravity = {1.0 / 3, -0.0, -9.80665};
    scene.events = {{0.7, SetGravity{{0, 1e-300, 5}}},     {0.3, SetVelocity{0, {1, 2, 3}}},
                    {0.3, GiveImpulse{1, {1e17, 0.1, 0}}}, {0.2, SetForce{1, {0, 0, 4}}},
                    {0.1, SetTorque{1, {0, 0, 5}}},        {9, RemoveBody{0}}};
    scene.materials = {{"zinc", 7140.5}, {"ash", 650}};
    scene.default_pair = {.restitution = 1,
                          .static_friction = 0.4,
                          .kinetic_friction = 0.3,
                          .rolling_friction = 0.01,
                          .spinning_friction = 0.002};
    scene.pairs = {{{"zinc", "zinc"}, {.restitution = 0, .static_friction = 0.4, .kinetic_friction = 0.1}},
                   {{"ash", "zinc"}, scene.default_pair}};
    SceneBody ball;
    ball.shape = Sphere{std::nextafter(0.5, 1)};
    ball.material = "zinc";
    ball.name = "ball/1";
    ball.mass = 0.1;
    ball.position = {0, 0, -0.0};
    ball.orientation = Quat(0.1, 0.2, 0.3, 0.4);
    ball.linear_velocity = {1e22, -1, 5e-324};
    ball.angular_velocity = {0, 1e-5, 0};
    SceneBody capsule;
    capsule.shape = Capsule{0.25, 1e-3};
    capsule.material = "ash";
    capsule.orientation = Quat(1, 0, -0.0, 0);
    capsule.asleep = true;
    capsule.mass = 3;
    SceneBody box;
    box.shape = Box{{1, 2, 3}};
    box.material = "ash";
    box.fixed = true;
    SceneBody plane;
    plane.shape = HalfSpace{{0, 0, 2}, -1.5};
    plane.material = "ash";
    plane.fixed = true;
    scene.bodies = {ball, capsule, box, plane};
    scene.springs = {{0, 1, {1, 0, 0}, {0, 0.1, 0}, 100, 0.5, 0.25},
                     {1, std::nullopt, Vec3::Zero(), Vec3::Zero(), 0, 0, 0}};
    scene.preset = Preset::accuracy;
    scene.settings = {{"sleeping", false},
                      {"threads", std::int64_t{2}},
                      {"correction", std::string("none")},
                      {"iterations", 2.0},
                      {"contact_margin", 1e-4}};
    return scene;
}

bool sameBits(double a, double b) {
    return a == b && std::signbit(a) == std::signbit(b);
}

void expectSame(const Vec3& a, const Vec3& b) {
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(sameBits(a[i], b[i])) << a[i] << " " << b[i];
}

TEST(SceneWriter, IsReadBackBitByBit) {
    const Scene scene = fullScene();
    const std::string text = formatScene(scene);
    const Scene back = parseScene(text, "text");
    EXPECT_EQ(formatScene(back), text);
    EXPECT_EQ(back.name, scene.name);
    EXPECT_EQ(back.duration, scene.duration);
    expectSame(back.gravity, scene.gravity);
    ASSERT_EQ(back.bodies.size(), scene.bodies.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const SceneBody& a = scene.bodies[i];
        const SceneBody& b = back.bodies[i];
        EXPECT_EQ(a.shape.index(), b.shape.index());
        EXPECT_EQ(a.material, b.material);
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.mass, b.mass);
        expectSame(a.position, b.position);
        expectSame(a.orientation.vec(), b.orientation.vec());
        EXPECT_EQ(a.orientation.w(), b.orientation.w());
        expectSame(a.linear_velocity, b.linear_velocity);
        expectSame(a.angular_velocity, b.angular_velocity);
        EXPECT_EQ(a.fixed, b.fixed);
        EXPECT_EQ(a.asleep, b.asleep);
    }
    EXPECT_EQ(std::get<Sphere>(back.bodies[0].shape).radius, std::nextafter(0.5, 1));
    EXPECT_EQ(std::get<Capsule>(back.bodies[1].shape).length, 1e-3);
    EXPECT_EQ(std::get<HalfSpace>(back.bodies[3].shape).normal, Vec3(0, 0, 2));
    ASSERT_EQ(back.pairs.size(), 2U);
    EXPECT_EQ(back.pairs[0].second.kinetic_friction, 0.1);
    EXPECT_EQ(back.pairs[0].second.restitution, 0);
    EXPECT_EQ(back.default_pair.rolling_friction, 0.01);
    EXPECT_EQ(back.pairs[0].second.rolling_friction, 0);
    EXPECT_EQ(back.pairs[1].second.spinning_friction, 0.002);
    EXPECT_EQ(back.pairs[1].second.kinetic_friction, 0.3);
    ASSERT_EQ(back.events.size(), scene.events.size());
    for (std::size_t i = 0; i < scene.events.size(); ++i) {
        EXPECT_EQ(back.events[i].time, scene.events[i].time);
        EXPECT_EQ(back.events[i].action.index(), scene.events[i].action.index());
    }
    EXPECT_EQ(std::get<GiveImpulse>(back.events[2].action).impulse, Vec3(1e17, 0.1, 0));
    EXPECT_EQ(back.springs[0].damping, 0.5);
    EXPECT_EQ(back.springs[0].anchor_b, Vec3(0, 0.1, 0));
    EXPECT_FALSE(back.springs[1].b.has_value());
    EXPECT_EQ(back.preset, scene.preset);
    EXPECT_EQ(back.settings, scene.settings) << "a whole number stays apart from a number";
}

TEST(SceneWriter, KeepsTheOrderOfTheKeysAndLeavesOutDefaults) {
    Scene scene;
    scene.name = "small";
    scene.duration = 1;
    SceneBody ball;
    ball.material = "oak";
    scene.materials = {{"oak", 800}};
    scene.bodies = {ball};
    EXPECT_EQ(formatScene(scene),
              "{\"name\":\"small\",\"duration\":1,\"gravity\":[0,0,0],\n"
              "\"materials\":{\"oak\":{\"density\":800}},\n"
              "\"contacts\":{\"default\":{\"restitution\":0.25,\"static_friction\":0.2,\"kinetic_friction\":0.2}},\n"
              "\"bodies\":[\n{\"shape\":{\"type\":\"sphere\",\"radius\":0.5},\"material\":\"oak\"}\n]}\n");
    scene.bodies.clear();
    EXPECT_EQ(parseScene(formatScene(scene), "empty").bodies.size(), 0U);
}

TEST(SceneWriter, WritesFilesThatAreReadBack) {
    const std::filesystem::path file = std::filesystem::path(CAIRN_BINARY_DIR) / "scene_writer_test.json";
    const Scene scene = fullScene();
    writeScene(scene, file);
    EXPECT_EQ(formatScene(readScene(file)), formatScene(scene));
    std::filesystem::remove(file);
}

TEST(SceneWriter, RefusesWhatAFileCannotHold) {
    Scene scene = fullScene();
    scene.bodies[1].position.y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(messageOf([&] { formatScene(scene); }).find("nan"), std::string::npos);
    scene = fullScene();
    scene.gravity.x() = std::numeric_limits<double>::infinity();
    EXPECT_NE(messageOf([&] { formatScene(scene); }).find("inf"), std::string::npos);
    scene = fullScene();
    scene.name = "\xff";
    EXPECT_NE(messageOf([&] { formatScene(scene); }).find("UTF-8"), std::string::npos);
}

TEST(SceneWriter, SaysWhichFileCannotBeWritten) {
    try {
        writeScene(fullScene(), "no/such/folder/scene.json");
        FAIL() << "wrote into a folder that does not exist";
    } catch (const IoError& error) {
        EXPECT_NE(std::string(error.what()).find("no/such/folder/scene.json"), std::string::npos);
    }
    ASSERT_TRUE(std::filesystem::exists("/dev/full")) << "what plays a full disk here";
    EXPECT_THROW(writeScene(fullScene(), "/dev/full"), IoError);
}

}  // namespace
}  // namespace cairn
