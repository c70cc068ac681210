/// What the thesis's pictures show and what a user of the built-in scenes relies on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/scene.h"

namespace cairn {
namespace {

/// Largest distance of a dynamic body from where it began [m].
double drift(const SceneRun& run) {
    double largest = 0;
    for (std::size_t i = 0; i < run.ids().size(); ++i) {
        if (run.scene().bodies[i].fixed) continue;
        largest = std::max(largest, (run.world().pose(run.ids()[i]).position - run.scene().bodies[i].position).norm());
    }
    return largest;
}

void runFor(SceneRun& run, double seconds) {
    while (run.world().time() < seconds) run.step();
}

class Standing : public testing::TestWithParam<const char*> {};

TEST_P(Standing, StaysWithinATenthOfAMillimetreForAMinute) {
    const Scene scene = builtInScene(GetParam());
    SceneRun run(scene, settingsFor(scene));
    runFor(run, 60);
    EXPECT_LT(drift(run), 1e-4);
    EXPECT_EQ(run.world().statistics().asleep, static_cast<std::int64_t>(scene.bodies.size()) - 1);
}

TEST_P(Standing, StandsAwakeWithoutSinkingBelowTheThreshold) {
    const Scene scene = builtInScene(GetParam());
    Settings settings = settingsFor(scene);
    settings.sleep.sleeping = false;
    SceneRun run(scene, settings);
    double overlap = 0;
    while (run.world().time() < 6) {
        run.step();
        overlap = std::max(overlap, run.world().statistics().largest_overlap);
    }
    EXPECT_LT(drift(run), 0.02);
    EXPECT_LE(overlap, 0.01 * settings.correction.allowed_overlap * 0.1) << "boxes of 10 cm";
    EXPECT_GE(run.world().contacts().size(), scene.bodies.size() - 1) << "they stand on each other";
}

INSTANTIATE_TEST_SUITE_P(Stacks, Standing, testing::Values("tower:10", "wall:10"), [](const auto& param) {
    return std::string(param.param).substr(0, std::string(param.param).find(':'));
});

class Scenes : public testing::TestWithParam<const char*> {};

TEST_P(Scenes, EndWithNothingLostAndOverlapsWithinAMillimetreOfTheThreshold) {
    const Scene scene = builtInScene(GetParam());
    const Settings settings = settingsFor(scene);
    SceneRun run(scene, settings);
    runFor(run, scene.duration);
    EXPECT_TRUE(run.world().faults().empty());
    EXPECT_LE(run.world().statistics().largest_overlap, settings.correction.allowed_overlap * 0.12 + 1e-3)
        << "bodies of about 12 cm";
    for (const BodyId id : run.ids()) {
        if (!run.world().isFixed(id)) {
            EXPECT_GT(run.world().pose(id).position.z(), 0.03);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(OfTheThesis, Scenes, testing::Values("stacks5", "well324", "cage384"),
                         [](const auto& param) { return std::string(param.param); });

/// Most by which the kinetic and potential energy rises above its lowest value so far, as a part of the first.
double gainOf(const Scene& scene, Preset preset, double seconds) {
    SettingOverrides overrides;
    overrides.preset = preset;
    SceneRun run(scene, settingsFor(scene, overrides));
    const auto energy = [&] { return run.world().kineticEnergy() + run.world().potentialEnergy(); };
    const double first = energy();
    double lowest = first;
    double gain = 0;
    while (run.world().time() < seconds) {
        run.step();
        gain = std::max(gain, energy() - lowest);
        lowest = std::min(lowest, energy());
    }
    return gain / first;
}

TEST(Bullet, GivesTheWallsNoEnergyThatItDoesNotHave) {
    const Scene scene = builtInScene("stacks5");
    EXPECT_LT(gainOf(scene, Preset::performance, 2.5), 5e-3);
    EXPECT_LT(gainOf(scene, Preset::accuracy, 1.5), 5e-3);
}

TEST(Bullet, GoesThroughAllWallsAndLowerPartsStayStanding) {
    const Scene scene = builtInScene("stacks5");
    double farthest_wall = 0;
    for (const SceneBody& body : scene.bodies) {
        if (!body.fixed) farthest_wall = std::max(farthest_wall, body.position.x());
    }
    // A collapse takes another course with every last bit: 2 to 10 boxes stand in single runs.
    constexpr std::array tolerances{0.1, 0.125, 0.15, 0.175, 0.2};
    double standing = 0;
    for (const double tolerance : tolerances) {
        Settings settings = settingsFor(scene);
        settings.resolution.tolerance = tolerance;
        SceneRun run(scene, settings);
        runFor(run, scene.duration);
        EXPECT_GT(run.world().pose(run.ids().back()).position.x(), farthest_wall + 1);
        standing += static_cast<double>(std::ranges::count_if(run.ids(), [&](BodyId id) {
            return !run.world().isFixed(id) && run.world().pose(id).position.z() > 0.14;
        }));
    }
    EXPECT_GE(standing / tolerances.size(), 4) << "9 to 14 do with the preset accuracy";
}

TEST(Well, KeepsAPileOfBalls) {
    const Scene scene = builtInScene("well324");
    SceneRun run(scene, settingsFor(scene));
    runFor(run, scene.duration);
    const auto inside = std::ranges::count_if(run.ids(), [&](BodyId id) {
        const Vec3 p = run.world().pose(id).position;
        return !run.world().isFixed(id) && std::abs(p.x()) < 0.5 && std::abs(p.y()) < 0.5;
    });
    EXPECT_GT(inside, 60);
}

TEST(Cage, BodiesComeToRestAndFallAsleep) {
    const Scene scene = builtInScene("cage384");
    SceneRun run(scene, settingsFor(scene));
    runFor(run, scene.duration);
    EXPECT_GT(run.world().statistics().asleep, 250);
    for (const BodyId id : run.ids()) {
        if (run.world().isFixed(id)) continue;
        const Vec3 p = run.world().pose(id).position;
        EXPECT_LT(std::abs(p.x()), 1.725);
        EXPECT_LT(std::abs(p.y()), 1.725);
        EXPECT_LT(p.z(), 2.65);
    }
}

/// Terrain, moved ground and machines: for a second, with all checks.
TEST(BuiltInScenes, OfTerrainAndMachinesLoseNobody) {
    for (const char* name : {"rockfall", "shake_table", "excavator", "drum"}) {
        const Scene scene = builtInScene(name);
        SceneRun run(scene, settingsFor(scene));
        run.world().setChecks(Checks::on);
        for (int i = 0; i < 30; ++i) run.simulationStep();
        EXPECT_TRUE(run.world().faults().empty()) << name;
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            if (scene.bodies[i].fixed) continue;
            const Ray down{run.world().centreOfMass(run.ids()[i]), -Vec3::UnitZ()};
            const auto hits = run.world().castRayThrough(down);
            EXPECT_TRUE(std::ranges::any_of(hits, [&](const RayHit& hit) { return run.world().isFixed(hit.body); }))
                << name << ": nothing fixed is below body " << i;
        }
    }
}

TEST(BuiltInScenes, OfMachinesDoTheirWork) {
    const Scene excavator = builtInScene("excavator");
    SceneRun digs(excavator, settingsFor(excavator));
    const auto bucket = static_cast<std::size_t>(std::ranges::find(excavator.bodies, "bucket", &SceneBody::name) -
                                                 excavator.bodies.begin());
    const Vec3 before = digs.world().pose(digs.ids()[bucket]).position;
    for (int i = 0; i < 150; ++i) digs.simulationStep();
    EXPECT_GT((digs.world().pose(digs.ids()[bucket]).position - before).norm(), 0.3) << "the servos move the arm";

    const Scene drum = builtInScene("drum");
    SceneRun feeds(drum, settingsFor(drum));
    for (int i = 0; i < 240; ++i) feeds.simulationStep();
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < drum.bodies.size(); ++i) {
        if (!drum.bodies[i].fixed && feeds.world().pose(feeds.ids()[i]).position.x() < -4.2) ++beyond;
    }
    EXPECT_GT(beyond, 10U) << "stones that the belt carried to its end";
}

}  // namespace
}  // namespace cairn
