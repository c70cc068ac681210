#include "scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cairn::bench {

namespace {

constexpr double pile_seconds = 10;
constexpr std::string_view pile = "pile:";
constexpr double still = 0.01;  ///< part of its largest kinetic energy below which a pile no longer falls

/// A scene with settings.
struct Configuration {
    std::string name;
    Scene scene;
    Settings settings;
    bool is_pile = false;
};

/// What is the same in every repetition.
struct Result {
    Statistics total;
    Statistics last;
    double largest_overlap = 0;       ///< [m]
    double sum_mean_overlap = 0;      ///< of the frames [m]
    std::uint64_t state_hash = 0;     ///< at the end
    std::size_t first_still = 0;      ///< first frame in which a pile no longer falls
    std::size_t steps_per_frame = 0;  ///< time steps of a simulation step
};

class Measurement {
  public:
    explicit Measurement(Configuration what) : what_(std::move(what)) {}

    const std::string& name() const { return what_.name; }

    void repeat(const std::function<void(double)>& progress) {
        SceneRun run(what_.scene, what_.settings);
        const auto frames = static_cast<std::size_t>(
            std::max(1.0, std::ceil(what_.scene.duration * simulation_steps_per_second - 1e-6)));
        Result result;
        result.steps_per_frame = static_cast<std::size_t>(run.stepsPerSimulationStep());
        std::vector<double> step_ms;
        std::vector<double> energies;
        std::vector<double> processor_ms;
        const double end = static_cast<double>(frames) - 1e-6;
        for (std::size_t i = 0; run.world().time() * simulation_steps_per_second < end; ++i) {
            progress(static_cast<double>(i) / static_cast<double>(frames));
            const Stopwatch stopwatch;
            const Statistics step = run.simulationStep();
            const Times times = stopwatch.read();
            step_ms.push_back(times.wall_ms);
            processor_ms.push_back(times.processor_ms);
            energies.push_back(run.world().kineticEnergy());
            result.total.add(step);
            result.last = step;
            result.largest_overlap = std::max(result.largest_overlap, step.largest_overlap);
            result.sum_mean_overlap += step.mean_overlap;
        }
        result.state_hash = run.world().stateHash();
        result.first_still = firstStill(energies);
        if (times_.empty()) result_ = result;
        times_.push_back(std::move(step_ms));
        processor_ms_.push_back(std::move(processor_ms));
    }

    Json json() const {
        const std::vector<double> step_ms = medians(times_);
        const std::vector<double> processor_ms = medians(processor_ms_);
        const auto frames = static_cast<double>(step_ms.size());
        Json stages = Json::object();
        for (std::size_t i = 0; i < stage_count; ++i) {
            stages[std::string(stage_names[i])] = result_.total.stage_ms[i] / frames;
        }
        const double steps = frames * static_cast<double>(result_.steps_per_frame);
        Json values = {{"average_ms", average(step_ms)},
                       {"worst_ms", largest(step_ms)},
                       {"processor_ms", average(processor_ms)},
                       {"contacts", static_cast<double>(result_.total.contacts) / steps},
                       {"iterations",
                        static_cast<double>(result_.total.global_iterations + result_.total.shock_iterations) / steps},
                       {"largest_overlap_mm", 1e3 * result_.largest_overlap},
                       {"mean_overlap_mm", 1e3 * result_.sum_mean_overlap / frames},
                       {"resting_largest_overlap_mm", 1e3 * result_.last.largest_overlap},
                       {"asleep", result_.last.asleep}};
        if (what_.is_pile) addPile(processor_ms, values);
        return {{"name", what_.name},
                {"bodies", what_.scene.bodies.size()},
                {"threads", what_.settings.parallel.threads},
                {"values", values},
                {"stages_ms", stages},
                {"state_hash", fmt::format("{:016x}", result_.state_hash)},
                {"step_ms", step_ms}};
    }

  private:
    /// The first frame after the one with the largest kinetic energy in which hardly any of it is left.
    static std::size_t firstStill(const std::vector<double>& energies) {
        const auto most = std::max_element(energies.begin(), energies.end());
        const auto found = std::find_if(most, energies.end(), [&](double energy) { return energy < still * *most; });
        return static_cast<std::size_t>(found - energies.begin());
    }

    /// Processor times, since one disturbance would upset the ratio.
    void addPile(const std::vector<double>& step_ms, Json& values) const {
        const std::size_t second = std::min<std::size_t>(step_ms.size(), 30);
        const auto falling_end = step_ms.begin() + static_cast<std::ptrdiff_t>(result_.first_still);
        const double falling = average({step_ms.begin(), falling_end});
        const double settled = average({step_ms.end() - static_cast<std::ptrdiff_t>(second), step_ms.end()});
        values["falling_seconds"] = static_cast<double>(result_.first_still) / simulation_steps_per_second;
        values["falling_ms"] = falling;
        values["settled_ms"] = settled;
        values["settled_to_falling"] = settled / falling;
    }

    Configuration what_;
    std::vector<std::vector<double>> times_;         ///< [repetition × simulation step, ms]
    std::vector<std::vector<double>> processor_ms_;  ///< the same in processor time
    Result result_;                                  ///< of the first repetition
};

bool isPile(const std::string& scene) {
    return scene.starts_with(pile);
}

Configuration configure(const std::string& name, const Variant& variant, std::int64_t threads,
                        const ScenesOptions& options) {
    Configuration made;
    made.is_pile = isPile(name);
    made.scene = made.is_pile ? builtInScene("heap:" + name.substr(pile.size())) : benchScene(name);
    if (made.is_pile) made.scene.duration = pile_seconds;
    const double longest = options.extent == Extent::quick ? std::min(options.longest, quick_seconds) : options.longest;
    made.scene = shortened(std::move(made.scene), longest);
    SettingOverrides all = combined(options.overrides, variant);
    all.fields.emplace_back("threads", fmt::format("{}", threads));
    if (made.is_pile) all.fields.emplace_back("sleeping", "false");
    made.settings = settingsFor(made.scene, all);
    made.name = name + (variant.name.empty() ? "" : '/' + variant.name) + fmt::format("/threads{}", threads);
    return made;
}

std::vector<Measurement> allMeasurements(const std::string& scene, const ScenesOptions& options) {
    std::vector<Variant> variants{{}};
    variants.insert(variants.end(), options.variants.begin(), options.variants.end());
    std::vector<Measurement> all;
    for (const Variant& variant : variants) {
        for (const std::int64_t threads : options.threads) {
            all.emplace_back(configure(scene, variant, threads, options));
        }
    }
    return all;
}

std::string tableOf(const Json& entries) {
    std::string text =
        fmt::format("{:<37} {:>6} {:>9} {:>9} {:>9}  {:>9} {:>9} {:>9}  {:>8} {:>9}  {:>8} {:>7} {:>8} {:>6}\n", "", "",
                    "average", "worst", "processor", "detection", "correct.", "resolut.", "contacts", "iterat.",
                    "largest", "mean", "at rest", "");
    text += fmt::format("{:<37} {:>6} {:>9} {:>9} {:>9}  {:>9} {:>9} {:>9}  {:>8} {:>9}  {:>8} {:>7} {:>8} {:>6}\n",
                        "scene", "bodies", "ms", "ms", "ms", "ms", "ms", "ms", "a step", "a step", "mm", "mm", "mm",
                        "asleep");
    for (const Json& entry : entries) {
        const auto value = [&](const char* name) { return entry.at("values").at(name).get<double>(); };
        const auto stage = [&](const char* name) { return entry.at("stages_ms").at(name).get<double>(); };
        text += fmt::format(
            "{:<37} {:>6} {:>9.3f} {:>9.3f} {:>9.3f}  {:>9.3f} {:>9.3f} {:>9.3f}  {:>8.0f} {:>9.0f}  {:>8.3f} {:>7.3f} "
            "{:>8.3f} "
            "{:>6.0f}\n",
            entry.at("name").get<std::string>(), entry.at("bodies").get<std::size_t>(), value("average_ms"),
            value("worst_ms"), value("processor_ms"), stage("detection"), stage("correction"), stage("resolution"),
            value("contacts"), value("iterations"), value("largest_overlap_mm"), value("mean_overlap_mm"),
            value("resting_largest_overlap_mm"), value("asleep"));
        if (!entry.at("values").contains("settled_ms")) continue;
        text += fmt::format("{:<37} falling {:.3f} ms in the first {:.2f} s, settled {:.3f} ms: {:.1f} %\n", "",
                            value("falling_ms"), value("falling_seconds"), value("settled_ms"),
                            100 * value("settled_to_falling"));
    }
    return text;
}

}  // namespace

const std::vector<std::string>& benchScenes() {
    static const std::vector<std::string> names = {"stacks5",   "well324",   "cage384",  "stacks8",
                                                   "well392",   "cage2816",  "tower:20", "wall:30",
                                                   "heap:2000", "heap:8000", "pile:2000"};
    return names;
}

Outcome runScenes(const ScenesOptions& options) {
    const std::vector<std::string>& scenes = options.scenes.empty() ? benchScenes() : options.scenes;
    const std::size_t repetitions = options.extent == Extent::quick ? 1 : options.repetitions;
    for (const std::string& scene : scenes) allMeasurements(scene, options);  // refused before hours of work

    Json entries = Json::array();
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        std::vector<Measurement> all = allMeasurements(scenes[i], options);
        const auto runs = static_cast<double>(repetitions * all.size());
        for (std::size_t repetition = 0; repetition < repetitions; ++repetition) {
            for (std::size_t k = 0; k < all.size(); ++k) {
                const auto done = static_cast<double>(repetition * all.size() + k);
                all[k].repeat([&](double part) {
                    options.progress(
                        (static_cast<double>(i) + (done + part) / runs) / static_cast<double>(scenes.size()),
                        fmt::format("{} ({} of {})", all[k].name(), repetition + 1, repetitions));
                });
            }
        }
        for (const Measurement& measurement : all) entries.push_back(measurement.json());
    }
    Outcome outcome;
    outcome.table = fmt::format("medians of {} runs; ms per simulation step of 1/30 s\n", repetitions);
    if (std::ranges::any_of(scenes, isPile)) {
        outcome.table += "pile: sleeping off\n";
    }
    outcome.table += '\n' + tableOf(entries);
    outcome.json = originOf("scenes", options.extent);
    outcome.json["repetitions"] = repetitions;
    outcome.json["entries"] = std::move(entries);
    return outcome;
}

}  // namespace cairn::bench
