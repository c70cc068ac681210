/// @file cairn run: simulates a scene, records it, reports.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "cairn/recording.h"
#include "commands.h"
#include "interrupt.h"
#include "output.h"
#include "progress.h"
#include "report.h"
#include "scene_argument.h"
#include "stats_csv.h"

namespace cairn::cli {

namespace {

constexpr double longest_duration = 1e7;  ///< [s]; about four months
constexpr std::int64_t most_threads = 1024;

struct RunOptions {
    std::string scene;
    std::string preset;  ///< empty = not given
    std::optional<std::int64_t> threads;
    std::optional<double> steps_per_second;
    std::optional<double> duration;
    std::vector<std::string> fields;
    std::string record;
    std::string stats;
    bool json = false;
    bool quiet = false;
};

std::pair<std::string, std::string> splitField(const std::string& text) {
    const std::size_t at = text.find('=');
    if (at == std::string::npos || at == 0) {
        throw InputError(fmt::format("--set is given '{}'; it must be field=value, for example --set damping=0", text));
    }
    return {text.substr(0, at), text.substr(at + 1)};
}

std::int64_t allCores() {
    return std::clamp<std::int64_t>(std::thread::hardware_concurrency(), 1, most_threads);
}

/// What the command line changes. The threads are all cores unless somebody asks for a number.
SettingOverrides overridesFrom(const RunOptions& options, const Scene& scene) {
    SettingOverrides overrides{{}, options.steps_per_second, {}};
    if (!options.preset.empty()) {
        overrides.preset = options.preset == "accuracy" ? Preset::accuracy : Preset::performance;
    }
    const bool scene_decides = std::any_of(scene.settings.begin(), scene.settings.end(),
                                           [](const auto& field) { return field.first == "threads"; });
    if (options.threads || !scene_decides) {
        overrides.fields.emplace_back("threads", fmt::format("{}", options.threads.value_or(allCores())));
    }
    for (const std::string& field : options.fields) overrides.fields.push_back(splitField(field));
    return overrides;
}

Scene sceneFrom(const RunOptions& options) {
    Scene scene = loadScene(options.scene);
    if (options.duration) {
        if (!(*options.duration > 0 && *options.duration <= longest_duration)) {
            throw InputError(fmt::format("--duration is {}; it must be above 0 and at most {} s", *options.duration,
                                         longest_duration));
        }
        scene.duration = *options.duration;
    }
    return scene;
}

/// Outputs must not overwrite each other or the scene.
void refuseSameFiles(const RunOptions& options) {
    const auto same = [](const std::string& a, const std::string& b) {
        if (a.empty() || b.empty()) return false;
        std::error_code unknown;
        return a == b || std::filesystem::equivalent(a, b, unknown);
    };
    if (same(options.record, options.stats)) {
        throw InputError(fmt::format("--record and --stats both name '{}'; give two files", options.record));
    }
    for (const std::string& out : {options.record, options.stats}) {
        if (same(out, options.scene) && !isBuiltInScene(options.scene)) {
            throw InputError(fmt::format("'{}' is the scene itself; name another file for the output", out));
        }
    }
}

std::string describeFault(const SceneRun& run, const FaultInfo& fault) {
    const auto found = std::find(run.ids().begin(), run.ids().end(), fault.body);
    const auto index = static_cast<std::size_t>(found - run.ids().begin());
    const std::string& name = run.scene().bodies.at(index).name;
    return fmt::format("body {}{} failed in time step {} and was fixed: {}", index,
                       name.empty() ? "" : fmt::format(" '{}'", name), fault.step, fault.what);
}

/// A run with its outputs.
class Runner {
  public:
    Runner(const Scene& scene, const Settings& settings, const RunOptions& options) : run_(scene, settings) {
        run_.stepsPerSimulationStep();  // refuses a bad number before a file is touched
        if (!options.record.empty()) recording_.emplace(options.record, scene, settings);
        if (!options.stats.empty()) stats_.emplace(options.stats);
    }

    /// @return why the run ended early, if it did. What failed is an output or a body; wrong events throw InputError
    std::optional<std::string> simulate(Progress::Wish progress_wish) {
        const double duration = run_.scene().duration;
        // A duration such as 0.1 s is not exactly three simulation steps.
        const auto steps = static_cast<std::int64_t>(std::ceil(duration * simulation_steps_per_second - 1e-6));
        Progress progress(duration, progress_wish);
        try {
            record({});
            for (std::int64_t i = 0; i < std::max<std::int64_t>(steps, 1); ++i) {
                if (interrupted())
                    return fmt::format("interrupted after {:.6g} of {} s", run_.world().time(), duration);
                step();
                if (!run_.world().faults().empty()) return describeFault(run_, run_.world().faults().front());
                progress.update(run_.world().time());
            }
            if (recording_) recording_->close();
        } catch (const IoError& error) {
            return error.what();
        }
        return std::nullopt;
    }

    Report report() const { return makeReport(run_, measurements_); }

  private:
    void step() {
        using Milliseconds = std::chrono::duration<double, std::milli>;
        const auto begin = std::chrono::steady_clock::now();
        const Statistics statistics = run_.simulationStep();
        const double ms = Milliseconds(std::chrono::steady_clock::now() - begin).count();
        measurements_.add(ms, statistics);
        record(statistics);
        if (stats_) stats_->add(run_.world(), ms, statistics);
    }

    void record(const Statistics& statistics) {
        if (recording_) recording_->append(captureFrame(run_, statistics));
    }

    SceneRun run_;
    std::optional<RecordingWriter> recording_;
    std::optional<StatsCsv> stats_;
    Measurements measurements_;
};

int runScene(const RunOptions& options) {
    const Scene scene = sceneFrom(options);
    const Settings settings = settingsFor(scene, overridesFrom(options, scene));
    refuseSameFiles(options);
    Runner runner(scene, settings, options);
    noteInterrupts();
    const auto failure = runner.simulate(options.quiet || options.json ? Progress::Wish::hide : Progress::Wish::show);
    const Report report = runner.report();
    if (options.json) {
        printOut(toJson(report).dump(2) + '\n');
    } else if (!options.quiet) {
        printOut(formatTable(report));
    }
    if (!failure) return fine;
    printError(*failure);
    return run_failed;
}

}  // namespace

void addRun(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("run", "Simulate a scene and report how fast and how accurate it was");
    auto options = std::make_shared<RunOptions>();
    command->add_option("SCENE", options->scene, "The name of a built-in scene, or a scene file")->required();
    command->add_option("--preset", options->preset, "The default is the scene's, or else performance")
        ->check(CLI::IsMember({"performance", "accuracy"}));
    command->add_option("--threads", options->threads, "Threads of a step; default: all cores");
    command->add_option("--steps-per-second", options->steps_per_second,
                        "Time steps per simulated second; default: the preset's");
    command->add_option("--duration", options->duration, "Simulated time [s]; default: the scene's");
    command->add_option("--set", options->fields, "Set a field of the settings; see 'cairn settings'. Repeatable")
        ->type_name("FIELD=VALUE")
        ->allow_extra_args(false);
    command->add_option("--record", options->record, "Write a recording (HDF5)")->type_name("FILE");
    command->add_option("--stats", options->stats, "Write the statistics of every simulation step (CSV)")
        ->type_name("FILE");
    command->add_flag("--json", options->json, "Print the report as one JSON object and nothing else");
    command->add_flag("--quiet", options->quiet, "Print neither progress nor report");
    command->callback([options, &exit_code] { exit_code = runScene(*options); });
}

}  // namespace cairn::cli
