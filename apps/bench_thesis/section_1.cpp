/// @file §5.1: six scenes, Tables 2 and 3.
#include <fmt/format.h>

#include "machine.h"
#include "runs.h"

namespace cairn::thesis {

namespace {

constexpr double real_time_ms = 1000 / simulation_steps_per_second;

/// Tables 2 and 3: a scene's row, its figure and its pictures.
void addScene(SectionResult& result, const ThesisScene& scene, const Plan& plan, const Series& series) {
    const std::string key = keyOf(plainRun(scene.name, plan));
    const std::size_t first = result.entries.size();
    const double average = sum(series.total_ms) / static_cast<double>(series.steps());
    const auto share = [&](const std::vector<double>& part) { return 100 * sum(part) / sum(series.total_ms); };
    const std::string id = "5.1/" + scene.name;
    result.entries.push_back({id + "/total", rowText(scene, "whole simulation"), "s", scene.total_s, series.total_s,
                              fmt::format("thesis: {}, {} threads; ours: {:.0f} threads", scene.machine.name,
                                          scene.machine.threads, series.threads),
                              processorPart(scene, plan, scene.total_s / series.total_s)});
    result.entries.push_back(
        {id + "/average", rowText(scene, "average simulation step"), "ms", scene.average_ms, average,
         fmt::format("{:.0f} % detection, {:.0f} % response; longest step {:.1f} ms", share(series.detection_ms),
                     share(series.response_ms), largest(series.total_ms)),
         processorPart(scene, plan, scene.average_ms / average)});
    markShortened(result, first, plainRun(scene.name, plan), plan);
    result.figures.push_back(
        {id,
         scene.figure,
         fmt::format("{}, {}", scene.name, scene.title),
         "simulation step (1/30 s)",
         "time per simulation step [ms]",
         {{"whole step", series.total_ms}, {"response", series.response_ms}, {"detection", series.detection_ms}},
         {{fmt::format("thesis, average {} ms", scene.average_ms), scene.average_ms}}});
    if (scene.average_ms < real_time_ms) result.figures.back().references.push_back({"real time", real_time_ms});
    result.pictures.push_back({scene.pictures, scene.name + ", performance settings", key, scene.camera});
}

void addGoal(SectionResult& result, const Plan& plan, const ThesisScene& scene, const Series& series) {
    if (!plan.processor_rating || plan.extent == Extent::quick) return;
    const double factor = *plan.processor_rating / scene.machine.rating;
    const double speedup = scene.total_s / series.total_s;
    result.goals.push_back(
        {fmt::format("{}: faster than the thesis by the factor of the processor ({:.1f}); it is {:.1f}", scene.name,
                     factor, speedup),
         speedup >= factor});
}

}  // namespace

Section generalPerformance(const Plan& plan) {
    Section section{"5.1",
                    "General performance",
                    "High performance settings: 240 time steps per second. Detection includes the generation of the "
                    "batches; response is penetration correction, velocities, contact resolution and sleeping.",
                    {},
                    {}};
    for (const ThesisScene& scene : thesisScenes()) {
        section.experiments.push_back(experimentOf(plainRun(scene.name, plan), plan));
    }
    section.evaluate = [plan](const Results& results) {
        SectionResult result;
        for (const ThesisScene& scene : thesisScenes()) {
            const Series series = seriesOf(results, keyOf(plainRun(scene.name, plan)));
            addScene(result, scene, plan, series);
            addGoal(result, plan, scene, series);
            result.checks.push_back({scene.name + ": no body is lost", series.lost == 0});
        }
        return result;
    };
    return section;
}

}  // namespace cairn::thesis
