/// @file §5.3: gravity damping off and on, Table 5.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "runs.h"

namespace cairn::thesis {

namespace section_3 {
namespace {

constexpr double ratio_floor = 0.2;
constexpr double scene_goal = 1.2;
constexpr double mean_goal = 1.6;

struct Published {
    const char* scene;
    const char* figure;
    double speedup;
    double best_step;
};
constexpr std::array<Published, 3> published = {{{"stacks5", "Figure 32(a)", 1.99, 4.71},
                                                 {"well324", "Figure 32(b)", 1.78, 5.23},
                                                 {"cage384", "Figure 32(c)", 1.53, 3.47}}};

Run undamped(const std::string& scene, const Plan& plan) {
    Run run = plainRun(scene, plan);
    run.variant = Variant::undamped;
    return run;
}

/// The step from which on at least `bodies` are asleep after the liveliest moment; none if that never comes.
std::optional<double> asleepSince(const Series& series, double bodies) {
    const auto& asleep = series.asleep;
    const auto liveliest = std::min_element(asleep.rbegin(), asleep.rend()).base() - asleep.begin() - 1;
    for (auto i = static_cast<std::size_t>(liveliest); i < asleep.size(); ++i) {
        if (asleep[i] >= bodies) return static_cast<double>(i + 1);
    }
    return {};
}

double geometricMean(const std::vector<double>& values) {
    double logarithms = 0;
    for (const double value : values) logarithms += std::log(value);
    return std::exp(logarithms / static_cast<double>(values.size()));
}

void addSleep(SectionResult& result, const ThesisScene& scene, const Series& with, const Series& without) {
    // Some bodies never rest, such as balls that roll away: what counts is when most of those that do are asleep.
    const double most = std::floor(0.9 * with.asleep.back());
    const auto [a, b] = std::pair(asleepSince(with, most), asleepSince(without, most));
    const std::string id = fmt::format("5.3/{}", scene.name);
    const std::string note = fmt::format("{:.0f} bodies, nine tenths of those asleep at the end with damping", most);
    result.entries.push_back({id + "/asleep", rowText(scene, "step at which most rest, damped"), "", {}, a, note});
    result.entries.push_back({id + "/asleep_undamped",
                              rowText(scene, "the same without damping"),
                              "",
                              {},
                              b,
                              b ? "" : "not within the run"});
    result.figures.push_back({id + "/asleep",
                              "",
                              fmt::format("{}, bodies asleep", scene.name),
                              "simulation step (1/30 s)",
                              "bodies asleep",
                              {{"damping 70 %", with.asleep}, {"no damping", without.asleep}}});
    result.checks.push_back({scene.name + ": bodies fall asleep earlier with damping", a && (!b || *a < *b)});
}

/// @param fewer iterations [%]
std::string explain(double fewer, double speedup, double thesis_speedup) {
    if (speedup > thesis_speedup) {
        return fmt::format("Damping saves {:.0f} % of the iterations, and bodies that sleep cost less here.", fewer);
    }
    return fmt::format(
        "Damping saves {:.0f} % of the iterations, but an iteration costs little here beside finding and "
        "preparing the contacts, which damping does not spare; so the time follows less.",
        fewer);
}

/// Without damping over with it.
struct Ratios {
    double time;
    double iterations;
};

Ratios addScene(SectionResult& result, const Published& thesis, const Plan& plan, const Results& results) {
    const ThesisScene& scene = thesisScene(thesis.scene);
    const Series with = seriesOf(results, keyOf(plainRun(scene.name, plan)));
    const Series without = seriesOf(results, keyOf(undamped(scene.name, plan)));
    const BestStep best = bestStep(without.total_ms, with.total_ms, ratio_floor);
    const double speedup = without.total_s / with.total_s;
    const double fewer = 100 * (1 - sum(with.iterations) / sum(without.iterations));
    const std::string why = explain(fewer, speedup, thesis.speedup);
    const std::string id = fmt::format("5.3/{}", scene.name);
    const std::size_t first = result.entries.size();
    result.entries.push_back({id + "/speedup", rowText(scene, "speed-up by damping"), "", thesis.speedup, speedup,
                              fmt::format("{:.0f} % fewer iterations", fewer), why});
    result.entries.push_back({id + "/best_step", rowText(scene, "best step, speed-up"), "", thesis.best_step,
                              best.ratio, fmt::format("step {}", best.step), why});
    result.figures.push_back(
        {id,
         thesis.figure,
         fmt::format("{}, with and without gravity damping", scene.name),
         "simulation step (1/30 s)",
         "time per simulation step [ms]",
         {{"damping 70 %", with.total_ms}, {"no damping", without.total_ms}},
         {{fmt::format("thesis, average {} ms with damping", scene.average_ms), scene.average_ms}}});
    addSleep(result, scene, with, without);
    markShortened(result, first, undamped(scene.name, plan), plan);
    result.checks.push_back({scene.name + ": damping saves iterations", fewer > 0});
    if (plan.extent == Extent::full) {
        result.goals.push_back(
            {fmt::format("{}: damping speeds up by at least {}; it is {:.2f}", scene.name, scene_goal, speedup),
             speedup >= scene_goal});
    }
    return {speedup, sum(without.iterations) / sum(with.iterations)};
}

}  // namespace
}  // namespace section_3

Section gravityDamping(const Plan& plan) {
    using namespace section_3;
    Section section{"5.3",
                    "Velocity-dependent gravity damping",
                    "The three scenes with the damping of 70 % below 8.33 cm/s and without it, all else equal.",
                    {},
                    {}};
    for (const Published& thesis : published) {
        section.experiments.push_back(experimentOf(plainRun(thesis.scene, plan), plan));
        section.experiments.push_back(experimentOf(undamped(thesis.scene, plan), plan));
    }
    section.evaluate = [plan](const Results& results) {
        SectionResult result;
        std::vector<double> ours;
        std::vector<double> iterations;
        std::vector<double> theirs;
        for (const Published& thesis : published) {
            const Ratios ratios = addScene(result, thesis, plan, results);
            ours.push_back(ratios.time);
            iterations.push_back(ratios.iterations);
            theirs.push_back(thesis.speedup);
        }
        const double mean = geometricMean(ours);
        result.entries.push_back({"5.3/mean/speedup", "geometric mean of the three speed-ups", "",
                                  geometricMean(theirs), mean,
                                  fmt::format("of the iterations alone it is {:.2f}", geometricMean(iterations)),
                                  "The iterations follow the thesis, the times less; see the scenes."});
        if (plan.extent == Extent::full) {
            result.goals.push_back(
                {fmt::format("geometric mean of the speed-ups by damping at least {}; it is {:.2f}", mean_goal, mean),
                 mean >= mean_goal});
        }
        return result;
    };
    return section;
}

}  // namespace cairn::thesis
