/// @file The suites run, say what they measured, and refuse what they cannot do.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "bench/kernels.h"
#include "bench/peers.h"
#include "bench/plot.h"
#include "bench/ray_casters.h"
#include "bench/rays.h"
#include "bench/scaling.h"
#include "bench/scenes.h"

namespace cairn::bench {
namespace {

std::set<std::string> namesOf(const Json& entries) {
    std::set<std::string> names;
    for (const Json& entry : entries) names.insert(entry.at("name").get<std::string>());
    return names;
}

const Json& entryOf(const Json& results, const std::string& name) {
    for (const Json& entry : results.at("entries")) {
        if (entry.at("name") == name) return entry;
    }
    throw std::out_of_range(name);
}

PeersOptions quickPeers() {
    PeersOptions options;
    options.scenes = {"tower:3", "heavy:2"};
    options.engines = {"cairn"};
    options.longest = 0.2;
    options.repetitions = 2;
    options.progress = [](double, const std::string&) {};
    return options;
}

ScenesOptions quickScenes() {
    ScenesOptions options;
    options.scenes = {"tower:3"};
    options.longest = 0.2;
    options.repetitions = 2;
    options.progress = [](double, const std::string&) {};
    return options;
}

/// Whether this program was built with an engine.
bool has(EngineKind (*make)()) {
    try {
        make();
        return true;
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("install the Debian package"), std::string::npos) << error.what();
        return false;
    }
}

TEST(Peers, MeasureTimeAndQualityOfEachSceneAndEngine) {
    PeersOptions options = quickPeers();
    options.variants = {{"plain", {{"resolution", "sweep"}}}};
    const Outcome outcome = runPeers(options);
    EXPECT_EQ(namesOf(outcome.json.at("entries")),
              (std::set<std::string>{"tower:3/cairn", "tower:3/plain", "heavy:2/cairn", "heavy:2/plain"}));
    const Json& entry = entryOf(outcome.json, "tower:3/cairn");
    EXPECT_EQ(entry.at("step_ms").size(), 6U);
    EXPECT_GT(entry.at("values").at("average_ms"), 0);
    EXPECT_NEAR(entry.at("values").at("highest_m").get<double>(), 0.25, 1e-3);
    EXPECT_EQ(entry.at("values").at("lost"), 0);
    EXPECT_NE(outcome.table.find("tower:3"), std::string::npos);
    EXPECT_NE(outcome.json.at("engines").at("plain").at("settings").get<std::string>().find("resolution=sweep"),
              std::string::npos);
}

TEST(Peers, TellWhereSleepingIsOff) {
    PeersOptions options = quickPeers();
    options.scenes = {"tower:3"};
    options.variants = {{"exact", {}, Preset::accuracy}};
    options.sleeping = false;
    const Outcome outcome = runPeers(options);
    EXPECT_EQ(namesOf(outcome.json.at("entries")), (std::set<std::string>{"tower:3/cairn", "tower:3/exact"}));
    for (const char* engine : {"cairn", "exact"}) {
        const auto settings = outcome.json.at("engines").at(engine).at("settings").get<std::string>();
        EXPECT_NE(settings.find("sleeping off"), std::string::npos);
    }
    EXPECT_EQ(outcome.json.at("sleeping"), false);
}

/// Cairn without gravity damping: that takes a part of gravity from bodies that begin to fall, on purpose.
EngineKind undampedCairn() {
    SettingOverrides overrides;
    overrides.fields = {{"damping", "0"}};
    return cairnEngine("cairn", overrides, 1);
}

TEST(Peers, GiveEveryEngineTheSameStart) {
    // After one simulation step nothing has had time to fall apart: a body of the wrong size, place, mass or gravity
    // would show.
    for (EngineKind (*make)() : {bulletEngine, odeEngine}) {
        if (!has(make)) continue;
        const EngineKind kind = make();
        for (const char* name : {"tower:3", "cage384", "heap:20"}) {
            const Scene scene = builtInScene(name);
            const RigidScene rigid(scene);
            const auto theirs = kind.make(scene, rigid, {240, true});
            const auto ours = undampedCairn().make(scene, rigid, {240, true});
            for (int i = 0; i < 8; ++i) {
                theirs->step();
                ours->step();
            }
            std::vector<Pose> their_poses, our_poses;
            theirs->poses(their_poses);
            ours->poses(our_poses);
            ASSERT_EQ(their_poses.size(), our_poses.size());
            for (std::size_t i = 0; i < our_poses.size(); ++i) {
                EXPECT_LT((their_poses[i].position - our_poses[i].position).norm(), 3e-3)
                    << kind.name << ", " << name << ", body " << i;
                EXPECT_LT(their_poses[i].orientation.angularDistance(our_poses[i].orientation), 3e-2)
                    << kind.name << ", " << name << ", body " << i;
            }
        }
    }
}

TEST(Peers, FallFreelyAsTheirGravitySays) {
    Scene scene = builtInScene("tower:1");
    scene.bodies[1].position = {0, 0, 10};
    scene.gravity.setZero();
    scene.events = {{0.1, SetGravity{{0, 0, -10}}}};
    const RigidScene rigid(scene);
    std::vector<EngineKind> kinds = {undampedCairn()};
    for (EngineKind (*make)() : {bulletEngine, odeEngine}) {
        if (has(make)) kinds.push_back(make());
    }
    for (const EngineKind& kind : kinds) {
        const auto engine = kind.make(scene, rigid, {240, true});
        std::vector<Pose> poses;
        for (int i = 0; i < 24; ++i) engine->step();
        engine->poses(poses);
        EXPECT_NEAR(poses[1].position.z(), 10, 1e-6) << kind.name;
        for (int i = 0; i < 120; ++i) engine->step();
        engine->poses(poses);
        // Schemes of first order differ by a time step's fall.
        EXPECT_NEAR(poses[1].position.z(), 10 - 0.5 * 10 * 0.25, 5.0 / 240) << kind.name;
    }
}

TEST(Peers, ArePlottedWithADotForEachMeasurement) {
    PeersOptions options = quickPeers();
    options.variants = {{"a<b&c", {}}};
    const std::string svg = peersPlot(runPeers(options).json);
    std::size_t dots = 0;
    for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) ++dots;
    EXPECT_EQ(dots, 8U);  // two scenes, two engines, time and overlap
    EXPECT_NE(svg.find("a&lt;b&amp;c"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Peers, RefuseWhatTheyDoNotKnow) {
    PeersOptions options = quickPeers();
    options.engines = {"havok"};
    EXPECT_THROW(runPeers(options), InputError);
    options = quickPeers();
    options.scenes = {"nonsense"};
    EXPECT_THROW(runPeers(options), InputError);
    options = quickPeers();
    options.steps_per_second = 100;
    EXPECT_THROW(runPeers(options), InputError);
    options = quickPeers();
    options.variants = {{"cairn", {}}};
    EXPECT_THROW(runPeers(options), InputError);
    options = quickPeers();
    options.overrides.fields = {{"nonsense", "1"}};
    EXPECT_THROW(runPeers(options), InputError);
}

TEST(Peers, StopWhenAskedTo) {
    PeersOptions options = quickPeers();
    options.progress = [](double part, const std::string&) {
        EXPECT_GE(part, 0);
        EXPECT_LE(part, 1);
        if (part > 0.4) throw Interrupted{};
    };
    EXPECT_THROW(runPeers(options), Interrupted);
}

TEST(Scenes, MeasureEachNumberOfThreadsAndVariant) {
    ScenesOptions options = quickScenes();
    options.threads = {1, 2};
    options.variants = {{"plain", {{"resolution", "sweep"}}}};
    const Outcome outcome = runScenes(options);
    EXPECT_EQ(namesOf(outcome.json.at("entries")),
              (std::set<std::string>{"tower:3/threads1", "tower:3/threads2", "tower:3/plain/threads1",
                                     "tower:3/plain/threads2"}));
    const Json& one = entryOf(outcome.json, "tower:3/threads1");
    EXPECT_EQ(one.at("state_hash"), entryOf(outcome.json, "tower:3/threads2").at("state_hash"));
    EXPECT_EQ(one.at("step_ms").size(), 6U);
    EXPECT_EQ(one.at("stages_ms").size(), stage_count);
    EXPECT_GT(one.at("values").at("contacts"), 0);
    for (const char* key : {"suite", "version", "date", "machine", "compiler", "flags"}) {
        EXPECT_TRUE(outcome.json.contains(key)) << key;
    }
}

TEST(Scenes, CompareAFallingPileWithTheSettledOne) {
    ScenesOptions options = quickScenes();
    options.scenes = {"pile:20"};
    options.longest = 5;
    options.repetitions = 1;
    const Json json = runScenes(options).json;
    const Json& values = entryOf(json, "pile:20/threads1").at("values");
    EXPECT_GT(values.at("falling_seconds"), 0.1);
    EXPECT_LT(values.at("falling_seconds"), 5);
    EXPECT_GT(values.at("falling_ms"), 0);
    EXPECT_GT(values.at("settled_ms"), 0);
    EXPECT_EQ(values.at("asleep"), 0);
}

KernelsOptions quickKernels(const std::string& filter) {
    KernelsOptions options;
    options.filter = filter;
    options.extent = Extent::quick;
    options.progress = [](double, const std::string&) {};
    return options;
}

TEST(Kernels, MeasureWhatWasAskedFor) {
    try {
        const Outcome outcome = runKernels(quickKernels("resolve_contact$|^correction/|sphere_box|^broad_phase/"));
        EXPECT_EQ(namesOf(outcome.json.at("entries")),
                  (std::set<std::string>{"resolution/resolve_contact", "correction/correct_contact",
                                         "narrow_phase/sphere_box", "broad_phase/insert", "broad_phase/query",
                                         "broad_phase/find_pairs"}));
        for (const Json& entry : outcome.json.at("entries")) {
            EXPECT_GT(entry.at("values").at("item_ns"), 0) << entry.at("name");
        }
        EXPECT_THROW(runKernels(quickKernels("nonsense")), InputError);
        EXPECT_THROW(runKernels(quickKernels("(")), InputError);
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("install the Debian package"), std::string::npos) << error.what();
    }
}

ScalingOptions quickScaling() {
    ScalingOptions options;
    options.sizes = {500};
    options.threads = {1, 2};
    options.extent = Extent::quick;
    options.progress = [](double, const std::string&) {};
    return options;
}

TEST(Scaling, BeginsEveryNumberOfThreadsWithTheSameState) {
    const Outcome outcome = runScaling(quickScaling());
    EXPECT_EQ(namesOf(outcome.json.at("entries")),
              (std::set<std::string>{"one/falling/500/threads1", "one/falling/500/threads2",
                                     "many/falling/500/threads1", "many/falling/500/threads2"}));
    const Json& one = entryOf(outcome.json, "one/falling/500/threads1");
    EXPECT_EQ(one.at("state_hash"), entryOf(outcome.json, "one/falling/500/threads2").at("state_hash"));
    EXPECT_GT(one.at("values").at("body_step_us"), 0);
    EXPECT_GT(one.at("values").at("contacts_per_body"), 1);
    EXPECT_GT(one.at("values").at("bytes_per_body"), 100);
    EXPECT_EQ(one.at("values").at("growth"), 1);
}

TEST(Scaling, HeapsOfAllSizesAreEquallyDense) {
    for (const char* layout : {"one", "many"}) {
        const Scene small = scalingScene(layout, 1000);
        const Scene large = scalingScene(layout, 10000);
        const auto dynamic = [](const Scene& scene) {
            return static_cast<double>(std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                                     [](const SceneBody& body) { return !body.fixed; }));
        };
        EXPECT_NEAR(dynamic(small), 1000, 100) << layout;
        EXPECT_NEAR(dynamic(large), 10000, 1000) << layout;
        // No two bodies begin in the same place, and none inside a wall.
        SettingOverrides overrides;
        overrides.fields = {{"correction", "none"}};
        SceneRun run(small, settingsFor(small, overrides));
        run.step();
        EXPECT_LT(run.world().statistics().largest_overlap, 1e-4) << layout;
    }
    EXPECT_THROW(scalingScene("one", 0), InputError);
    EXPECT_THROW(scalingScene("one", 2'000'000), InputError);
}

TEST(Scaling, RefusesWrongSettingsBeforeItBegins) {
    ScalingOptions options = quickScaling();
    options.variants = {{"wrong", {{"nonsense", "1"}}}};
    EXPECT_THROW(runScaling(options), InputError);
}

/// Whether Bullet's hits are Cairn's within what Bullet's search calls a surface.
TEST(Rays, OfEveryEngineEndOnTheSameSurfaces) {
    RaysOptions options;
    options.scene = "heap:200";
    options.extent = Extent::quick;
    options.progress = [](double, const std::string&) {};
    try {
        bulletRayCasters();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("install the Debian package"), std::string::npos) << error.what();
        EXPECT_THROW(runRays(options), InputError);
        return;
    }
    const Outcome outcome = runRays(options);
    EXPECT_EQ(namesOf(outcome.json.at("entries")),
              (std::set<std::string>{"heap:200/cairn", "heap:200/bullet", "heap:200/bullet gjk"}));
    const auto hits = entryOf(outcome.json, "heap:200/cairn").at("values").at("hits").get<int>();
    EXPECT_GT(hits, 1000);
    for (const Json& entry : outcome.json.at("entries")) {
        const Json& values = entry.at("values");
        EXPECT_GT(values.at("ray_us"), 0);
        // Bullet's search now and then ends in the air, or goes past a body that the ray grazes.
        EXPECT_LE(values.at("median_from_surface_mm").get<double>(), 0.01) << entry.at("name");
        EXPECT_LE(values.at("median_difference_mm").get<double>(), 0.01) << entry.at("name");
        EXPECT_LE(values.at("other_body").get<int>(), hits / 40) << entry.at("name");
        EXPECT_LE(values.at("in_the_air").get<int>(), hits / 40) << entry.at("name");
        EXPECT_LE(values.at("passed").get<int>(), hits / 40) << entry.at("name");
        EXPECT_EQ(values.at("before").get<int>(), 0) << entry.at("name");
    }
    options.scene = "cradle_swing:5:2";
    EXPECT_THROW(runRays(options), InputError);
}

TEST(Variants, ChangeFieldsAndPreset) {
    SettingOverrides all;
    all.preset = Preset::performance;
    all.fields = {{"damping", "0"}};
    const SettingOverrides made = combined(all, {"exact", {{"iterations", "7"}}, Preset::accuracy});
    EXPECT_EQ(made.preset, Preset::accuracy);
    EXPECT_EQ(made.fields, (std::vector<std::pair<std::string, std::string>>{{"damping", "0"}, {"iterations", "7"}}));
    EXPECT_EQ(combined(all, {"plain", {}}).preset, Preset::performance);
}

}  // namespace
}  // namespace cairn::bench
