/// @file §5.4: highest closing speed against arbitrary order, Table 6.
#include <fmt/format.h>

#include <array>

#include "runs.h"

namespace cairn::thesis {

namespace section_4 {
namespace {

constexpr double ratio_floor = 0.05;
constexpr double fewer_goal = 80;  ///< [%]
constexpr double speedup_goal = 2.5;
/// "Far fewer" iterations: on every machine and also in shortened scenes at most this part.
constexpr double far_fewer = 0.5;

struct Published {
    const char* scene;
    const char* figure_iterations;
    const char* figure_time;
    double fewer;  ///< [%]
    double speedup;
    double most_iterations;  ///< in a simulation step, highest closing speed
    double best_iterations;  ///< largest ratio of a step
    double best_time;
    double most_ms;
};
constexpr std::array<Published, 2> published = {
    {{"stacks5", "Figure 33(a)", "Figure 34(a)", 85.8, 3.72, 217313, 267, 13.1, 159.6},
     {"well324", "Figure 33(b)", "Figure 34(b)", 84.5, 3.08, 172764, 25.9, 13.3, 113.0}}};

Run ordered(const std::string& scene, const Plan& plan, Variant variant) {
    Run run = plainRun(scene, plan);
    run.variant = variant;
    return run;
}

void addFigures(SectionResult& result, const Published& thesis, const Series& greedy, const Series& latest) {
    const std::string id = fmt::format("5.4/{}", thesis.scene);
    result.figures.push_back({id + "/iterations",
                              thesis.figure_iterations,
                              fmt::format("{}, iterations", thesis.scene),
                              "simulation step (1/30 s)",
                              "iterations per simulation step",
                              {{"highest closing speed", greedy.iterations}, {"latest to close", latest.iterations}},
                              {{fmt::format("thesis, most with highest closing speed {:.0f}", thesis.most_iterations),
                                thesis.most_iterations}},
                              Scale::logarithmic});
    result.figures.push_back(
        {id + "/time",
         thesis.figure_time,
         fmt::format("{}, time", thesis.scene),
         "simulation step (1/30 s)",
         "time per simulation step [ms]",
         {{"highest closing speed", greedy.total_ms}, {"latest to close", latest.total_ms}},
         {{fmt::format("thesis, longest step with highest closing speed {} ms", thesis.most_ms), thesis.most_ms}},
         Scale::logarithmic});
}

void addScene(SectionResult& result, const Published& thesis, const Plan& plan, const Results& results) {
    const ThesisScene& scene = thesisScene(thesis.scene);
    const Series greedy = seriesOf(results, keyOf(ordered(scene.name, plan, Variant::greedy)));
    const Series latest = seriesOf(results, keyOf(ordered(scene.name, plan, Variant::latest_first)));
    const double part = sum(greedy.iterations) / sum(latest.iterations);
    const double fewer = 100 * (1 - part);
    const double speedup = latest.total_s / greedy.total_s;
    const BestStep iterations = bestStep(latest.iterations, greedy.iterations, ratio_floor);
    const BestStep time = bestStep(latest.total_ms, greedy.total_ms, ratio_floor);
    const std::string id = fmt::format("5.4/{}", scene.name);
    const std::size_t first = result.entries.size();
    result.entries.push_back(
        {id + "/fewer_iterations", rowText(scene, "fewer iterations"), "%", thesis.fewer, fewer,
         fmt::format("{:.0f} against {:.0f} in the whole run", sum(greedy.iterations), sum(latest.iterations))});
    result.entries.push_back({id + "/speedup", rowText(scene, "speed-up"), "", thesis.speedup, speedup, ""});
    result.entries.push_back({id + "/most_iterations", rowText(scene, "most iterations in a simulation step"), "",
                              thesis.most_iterations, largest(greedy.iterations), "highest closing speed"});
    result.entries.push_back({id + "/best_step_iterations", rowText(scene, "best step, ratio of iterations"), "",
                              thesis.best_iterations, iterations.ratio, fmt::format("step {}", iterations.step)});
    result.entries.push_back({id + "/best_step_time", rowText(scene, "best step, speed-up"), "", thesis.best_time,
                              time.ratio, fmt::format("step {}", time.step)});
    markShortened(result, first, ordered(scene.name, plan, Variant::greedy), plan);
    addFigures(result, thesis, greedy, latest);
    result.checks.push_back(
        {scene.name + ": the highest closing speed needs at most half the iterations", part <= far_fewer});
    if (plan.extent == Extent::full) {
        result.goals.push_back(
            {fmt::format("{}: at least {:.0f} % fewer iterations with the highest closing speed; it is "
                         "{:.1f} %",
                         scene.name, fewer_goal, fewer),
             fewer >= fewer_goal});
        result.goals.push_back({fmt::format("{}: the highest closing speed is faster by at least {}; it is {:.2f}",
                                            scene.name, speedup_goal, speedup),
                                speedup >= speedup_goal});
    }
}

}  // namespace
}  // namespace section_4

Section processingOrder(const Plan& plan) {
    using namespace section_4;
    Section section{
        "5.4",
        "Contact processing order",
        "Always the contact with the highest closing speed, against the one that began to close last; unlimited "
        "iterations and no shock propagation, so that every contact ends below 83.4 µm/s. The thesis says \"any "
        "arbitrary closing contact\"; which one matters: against the first of its unsorted array it is 86 % fewer "
        "iterations in stacks5 and 73 % in well324, against the last of that array 88 and 77 %, against the one with "
        "the lowest number 79 and 73 %, and against the one that began to close first 49 and 4 %.",
        {},
        {}};
    for (const Published& thesis : published) {
        for (const Variant variant : {Variant::greedy, Variant::latest_first}) {
            section.experiments.push_back(experimentOf(ordered(thesis.scene, plan, variant), plan));
        }
    }
    section.evaluate = [plan](const Results& results) {
        SectionResult result;
        for (const Published& thesis : published) addScene(result, thesis, plan, results);
        return result;
    };
    return section;
}

}  // namespace cairn::thesis
