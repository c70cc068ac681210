/// The same input gives bit-identical states on any number of threads, at every time step of every scene.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "cairn/scene.h"
#include "golden/scene_names.h"
#include "golden/scenes.h"

namespace cairn {
namespace {

/// The golden scenes with all their settings; CAIRN_FULL_TESTS=1 runs them to their ends with the preset performance.
class Threads : public testing::TestWithParam<golden::SceneAndKind> {};

TEST_P(Threads, StatesAreEqualAtEveryStep) {
    const auto [name, kind] = GetParam();
    const golden::GoldenScene& scene = golden::goldenScene(name);
    std::vector<std::unique_ptr<golden::GoldenRun>> runs;
    for (const std::int64_t threads : {1, 2, 3, 4, 8}) {
        runs.push_back(std::make_unique<golden::GoldenRun>(scene, kind, threads));
    }
    const World& first = runs.front()->world();
    const bool full = std::getenv("CAIRN_FULL_TESTS") != nullptr && kind == golden::Kind::performance;
    const std::int64_t last_step = scene.hashSteps(kind).back();
    const double seconds = full ? runs.front()->duration() : 0;
    while (first.stepCount() < last_step || first.time() < seconds) {
        for (const auto& run : runs) run->step();
        for (const auto& run : runs) {
            ASSERT_EQ(run->world().stateHash(), first.stateHash())
                << run->world().settings().parallel.threads << " threads, time step " << first.stepCount();
        }
    }
    EXPECT_TRUE(first.faults().empty());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Threads, testing::ValuesIn(golden::everySceneWithEveryKind()),
                         golden::nameOfSceneAndKind);

TEST(PositionSweeps, GiveTheSameStatesOnAnyNumberOfThreads) {
    const Scene scene = builtInScene("cage384");
    Settings settings = settingsFor(scene);
    settings.correction.correction = CorrectionKind::position_sweeps;
    SceneRun one(scene, settings);
    settings.parallel = {3, true};
    SceneRun three(scene, settings);
    std::int64_t displaced = 0;
    for (int i = 0; i < 360; ++i) {
        one.step();
        three.step();
        displaced += one.world().statistics().displaced_bodies;
        ASSERT_EQ(one.world().stateHash(), three.world().stateHash()) << i;
    }
    EXPECT_GT(displaced, 0);
}

}  // namespace
}  // namespace cairn
