/// The same input gives bit-identical states on any number of threads, at every time step of every scene.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "cairn/scene.h"

namespace cairn {
namespace {

/// A scene and the part of it that the quick test runs; CAIRN_FULL_TESTS=1 runs scenes to their end.
struct Case {
    std::string scene;
    double seconds;
};

class Threads : public testing::TestWithParam<Case> {};

TEST_P(Threads, StatesAreEqualAtEveryStep) {
    const Scene scene = builtInScene(GetParam().scene);
    std::vector<std::unique_ptr<SceneRun>> runs;
    for (const std::int64_t threads : {1, 2, 3, 4, 8}) {
        Settings settings = settingsFor(scene);
        settings.parallel.threads = threads;
        runs.push_back(std::make_unique<SceneRun>(scene, settings));
    }
    const bool full = std::getenv("CAIRN_FULL_TESTS") != nullptr;
    const double seconds = full ? scene.duration : GetParam().seconds;
    while (runs.front()->world().time() < seconds) {
        for (const auto& run : runs) run->step();
        const World& first = runs.front()->world();
        for (const auto& run : runs) {
            ASSERT_EQ(run->world().stateHash(), first.stateHash())
                << run->world().settings().parallel.threads << " threads, time step " << first.stepCount();
        }
    }
    EXPECT_TRUE(runs.front()->world().faults().empty());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Threads,
                         testing::Values(Case{"stacks5", 1.5}, Case{"stacks8", 1.2}, Case{"well324", 1.0},
                                         Case{"well392", 1.0}, Case{"cage384", 2.0}, Case{"cage2816", 0.6},
                                         Case{"catapult7", 2.0}, Case{"catapult15", 2.0}, Case{"cradle", 2.0},
                                         Case{"tower:10", 1.0}, Case{"wall:10", 0.5}, Case{"heap:100", 1.5}),
                         [](const auto& test) {
                             std::string name = test.param.scene;
                             for (char& c : name) {
                                 if (c == ':') c = '_';
                             }
                             return name;
                         });

TEST(BodyOrder, BroadPhasesGiveTheSameRun) {
    const Scene scene = builtInScene("cage384");
    Settings settings = settingsFor(scene);
    SceneRun grids(scene, settings);
    settings.detection.broad_phase = BroadPhaseKind::all_pairs;
    SceneRun all_pairs(scene, settings);
    for (int i = 0; i < 360; ++i) {
        grids.step();
        all_pairs.step();
        ASSERT_EQ(grids.world().stateHash(), all_pairs.world().stateHash()) << i;
    }
}

}  // namespace
}  // namespace cairn
