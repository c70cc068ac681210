/// @file §5.5: high accuracy against high performance, Table 7.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runs.h"

namespace cairn::thesis {

namespace section_5 {
namespace {

constexpr double ratio_floor = 0.1;

struct Published {
    const char* scene;
    const char* figure;
    double speedup;
    double average_ms;  ///< with the accuracy settings
    double best_step;
};
constexpr std::array<Published, 3> published = {{{"stacks5", "Figure 36(a)", 29.03, 482.80, 75.3},
                                                 {"well324", "Figure 36(b)", 17.67, 264.32, 58.4},
                                                 {"cage384", "Figure 36(c)", 6.88, 121.17, 10.3}}};

Run accurate(const std::string& scene, const Plan& plan) {
    Run run = plainRun(scene, plan);
    run.preset = Preset::thesis_accuracy;
    return run;
}

void addScene(SectionResult& result, const Published& thesis, const Plan& plan, const Results& results) {
    const ThesisScene& scene = thesisScene(thesis.scene);
    const Series fast = seriesOf(results, keyOf(plainRun(scene.name, plan)));
    const Series exact = seriesOf(results, keyOf(accurate(scene.name, plan)));
    const std::size_t steps = std::min(fast.steps(), exact.steps());
    const double speedup = sumOfFirst(exact.total_ms, steps) / sumOfFirst(fast.total_ms, steps);
    const double average = sum(exact.total_ms) / static_cast<double>(exact.steps());
    const BestStep best = bestStep(exact.total_ms, fast.total_ms, ratio_floor);
    const double iterations = sumOfFirst(exact.iterations, steps) / sumOfFirst(fast.iterations, steps);
    const std::string why = fmt::format(
        "{:.1f} times the iterations and four times the detections; an iteration takes a smaller part of the time here "
        "than "
        "in the thesis, and how often a pile must be gone through until the last contact is slow enough differs with "
        "the "
        "contacts it has.",
        iterations);
    const std::string id = fmt::format("5.5/{}", scene.name);
    const std::size_t first = result.entries.size();
    result.entries.push_back({id + "/speedup", rowText(scene, "performance against accuracy, speed-up"), "",
                              thesis.speedup, speedup,
                              fmt::format("the accuracy settings take {:.1f} times the iterations", iterations), why});
    result.entries.push_back({id + "/average", rowText(scene, "average simulation step, accuracy"), "ms",
                              thesis.average_ms, average, "", processorPart(scene, plan, thesis.average_ms / average)});
    result.entries.push_back({id + "/best_step", rowText(scene, "largest speed-up of a step"), "", thesis.best_step,
                              best.ratio, fmt::format("step {}", best.step), why});
    markShortened(result, first, accurate(scene.name, plan), plan);
    result.figures.push_back({id,
                              thesis.figure,
                              fmt::format("{}, accuracy and performance", scene.name),
                              "simulation step (1/30 s)",
                              "time per simulation step [ms]",
                              {{"accuracy, 960 steps/s", exact.total_ms}, {"performance, 240 steps/s", fast.total_ms}},
                              {{fmt::format("thesis, accuracy, average {} ms", thesis.average_ms), thesis.average_ms},
                               {fmt::format("thesis, performance, average {} ms", scene.average_ms), scene.average_ms}},
                              Scale::logarithmic});
    result.pictures.push_back(
        {"Figure 35", scene.name + ", accuracy settings", keyOf(accurate(scene.name, plan)), scene.camera});
    result.pictures.push_back(
        {scene.pictures, scene.name + ", performance settings", keyOf(plainRun(scene.name, plan)), scene.camera});
    result.checks.push_back({scene.name + ": accuracy costs more iterations", iterations > 1});
    result.checks.push_back({scene.name + ": no body is lost with the accuracy settings", exact.lost == 0});
}

}  // namespace
}  // namespace section_5

Section physicalAccuracy(const Plan& plan) {
    using namespace section_5;
    Section section{"5.5",
                    "Simulations with high physical accuracy",
                    "High accuracy settings: 960 time steps per second, unlimited iterations to 5.2 µm/s, no shock "
                    "propagation, no gravity damping.",
                    {},
                    {}};
    for (const Published& thesis : published) {
        section.experiments.push_back(experimentOf(plainRun(thesis.scene, plan), plan));
        section.experiments.push_back(experimentOf(accurate(thesis.scene, plan), plan));
    }
    section.evaluate = [plan](const Results& results) {
        SectionResult result;
        for (const Published& thesis : published) addScene(result, thesis, plan, results);
        return result;
    };
    return section;
}

}  // namespace cairn::thesis
