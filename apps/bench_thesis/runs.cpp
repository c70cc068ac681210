#include "runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "machine.h"

namespace cairn::thesis {

namespace {

/// In a quick run the costly ones end early: late enough to show the sign. [s]
double quickDuration(const Run& run) {
    if (run.scene == "cage2816") return 1.2;
    if (run.preset == Preset::accuracy) return run.scene == "cage384" ? 1.5 : 1.2;
    if (run.variant == Variant::greedy || run.variant == Variant::first_entry) return 1.5;
    if (run.scene == "stacks8" || run.scene == "well392") return 2;
    return 10;
}

double weightOf(const Run& run) {
    const double scene = thesisScene(run.scene).weight;
    if (run.preset == Preset::accuracy) return 25 * scene;
    if (run.variant == Variant::first_entry) return 5 * scene;
    if (run.variant == Variant::greedy) return 2 * scene;
    return scene;
}

const char* nameOf(Variant variant) {
    switch (variant) {
        case Variant::undamped:
            return "-undamped";
        case Variant::greedy:
            return "-greedy";
        case Variant::first_entry:
            return "-first_entry";
        case Variant::plain:
            break;
    }
    return "";
}

}  // namespace

const std::vector<ThesisScene>& thesisScenes() {
    static const std::vector<ThesisScene> scenes = {{"stacks5",
                                                     "five walls of 55 boxes, hit by an iron ball",
                                                     "Core 2 Duo E6400",
                                                     2,
                                                     2.993,
                                                     16.63,
                                                     "Figure 28(a)",
                                                     "Figure 27(a)",
                                                     rating_e6400,
                                                     1,
                                                     {0, 1.5, 6}},
                                                    {"well324",
                                                     "324 balls fall into a low well",
                                                     "Core 2 Duo E6400",
                                                     2,
                                                     2.693,
                                                     14.96,
                                                     "Figure 28(b)",
                                                     "Figure 27(b)",
                                                     rating_e6400,
                                                     1.5,
                                                     {0, 0.9, 6}},
                                                    {"cage384",
                                                     "384 balls and boxes in a cage",
                                                     "Core 2 Duo E6400",
                                                     2,
                                                     4.226,
                                                     17.61,
                                                     "Figure 28(c)",
                                                     "Figure 27(c)",
                                                     rating_e6400,
                                                     2,
                                                     {0, 1.3, 8}},
                                                    {"stacks8",
                                                     "eight walls of 55 boxes, hit by an iron ball",
                                                     "Core i7 940",
                                                     4,
                                                     3.477,
                                                     19.32,
                                                     "Figure 30(a)",
                                                     "Figure 29(a)",
                                                     rating_i7_940,
                                                     2,
                                                     {0, 1.5, 6}},
                                                    {"well392",
                                                     "392 balls fall into a low well",
                                                     "Core i7 940",
                                                     4,
                                                     2.857,
                                                     15.87,
                                                     "Figure 30(b)",
                                                     "Figure 29(b)",
                                                     rating_i7_940,
                                                     2,
                                                     {0, 0.9, 6}},
                                                    {"cage2816",
                                                     "2816 balls and boxes in a cage",
                                                     "Core i7 940",
                                                     4,
                                                     356,
                                                     1482,
                                                     "Figure 30(c)",
                                                     "Figure 29(c)",
                                                     rating_i7_940,
                                                     60,
                                                     {0, 1.3, 8}}};
    return scenes;
}

const ThesisScene& thesisScene(const std::string& name) {
    for (const ThesisScene& scene : thesisScenes()) {
        if (scene.name == name) return scene;
    }
    throw std::logic_error(fmt::format("the thesis has no scene '{}'", name));
}

std::string keyOf(const Run& run) {
    return fmt::format("{}-{}{}-threads{}", run.scene, run.preset == Preset::accuracy ? "accuracy" : "performance",
                       nameOf(run.variant), run.threads);
}

Experiment experimentOf(const Run& run, const Plan& plan) {
    Scene scene = builtInScene(run.scene);
    if (plan.extent == Extent::quick) scene = shortened(std::move(scene), quickDuration(run));
    SceneExperiment what{
        keyOf(run), std::move(scene), thesisSettings(run.preset, run.threads, run.variant), weightOf(run), {}};
    if (run.variant == Variant::plain && run.threads > 1) what.moments = thesisScene(run.scene).moments;
    return measureScene(std::move(what));
}

std::int64_t threadsFor(const ThesisScene& scene, const Plan& plan) {
    return std::max<std::int64_t>(2, std::min<std::int64_t>(scene.threads, plan.cores));
}

Run plainRun(const std::string& scene, const Plan& plan) {
    return {scene, Preset::performance, Variant::plain, threadsFor(thesisScene(scene), plan)};
}

std::string rowText(const ThesisScene& scene, const std::string& what) {
    return fmt::format("{}: {}", scene.name, what);
}

}  // namespace cairn::thesis
