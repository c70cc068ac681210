#include "runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>

#include "machine.h"

namespace cairn::thesis {

namespace {

/// The thesis's machines. @source thesis §5
const ThesisMachine e6400{"Core 2 Duo E6400", 2, rating_e6400};
const ThesisMachine i7_940{"Core i7 940", 4, rating_i7_940};

/// In a quick run the costly ones end early: late enough to show the sign. [s]
double quickDuration(const Run& run) {
    if (run.scene == "cage2816") return 1.2;
    if (run.preset == Preset::thesis_accuracy) return run.scene == "cage384" ? 1.5 : 1.2;
    if (run.variant == Variant::greedy || run.variant == Variant::latest_first) return 1.5;
    if (run.scene == "stacks8" || run.scene == "well392") return 2;
    return 10;
}

/// Whether a run ends before the thesis's does.
bool isShortened(const Run& run, const Plan& plan) {
    return plan.extent == Extent::quick && quickDuration(run) < builtInScene(run.scene).duration;
}

double weightOf(const Run& run) {
    const double scene = thesisScene(run.scene).weight;
    if (run.preset == Preset::thesis_accuracy) return 25 * scene;
    if (run.variant == Variant::latest_first) return 5 * scene;
    if (run.variant == Variant::greedy) return 2 * scene;
    return scene;
}

const char* nameOf(Variant variant) {
    switch (variant) {
        case Variant::undamped:
            return "-undamped";
        case Variant::greedy:
            return "-greedy";
        case Variant::latest_first:
            return "-latest_first";
        case Variant::plain:
            break;
    }
    return "";
}

}  // namespace

const std::vector<ThesisScene>& thesisScenes() {
    static const std::vector<double> walls_camera = {-2.3, -3.7, 1.6, 0.9, 0, 0.2};
    static const std::vector<double> more_walls_camera = {-2.3, -4.7, 2, 1.5, 0, 0.2};
    static const std::vector<double> well_camera = {2.4, -3.4, 2.4, 0, 0, 0.65};
    static const std::vector<ThesisScene> scenes = {{.name = "stacks5",
                                                     .title = "five walls of 55 boxes, hit by an iron ball",
                                                     .machine = e6400,
                                                     .total_s = 2.993,
                                                     .average_ms = 16.63,
                                                     .figure = "Figure 28(a)",
                                                     .pictures = "Figure 27(a)",
                                                     .camera = walls_camera,
                                                     .weight = 1,
                                                     .moments = {0, 1.5, 6}},
                                                    {.name = "well324",
                                                     .title = "324 balls fall into a low well",
                                                     .machine = e6400,
                                                     .total_s = 2.693,
                                                     .average_ms = 14.96,
                                                     .figure = "Figure 28(b)",
                                                     .pictures = "Figure 27(b)",
                                                     .camera = well_camera,
                                                     .weight = 1.5,
                                                     .moments = {0, 0.9, 6}},
                                                    {.name = "cage384",
                                                     .title = "384 balls and boxes in a cage",
                                                     .machine = e6400,
                                                     .total_s = 4.226,
                                                     .average_ms = 17.61,
                                                     .figure = "Figure 28(c)",
                                                     .pictures = "Figure 27(c)",
                                                     .weight = 2,
                                                     .moments = {0, 1.3, 8}},
                                                    {.name = "stacks8",
                                                     .title = "eight walls of 55 boxes, hit by an iron ball",
                                                     .machine = i7_940,
                                                     .total_s = 3.477,
                                                     .average_ms = 19.32,
                                                     .figure = "Figure 30(a)",
                                                     .pictures = "Figure 29(a)",
                                                     .camera = more_walls_camera,
                                                     .weight = 2,
                                                     .moments = {0, 1.5, 6}},
                                                    {.name = "well392",
                                                     .title = "392 balls fall into a low well",
                                                     .machine = i7_940,
                                                     .total_s = 2.857,
                                                     .average_ms = 15.87,
                                                     .figure = "Figure 30(b)",
                                                     .pictures = "Figure 29(b)",
                                                     .camera = well_camera,
                                                     .weight = 2,
                                                     .moments = {0, 0.9, 6}},
                                                    {.name = "cage2816",
                                                     .title = "2816 balls and boxes in a cage",
                                                     .machine = i7_940,
                                                     .total_s = 356,
                                                     .average_ms = 1482,
                                                     .figure = "Figure 30(c)",
                                                     .pictures = "Figure 29(c)",
                                                     .weight = 60,
                                                     .moments = {0, 1.3, 8}}};
    return scenes;
}

const ThesisScene& thesisScene(const std::string& name) {
    for (const ThesisScene& scene : thesisScenes()) {
        if (scene.name == name) return scene;
    }
    throw std::logic_error(fmt::format("the thesis has no scene '{}'", name));
}

std::string keyOf(const Run& run) {
    return fmt::format("{}-{}{}-threads{}", run.scene,
                       run.preset == Preset::thesis_accuracy ? "accuracy" : "performance", nameOf(run.variant),
                       run.threads);
}

Experiment experimentOf(const Run& run, const Plan& plan) {
    Scene scene = builtInScene(run.scene);
    if (plan.extent == Extent::quick) scene = shortened(std::move(scene), quickDuration(run));
    SceneExperiment what{
        keyOf(run), std::move(scene), thesisSettings(run.preset, run.threads, run.variant), weightOf(run), {}};
    if (run.variant == Variant::plain && run.threads > 1) what.moments = thesisScene(run.scene).moments;
    return measureScene(std::move(what));
}

void markShortened(SectionResult& result, std::size_t first, const Run& run, const Plan& plan) {
    if (!isShortened(run, plan)) return;
    for (Entry& entry : std::span(result.entries).subspan(first)) entry.shortened = true;
}

std::int64_t threadsFor(const ThesisScene& scene, const Plan& plan) {
    return std::max<std::int64_t>(2, std::min<std::int64_t>(scene.machine.threads, plan.cores));
}

Run plainRun(const std::string& scene, const Plan& plan) {
    return {scene, Preset::thesis, Variant::plain, threadsFor(thesisScene(scene), plan)};
}

std::string processorPart(const ThesisScene& scene, const Plan& plan, double speedup) {
    if (!plan.processor_rating) return fmt::format("{:.1f} times as fast, on another processor.", speedup);
    const double factor = *plan.processor_rating / scene.machine.rating;
    return fmt::format("{:.1f} times as fast; a core of this processor makes about {:.1f} of it, the program {:.1f}.",
                       speedup, factor, speedup / factor);
}

std::string rowText(const ThesisScene& scene, const std::string& what) {
    return fmt::format("{}: {}", scene.name, what);
}

}  // namespace cairn::thesis
