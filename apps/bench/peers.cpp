#include "peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "quality.h"

namespace cairn::bench {

namespace {

/// One engine in one scene.
struct Entry {
    std::string scene;
    std::string engine;
    std::vector<double> step_ms;  ///< per simulation step, median of the repetitions
    double processor_ms = 0;      ///< of a simulation step on average, median of the repetitions
    Quality quality;
    std::size_t asleep = 0;  ///< at the end
};

int stepsPerFrame(double steps_per_second) {
    const double steps = steps_per_second / simulation_steps_per_second;
    if (!(steps >= 1) || steps != std::round(steps) || steps_per_second > 1e6) {
        throw InputError(
            fmt::format("--steps-per-second is {}; it must be a multiple of 30, from 30 to 1e6", steps_per_second));
    }
    return static_cast<int>(steps);
}

/// Wall times and poses of a run.
struct Run {
    std::vector<double> step_ms;
    double processor_ms = 0;  ///< of all simulation steps
    Trajectory trajectory;    ///< empty unless asked for
    std::size_t asleep = 0;
};

enum class Poses { skip, keep };

/// Runs one engine through a scene.
class Runner {
  public:
    Runner(const Scene& scene, const PeersOptions& options)
        : scene_(scene),
          rigid_(scene),
          frames_(
              static_cast<std::size_t>(std::max(1.0, std::ceil(scene.duration * simulation_steps_per_second - 1e-6)))),
          steps_(stepsPerFrame(options.steps_per_second)),
          options_{options.steps_per_second, options.sleeping} {}

    std::size_t frames() const { return frames_; }
    const RigidScene& rigid() const { return rigid_; }

    /// @param progress called with the part of the run that is done
    Run run(const EngineKind& kind, Poses poses, const std::function<void(double)>& progress) const {
        const std::unique_ptr<Engine> engine = kind.make(scene_, rigid_, options_);
        Run result;
        for (std::size_t i = 0; i < frames_; ++i) {
            progress(static_cast<double>(i) / static_cast<double>(frames_));
            const Stopwatch stopwatch;
            for (int k = 0; k < steps_; ++k) engine->step();
            const Times times = stopwatch.read();
            result.step_ms.push_back(times.wall_ms);
            result.processor_ms += times.processor_ms;
            if (poses == Poses::keep) engine->poses(result.trajectory.emplace_back());
        }
        result.asleep = engine->asleep();
        return result;
    }

    double timeStep() const { return 1 / options_.steps_per_second; }

  private:
    const Scene& scene_;
    RigidScene rigid_;
    std::size_t frames_;
    int steps_;
    EngineOptions options_;
};

Scene preparedScene(const std::string& name, const PeersOptions& options) {
    const double longest = options.extent == Extent::quick ? std::min(options.longest, quick_seconds) : options.longest;
    Scene scene = shortened(benchScene(name), longest);
    for (SceneBody& body : scene.bodies) body.asleep = false;
    return scene;
}

/// All engines in one scene: run after run in turns, so that a disturbance does not hit one of them alone.
std::vector<Entry> compare(const std::string& name, const std::vector<EngineKind>& engines, const PeersOptions& options,
                           const std::function<void(double, const std::string&)>& progress) {
    const Scene scene = preparedScene(name, options);
    const Runner runner(scene, options);
    const std::size_t repetitions = options.extent == Extent::quick ? 1 : options.repetitions;
    std::vector<Entry> entries(engines.size());
    std::vector<std::vector<std::vector<double>>> times(engines.size());
    std::vector<std::vector<double>> processor_ms(engines.size());
    const auto all = static_cast<double>(repetitions * engines.size());
    for (std::size_t repetition = 0; repetition < repetitions; ++repetition) {
        for (std::size_t i = 0; i < engines.size(); ++i) {
            const auto done = static_cast<double>(repetition * engines.size() + i);
            const std::string what =
                fmt::format("{} {} ({} of {})", name, engines[i].name, repetition + 1, repetitions);
            const Run run = runner.run(engines[i], repetition == 0 ? Poses::keep : Poses::skip,
                                       [&](double part) { progress((done + part) / all, what); });
            times[i].push_back(run.step_ms);
            processor_ms[i].push_back(run.processor_ms / static_cast<double>(runner.frames()));
            if (repetition > 0) continue;
            entries[i].scene = name;
            entries[i].engine = engines[i].name;
            entries[i].quality = measureQuality(scene, runner.rigid(), run.trajectory, runner.timeStep());
            entries[i].asleep = run.asleep;
        }
    }
    for (std::size_t i = 0; i < engines.size(); ++i) {
        entries[i].step_ms = medians(times[i]);
        entries[i].processor_ms = median(processor_ms[i]);
    }
    return entries;
}

void addCairn(const Variant& variant, const PeersOptions& options, std::vector<EngineKind>& engines) {
    engines.push_back(cairnEngine(variant.name, combined(options.overrides, variant), options.threads));
    if (!options.sleeping) engines.back().settings += ", sleeping off";
}

std::vector<EngineKind> chosenEngines(const PeersOptions& options) {
    std::vector<std::string> names = options.engines;
    if (names.empty()) names = {"cairn", "bullet", "ode"};
    std::vector<EngineKind> engines;
    for (const std::string& name : names) {
        if (name == "cairn") {
            addCairn({name, {}}, options, engines);
            for (const Variant& variant : options.variants) addCairn(variant, options, engines);
        } else if (name == "bullet") {
            engines.push_back(bulletEngine());
        } else if (name == "ode") {
            engines.push_back(odeEngine());
        } else {
            throw InputError(fmt::format("--engines is given '{}'; the engines are cairn, bullet and ode", name));
        }
    }
    for (std::size_t i = 0; i < engines.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (engines[i].name == engines[k].name) {
                throw InputError(fmt::format("two engines are called '{}'; give each another name", engines[i].name));
            }
        }
    }
    return engines;
}

Json valuesOf(const Entry& entry) {
    const Quality& q = entry.quality;
    return {{"average_ms", average(entry.step_ms)},
            {"worst_ms", largest(entry.step_ms)},
            {"processor_ms", entry.processor_ms},
            {"largest_overlap_mm", 1e3 * q.largest_overlap},
            {"mean_overlap_mm", 1e3 * q.mean_overlap},
            {"resting_largest_overlap_mm", 1e3 * q.resting_largest},
            {"resting_mean_overlap_mm", 1e3 * q.resting_mean},
            {"energy_gain_J", q.energy_gain},
            {"energy_gain_percent", 1e2 * q.energy_gain_part},
            {"moving", q.moving},
            {"asleep", entry.asleep},
            {"lost", q.lost},
            {"highest_m", q.highest},
            {"drift_mm", 1e3 * q.drift}};
}

std::string tableOf(const std::vector<Entry>& entries) {
    constexpr const char* head =
        "{:<11} {:<19} {:>9} {:>9} {:>9} {:>6}  {:>8} {:>7} {:>8} {:>7}  {:>8} {:>6} {:>6} {:>5} {:>8} {:>9}\n";
    std::string text = fmt::format(fmt::runtime(head), "", "", "average", "worst", "processor", "to", "largest", "mean",
                                   "at rest", "mean", "energy", "", "", "", "highest", "drift");
    text += fmt::format(fmt::runtime(head), "scene", "engine", "ms", "ms", "ms", "first", "mm", "mm", "mm", "mm",
                        "gain %", "moving", "asleep", "lost", "m", "mm");
    double first = 0;
    std::string scene;
    for (const Entry& entry : entries) {
        if (entry.scene != scene) first = entry.processor_ms;
        const Quality& q = entry.quality;
        text += fmt::format(
            "{:<11} {:<19} {:>9.3f} {:>9.3f} {:>9.3f} {:>6.2f}  {:>8.3f} {:>7.3f} {:>8.3f} {:>7.3f}  {:>8.3f} {:>6} "
            "{:>6} {:>5} {:>8.3f} {:>9.3f}\n",
            entry.scene == scene ? "" : entry.scene, entry.engine, average(entry.step_ms), largest(entry.step_ms),
            entry.processor_ms, first > 0 ? entry.processor_ms / first : 0, 1e3 * q.largest_overlap,
            1e3 * q.mean_overlap, 1e3 * q.resting_largest, 1e3 * q.resting_mean, 1e2 * q.energy_gain_part, q.moving,
            entry.asleep, q.lost, q.highest, 1e3 * q.drift);
        scene = entry.scene;
    }
    return text;
}

}  // namespace

const std::vector<std::string>& peerScenes() {
    static const std::vector<std::string> names = {"stacks5",  "well324",  "cage384",   "stacks8", "well392",
                                                   "cage2816", "tower:20", "tower:40",  "wall:30", "heap:2000",
                                                   "pit:800",  "pit:3200", "heavy:1000"};
    return names;
}

Outcome runPeers(const PeersOptions& options) {
    stepsPerFrame(options.steps_per_second);
    const std::vector<std::string>& names = options.scenes.empty() ? peerScenes() : options.scenes;
    const std::vector<EngineKind> engines = chosenEngines(options);
    for (const std::string& name : names) RigidScene(preparedScene(name, options));  // refused before hours of work

    std::vector<Entry> entries;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto progress = [&](double part, const std::string& what) {
            options.progress((static_cast<double>(i) + part) / static_cast<double>(names.size()), what);
        };
        for (Entry& entry : compare(names[i], engines, options, progress)) entries.push_back(std::move(entry));
    }

    Outcome outcome;
    outcome.table =
        fmt::format("{:.6g} time steps per second, {}, medians of {} runs; ms per simulation step of 1/30 s\n",
                    options.steps_per_second, options.sleeping ? "sleeping on" : "sleeping off",
                    options.extent == Extent::quick ? 1 : options.repetitions);
    for (const EngineKind& kind : engines)
        outcome.table += fmt::format("{}: {}; {}\n", kind.name, kind.version, kind.settings);
    outcome.table += '\n' + tableOf(entries);
    outcome.json = originOf("peers", options.extent);
    outcome.json["steps_per_second"] = options.steps_per_second;
    outcome.json["sleeping"] = options.sleeping;
    outcome.json["repetitions"] = options.extent == Extent::quick ? 1 : options.repetitions;
    for (const EngineKind& kind : engines) {
        outcome.json["engines"][kind.name] = {{"version", kind.version}, {"settings", kind.settings}};
    }
    outcome.json["entries"] = Json::array();
    for (const Entry& entry : entries) {
        outcome.json["entries"].push_back({{"name", entry.scene + '/' + entry.engine},
                                           {"scene", entry.scene},
                                           {"engine", entry.engine},
                                           {"values", valuesOf(entry)},
                                           {"step_ms", entry.step_ms}});
    }
    return outcome;
}

}  // namespace cairn::bench
