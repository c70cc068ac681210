/// @file §5.2: one thread against several, Table 4.
#include <fmt/format.h>

#include <array>
#include <limits>

#include "runs.h"

namespace cairn::thesis {

namespace section_2 {
namespace {

/// Steps that take less than this part of the longest one are left out of ratios.
constexpr double ratio_floor = 0.2;
constexpr double response_goal = 1.85;

struct Published {
    const char* scene;
    const char* figure;
    double time_saved;  ///< [%]
    double best_step;
    double best_response;
};
constexpr std::array<Published, 3> published = {{{"stacks5", "Figure 31(a)", 18, 1.65, 1.92},
                                                 {"cage384", "Figure 31(b)", 23, 1.62, 1.89},
                                                 {"stacks8", "Figure 31(c)", 32, 2.18, 3.77}}};

std::vector<double> ratios(const std::vector<double>& first, const std::vector<double>& second) {
    std::vector<double> result(first.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < first.size(); ++i) {
        if (first[i] >= ratio_floor * largest(first) && second[i] > 0) result[i] = first[i] / second[i];
    }
    return result;
}

/// Part of the contacts that is in the largest batch of its time step [%]: more threads cannot share it.
std::vector<double> inLargestBatch(const Series& series) {
    std::vector<double> result(series.steps(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (series.contacts[i] > 0) result[i] = 100 * series.largest_batch[i] / series.contacts[i];
    }
    return result;
}

/// Why what several threads give is not what they gave in the thesis.
std::string explain(const ThesisScene& scene, const Series& one, const Series& several, double ours, double theirs) {
    if (several.threads < scene.machine.threads) {
        return fmt::format("The thesis had {} threads; this machine has {:.0f} cores.", scene.machine.threads,
                           several.threads);
    }
    if (ours > theirs) return "Contact detection, which had one thread in the thesis, uses all of them here.";
    constexpr double time_steps = 8;  // of a simulation step, with the performance settings
    const double average = 1000 * one.total_s / static_cast<double>(one.steps());
    return fmt::format(
        "A time step takes one thread {:.2f} ms here, and took {:.1f} ms with all of them in the thesis: "
        "calling the others and waiting for the last of them weighs more.",
        average / time_steps, scene.average_ms / time_steps);
}

void addScene(SectionResult& result, const Published& thesis, const Plan& plan, const Results& results) {
    const ThesisScene& scene = thesisScene(thesis.scene);
    Run single = plainRun(scene.name, plan);
    single.threads = 1;
    const Series one = seriesOf(results, keyOf(single));
    const Series several = seriesOf(results, keyOf(plainRun(scene.name, plan)));
    const BestStep step = bestStep(one.total_ms, several.total_ms, ratio_floor);
    const BestStep response = bestStep(one.response_ms, several.response_ms, ratio_floor);
    const double share = 100 * sum(one.largest_batch) / sum(one.contacts);
    const std::string id = fmt::format("5.2/{}", scene.name);
    const std::size_t first = result.entries.size();
    const std::string threads = fmt::format("thesis: {} threads; ours: {:.0f}", scene.machine.threads, several.threads);
    const double saved = 100 * (1 - several.total_s / one.total_s);
    const auto why = [&](double ours, double theirs) { return explain(scene, one, several, ours, theirs); };
    result.entries.push_back({id + "/time_saved", rowText(scene, "time saved"), "%", thesis.time_saved, saved, threads,
                              why(saved, thesis.time_saved)});
    result.entries.push_back({id + "/best_step", rowText(scene, "best step, speed-up"), "", thesis.best_step,
                              step.ratio, fmt::format("step {}", step.step), why(step.ratio, thesis.best_step)});
    result.entries.push_back({id + "/best_response", rowText(scene, "response alone, best step"), "",
                              thesis.best_response, response.ratio, fmt::format("step {}", response.step),
                              why(response.ratio, thesis.best_response)});
    result.entries.push_back({id + "/largest_batch",
                              rowText(scene, "contacts that are in the largest batch"),
                              "%",
                              {},
                              share,
                              "one batch is one thread's work"});
    markShortened(result, first, plainRun(scene.name, plan), plan);
    result.figures.push_back(
        {id,
         thesis.figure,
         fmt::format("{}, {:.0f} threads against one", scene.name, several.threads),
         "simulation step (1/30 s)",
         "speed-up",
         {{"response alone", ratios(one.response_ms, several.response_ms)},
          {"whole step", ratios(one.total_ms, several.total_ms)}},
         {{fmt::format("thesis, response, best step {}", thesis.best_response), thesis.best_response},
          {fmt::format("thesis, whole, best step {}", thesis.best_step), thesis.best_step},
          {"one thread", 1}}});
    result.figures.push_back({id + "/batches",
                              "",
                              fmt::format("{}, why: one batch belongs to one thread", scene.name),
                              "simulation step (1/30 s)",
                              "contacts in the largest batch [%]",
                              {{"part of the contacts that is in the largest batch", inLargestBatch(one)}}});
    result.checks.push_back({fmt::format("{}: the last state is the same bit for bit with 1 and {:.0f} threads",
                                         scene.name, several.threads),
                             one.state_hash == several.state_hash});
    if (plan.extent == Extent::full && scene.machine.threads == 2) {
        result.goals.push_back(
            {fmt::format("{}: response alone on 2 threads at least {} in the best step; it is {:.2f}", scene.name,
                         response_goal, response.ratio),
             response.ratio >= response_goal});
    }
}

}  // namespace
}  // namespace section_2

Section parallelEfficiency(const Plan& plan) {
    using namespace section_2;
    Section section{"5.2",
                    "Parallelization efficiency",
                    "The same scenes with one thread and with several. A group of touching bodies is one batch and one "
                    "thread's work; speed-ups are shown for the steps that take at least a fifth of the longest one.",
                    {},
                    {}};
    for (const Published& thesis : published) {
        Run run = plainRun(thesis.scene, plan);
        section.experiments.push_back(experimentOf(run, plan));
        run.threads = 1;
        section.experiments.push_back(experimentOf(run, plan));
    }
    section.evaluate = [plan](const Results& results) {
        SectionResult result;
        for (const Published& thesis : published) addScene(result, thesis, plan, results);
        return result;
    };
    return section;
}

}  // namespace cairn::thesis
