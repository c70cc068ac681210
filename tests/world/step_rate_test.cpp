#include "world/step_rate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "cairn/world.h"

namespace cairn {
namespace {

World withBoxes(double extent, const Settings& settings, double gravity = 10) {
    World world(settings);
    const MaterialId oak = world.addMaterial({"oak", 800});
    world.setGravity(Vec3(0, 0, -gravity));
    world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true});
    for (int i = 0; i < 5; ++i) {
        world.addBody({.shape = Box{Vec3::Constant(extent)},
                       .material = oak,
                       .pose = {Vec3(0, 0, (i + 1) * 2 * extent), Quat::Identity()}});
    }
    return world;
}

double stepsFor(double extent, const Settings& settings, double gravity = 10) {
    World world = withBoxes(extent, settings, gravity);
    world.step();
    EXPECT_FALSE(world.settings().steps_per_second.isBySize() && extent > 0);
    EXPECT_NEAR(world.time(), 1 / world.settings().steps_per_second, 1e-15);
    return world.settings().steps_per_second;
}

TEST(StepRate, FollowsTheSizesOfTheBodies) {
    const Settings performance;
    for (const auto& [extent, steps] : {std::pair(1e-3, 1920.0), std::pair(1e-2, 960.0), std::pair(0.1, 240.0),
                                        std::pair(0.12, 240.0), std::pair(1.0, 60.0), std::pair(10.0, 30.0)}) {
        EXPECT_EQ(stepsFor(extent, performance), steps) << extent;
        EXPECT_EQ(stepsFor(extent, Settings::preset(Preset::accuracy)), 4 * steps) << extent;
    }
    EXPECT_EQ(stepsFor(1e-3, Settings::preset(Preset::thesis)), 240) << "the thesis's presets are for its bodies";
    EXPECT_EQ(stepsFor(1e-3, Settings::preset(Preset::performance, 100)), 100) << "what is given stays";
    const double weak = 10.0 / 16;
    EXPECT_EQ(stepsFor(0.12, Settings::preset(Preset::performance, 0, weak), weak), 60) << "there all is slower";
    EXPECT_EQ(stepsFor(0.12, performance, 0), 240);
}

std::optional<int> exponentOf(std::span<const double> extents, double gravity = 10) {
    StepExponents exponents(gravity);
    for (const double extent : extents) exponents.add(extent);
    return exponents.median();
}

TEST(StepRate, TakesTheMedianOfTheMiddleExtents) {
    EXPECT_EQ(middleExtent(Box{Vec3(0.3, 0.1, 0.2)}), 0.2);
    EXPECT_EQ(middleExtent(Sphere{0.25}), 0.5);
    EXPECT_EQ(exponentOf(std::array{100.0, 0.12, 0.001, 0.12, 0.12}), 0);
    EXPECT_EQ(exponentOf(std::array{0.12, 0.48, 0.48, 100.0}), -1);
    EXPECT_EQ(exponentOf(std::array{0.48, 0.12}), 0) << "the smaller of two";
    EXPECT_EQ(exponentOf({}), std::nullopt);
}

TEST(StepRate, IsWhatTheMedianBodyAsksForInAnyOrder) {
    constexpr std::array all{0.01, 5.0, 0.12, 0.12, 0.3, 1.0, 0.001, 0.5, 3.0};
    for (std::size_t count = 1; count <= all.size(); ++count) {
        for (std::size_t first = 0; first < all.size(); ++first) {
            std::vector<double> extents;
            for (std::size_t i = 0; i < count; ++i) extents.push_back(all[(first + 4 * i) % all.size()]);
            const std::optional<int> found = exponentOf(extents, 9.81);
            std::ranges::sort(extents);
            EXPECT_EQ(found, exponentOf(std::array{extents[(count - 1) / 2]}, 9.81)) << count << " " << first;
        }
    }
}

TEST(StepRate, SpeedThresholdsStayTheSamePartsOfWhatABodyFallsInAStep) {
    World world = withBoxes(1e-3, Settings{});
    world.step();
    const Settings& s = world.settings();
    EXPECT_EQ(s.sleep.sleep_threshold, Settings{}.sleep.sleep_threshold / 8);
    EXPECT_EQ(s.resolution.restitution_threshold, Settings{}.resolution.restitution_threshold / 8);
    EXPECT_EQ(s.resolution.resolution_threshold, Settings{}.resolution.resolution_threshold / 8);
}

TEST(StepRate, IsSettledByTheFirstBodiesThatMoveAndStays) {
    World world;
    const MaterialId oak = world.addMaterial({"oak", 800});
    world.setGravity(Vec3(0, 0, -10));
    world.step();
    EXPECT_TRUE(world.settings().steps_per_second.isBySize()) << "nobody moves yet";
    EXPECT_EQ(world.stepsPerSecondBySize(), 240);
    world.addBody({.shape = Sphere{0.5e-3}, .material = oak});
    EXPECT_EQ(world.stepsPerSecondBySize(), 1920);
    world.step();
    EXPECT_EQ(world.settings().steps_per_second, 1920);
    world.addBody({.shape = Sphere{5}, .material = oak, .pose = {Vec3(20, 0, 0), Quat::Identity()}});
    world.addBody({.shape = Sphere{5}, .material = oak, .pose = {Vec3(-20, 0, 0), Quat::Identity()}});
    world.step();
    EXPECT_EQ(world.settings().steps_per_second, 1920);
    EXPECT_EQ(world.stepsPerSecondBySize(), 1920);
    world.setSettings(Settings::preset(Preset::accuracy));
    EXPECT_EQ(world.settings().steps_per_second, 7680) << "another preset, the same sizes";
    world.setSettings(Settings::preset(Preset::performance, 500));
    world.step();
    EXPECT_EQ(world.settings().steps_per_second, 500);
}

TEST(StepRate, IsSaved) {
    for (const int steps : {0, 3}) {
        World world = withBoxes(1e-3, Settings{});
        for (int i = 0; i < steps; ++i) world.step();
        World restored = World::restore(world.save());
        EXPECT_EQ(restored.settings().steps_per_second.isBySize(), steps == 0);
        for (int i = 0; i < 5; ++i) {
            world.step();
            restored.step();
        }
        EXPECT_EQ(restored.settings().steps_per_second, 1920);
        EXPECT_EQ(restored.stateHash(), world.stateHash());
        EXPECT_EQ(restored.time(), world.time());
    }
}

}  // namespace
}  // namespace cairn
