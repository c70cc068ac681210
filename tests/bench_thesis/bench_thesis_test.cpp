/// @file Parts of the thesis's benchmarks.
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "bench_thesis/bench.h"
#include "bench_thesis/runs.h"
#include "bench_thesis/section.h"
#include "bench_thesis/series.h"
#include "bench_thesis/store.h"
#include "bench_thesis/thesis_settings.h"
#include "temporary_folder.h"

namespace cairn::thesis {
namespace {

namespace fs = std::filesystem;

class ThesisFolder : public ::testing::Test {
  protected:
    test::TemporaryFolder folder;
};

Experiment constantExperiment(const std::string& key, int* runs) {
    return {key, 1, true, "scene and settings", [runs](const Surroundings& surroundings) {
                surroundings.progress(1);
                return Json{{"run", ++*runs}};
            }};
}

TEST(ThesisSettings, AreThoseOfTheHighPerformanceBenchmarks) {
    const Settings s = thesisSettings(Preset::thesis, 2);
    EXPECT_EQ(s.steps_per_second, 240);
    EXPECT_EQ(s.correction.correction, CorrectionKind::propagated);
    EXPECT_EQ(s.correction.penetration_threshold, 1.74e-3);
    EXPECT_EQ(s.sleep.sleep_threshold, 8.33e-3);
    EXPECT_EQ(s.resolution.resolution, ResolutionKind::impulse_queue);
    EXPECT_EQ(s.resolution.resolution_threshold, 83.4e-6);
    EXPECT_EQ(s.resolution.iterations, 2);
    EXPECT_TRUE(s.resolution.shock_propagation);
    EXPECT_EQ(s.resolution.restitution_threshold, 4.58e-2);
    EXPECT_EQ(s.sleep.damping, 0.7);
    EXPECT_EQ(s.parallel.threads, 2);
    EXPECT_NO_THROW(validate(s, {0, 0, -10}));
}

TEST(ThesisSettings, AreThoseOfTheHighAccuracyBenchmarks) {
    const Settings s = thesisSettings(Preset::thesis_accuracy, 1);
    EXPECT_EQ(s.steps_per_second, 960);
    EXPECT_EQ(s.correction.penetration_threshold, 0.1e-3);
    EXPECT_EQ(s.sleep.sleep_threshold, 0.52e-3);
    EXPECT_EQ(s.resolution.resolution_threshold, 5.2e-6);
    EXPECT_EQ(s.resolution.iterations, 0);
    EXPECT_FALSE(s.resolution.shock_propagation);
    EXPECT_EQ(s.resolution.restitution_threshold, 1.15e-2);
    EXPECT_EQ(s.sleep.damping, 0);
    EXPECT_NO_THROW(validate(s, {0, 0, -10}));
}

TEST(ThesisSettings, VariantsChangeWhatTheyAreNamedFor) {
    EXPECT_EQ(thesisSettings(Preset::thesis, 1, Variant::undamped).sleep.damping, 0);
    for (const Variant variant : {Variant::greedy, Variant::latest_first}) {
        const Settings s = thesisSettings(Preset::thesis, 1, variant);
        EXPECT_EQ(s.resolution.iterations, 0);
        EXPECT_FALSE(s.resolution.shock_propagation);
        EXPECT_EQ(s.sleep.damping, 0.7);
        EXPECT_EQ(s.resolution.resolution,
                  variant == Variant::greedy ? ResolutionKind::impulse_queue : ResolutionKind::arbitrary_order);
    }
}

TEST(Series, TakeTheMedianOfTheRepetitionsStepByStep) {
    const auto repetition = [](std::vector<double> ms) {
        Json value = {{"bodies", 3}, {"threads", 2}, {"lost", 0}, {"state_hash", "abc"}};
        for (const char* member :
             {"total_ms", "detection_ms", "response_ms", "iterations", "contacts", "largest_batch", "asleep"}) {
            value[member] = ms;
        }
        return value;
    };
    const Results results = {{"scene", {repetition({1, 9}), repetition({2, 1}), repetition({9, 2})}}};
    const Series series = seriesOf(results, "scene");
    EXPECT_EQ(series.total_ms, (std::vector<double>{2, 2}));
    EXPECT_DOUBLE_EQ(series.total_s, 0.010);  // the median of 10, 3 and 11 ms
    EXPECT_EQ(series.repetitions, 3U);
    EXPECT_THROW(seriesOf(results, "other"), std::logic_error);
}

TEST(Series, FindTheBestStepAmongThoseThatCount) {
    const BestStep best = bestStep({1, 100, 90, 100}, {0.01, 50, 30, 0}, 0.2);
    EXPECT_EQ(best.step, 3U);  // the first is too short, the last has no time to compare with
    EXPECT_DOUBLE_EQ(best.ratio, 3);
}

TEST(Entry, OwesAnExplanationOnlyWithAThesisValue) {
    EXPECT_FALSE(differenceOf({"id", "what", "", {}, 5.0, ""}).has_value());
    EXPECT_FALSE(differenceOf({"id", "what", "", 5.0, {}, ""}).has_value());
    EXPECT_DOUBLE_EQ(differenceOf({"id", "what", "", 4.0, 5.0, ""}).value(), 0.25);
}

TEST(Entry, OfAPartOfASceneHasNoFactorToTheThesis) {
    SectionResult result;
    result.entries = {{"5.1/cage2816/total", "what", "s", 356.0, 0.5, "", "712 times as fast"}};
    const Section section{"5.1", "title", "text", {}, {}};
    EXPECT_EQ(toJson(section, result).at("entries").at(0).at("explanation"), "712 times as fast");
    result.entries.front().shortened = true;
    const Json entry = toJson(section, result).at("entries").at(0);
    EXPECT_TRUE(entry.at("difference_percent").is_null());
    EXPECT_FALSE(entry.contains("explanation"));
    EXPECT_EQ(entry.at("shortened"), true);
}

TEST(Runs, AreShortenedInAQuickRunOnlyAndOnlyWhereTheyEndEarly) {
    const auto marked = [](Extent extent, const std::string& scene) {
        const Plan plan{extent, 2};
        SectionResult result;
        result.entries = {{"before", "", "", {}, {}, ""}, {"after", "", "", {}, {}, ""}};
        markShortened(result, 1, plainRun(scene, plan), plan);
        EXPECT_FALSE(result.entries[0].shortened);
        return result.entries[1].shortened;
    };
    EXPECT_TRUE(marked(Extent::quick, "cage2816"));
    EXPECT_FALSE(marked(Extent::quick, "stacks5"));
    EXPECT_FALSE(marked(Extent::full, "cage2816"));
}

TEST(Sections, NameEachExperimentOnceAndShareTheSameRuns) {
    const std::vector<Section> sections = allSections({Extent::quick, 2});
    ASSERT_EQ(sections.size(), 6U);
    std::map<std::string, std::string> fingerprints;
    for (const Section& section : sections) {
        for (const Experiment& experiment : section.experiments) {
            const auto [found, isNew] = fingerprints.emplace(experiment.key, experiment.fingerprint);
            EXPECT_EQ(found->second, experiment.fingerprint) << experiment.key;
        }
    }
    EXPECT_EQ(fingerprints.count("stacks5-performance-threads2"), 1U);
    EXPECT_EQ(fingerprints.count("cradle-7-6"), 1U);
}

TEST_F(ThesisFolder, KeepsWhatTheSameEngineMeasured) {
    int runs = 0;
    const Experiment experiment = constantExperiment("a", &runs);
    Store first(folder / "results.json", {{"engine", "1"}});
    first.add(experiment, {{"x", 1}}, 5);
    first.add(experiment, {{"x", 2}}, 7);

    const Store second(folder / "results.json", {{"engine", "1"}});
    EXPECT_EQ(second.repetitions(experiment), 2U);
    EXPECT_EQ(second.spent(experiment), 12);
    EXPECT_EQ(second.results().at("a").at(1).at("x"), 2);
}

TEST_F(ThesisFolder, ForgetsWhatAnotherEngineSceneOrSettingMeasured) {
    int runs = 0;
    Experiment experiment = constantExperiment("a", &runs);
    Store(folder / "results.json", {{"engine", "1"}}).add(experiment, {{"x", 1}}, 5);
    EXPECT_EQ(Store(folder / "results.json", {{"engine", "2"}}).repetitions(experiment), 0U);
    experiment.fingerprint = "another scene";
    EXPECT_EQ(Store(folder / "results.json", {{"engine", "1"}}).repetitions(experiment), 0U);
}

TEST_F(ThesisFolder, RefusesAFileThatIsNoResultsFile) {
    std::ofstream(folder / "results.json") << "{ \"format\": ";
    EXPECT_THROW(Store(folder / "results.json", {}), IoError);
}

TEST_F(ThesisFolder, GoesOnWhereItWasInterrupted) {
    BenchOptions options;
    options.out = folder.path();
    options.only = {"5.6"};
    options.extent = Extent::quick;
    std::vector<std::string> begun;
    options.progress = [&](const Position& position) {
        if (begun.empty() || begun.back() != position.what) begun.push_back(position.what);
    };
    options.interrupted = [&] { return begun.size() >= 4; };
    EXPECT_THROW(runBench(options), Interrupted);
    EXPECT_FALSE(fs::exists(folder / "index.html"));
    const std::vector<std::string> before = begun;

    begun.clear();
    options.interrupted = [] { return false; };
    const BenchOutcome outcome = runBench(options);
    ASSERT_FALSE(begun.empty());
    EXPECT_EQ(begun.front(), before.back());  // the one that was interrupted, and none before it
    EXPECT_EQ(outcome.broken, std::vector<std::string>{});
    EXPECT_TRUE(fs::exists(folder / "results.json"));

    begun.clear();
    runBench(options);
    EXPECT_TRUE(begun.empty());
}

TEST_F(ThesisFolder, ReportsOnlyWhatWasMeasured) {
    BenchOptions options;
    options.out = folder.path();
    options.only = {"5.6"};
    options.extent = Extent::quick;
    runBench(options);
    std::ifstream file(folder / "results.json");
    const Json report = Json::parse(file).at("report");
    ASSERT_EQ(report.at("sections").size(), 1U);
    EXPECT_EQ(report.at("sections").at(0).at("id"), "5.6");
}

TEST_F(ThesisFolder, RefusesASectionThatTheThesisDoesNotHave) {
    BenchOptions options;
    options.out = folder.path();
    options.only = {"5.7"};
    try {
        runBench(options);
        FAIL() << "5.7 was accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("5.1, 5.2, 5.3, 5.4, 5.5, 5.6"), std::string::npos) << error.what();
    }
}

TEST_F(ThesisFolder, DrawsPicturesOnceAndSaysWhyTheyAreMissing) {
    BenchOptions options;
    options.out = folder.path();
    options.only = {"5.6"};
    options.extent = Extent::quick;
    int drawn = 0;
    options.picture = [&](const Picture& picture) {
        const RecordingReader recording(picture.recording);
        EXPECT_GT(recording.info().bodies, 0U);
        EXPECT_EQ(picture.camera.size(), 6U);
        std::ofstream(picture.file) << "PNG";
        ++drawn;
    };
    runBench(options);
    EXPECT_EQ(drawn, 6);
    runBench(options);
    EXPECT_EQ(drawn, 6);

    fs::remove_all(folder / "pictures");
    options.picture = [](const Picture&) { throw IoError("no browser"); };
    const BenchOutcome outcome = runBench(options);
    ASSERT_EQ(outcome.warnings.size(), 1U);
    EXPECT_NE(outcome.warnings.front().find("no browser"), std::string::npos);
}

}  // namespace
}  // namespace cairn::thesis
