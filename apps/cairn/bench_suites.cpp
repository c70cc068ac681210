#include "bench_suites.h"

#include <fmt/format.h>

#include <memory>

#include "bench/peers.h"
#include "bench/scenes.h"
#include "bench_progress.h"
#include "commands.h"
#include "interrupt.h"
#include "output.h"
#include "override_options.h"

namespace cairn::cli {

namespace {

constexpr double longest_duration = 1e7;  ///< [s]
constexpr int most_repetitions = 1000;

/// What all suites are asked.
struct SuiteArguments {
    bool quick = false;
    bool json = false;
    std::string save;

    bench::Extent extent() const { return quick ? bench::Extent::quick : bench::Extent::full; }
};

void addSuiteOptions(CLI::App& command, SuiteArguments& arguments) {
    command.add_flag("--quick", arguments.quick, "Shortened, once: shows that it works; the numbers do not count");
    command.add_flag("--json", arguments.json, "Print the results as one JSON object and nothing else");
    command.add_option("--save", arguments.save, "Write the results as JSON as well")->type_name("FILE");
}

/// Runs a suite with progress, and shows what it found.
template <class Run>
int runSuite(const SuiteArguments& arguments, const Run& run) {
    noteInterrupts();
    try {
        const bench::Outcome outcome = [&] {
            BenchProgress progress;
            return run([&](double part, const std::string& what) {
                progress.update(part, what);
                if (interrupted()) throw bench::Interrupted{};
            });
        }();
        const std::string json = outcome.json.dump(1) + '\n';
        if (!arguments.save.empty()) TextFile(arguments.save).write(json);
        printOut(arguments.json ? json : outcome.table);
        return fine;
    } catch (const bench::Interrupted&) {
        printError("interrupted");
        return run_failed;
    }
}

/// What the suites that simulate scenes are asked.
struct SceneArguments {
    std::vector<std::string> scenes;
    std::vector<std::string> variants;
    std::string preset;
    std::vector<std::string> fields;
    std::size_t repetitions = 3;
    double duration = longest_duration;

    SettingOverrides overrides() const {
        SettingOverrides made;
        if (!preset.empty()) made.preset = preset == "accuracy" ? Preset::accuracy : Preset::performance;
        for (const std::string& field : fields) made.fields.push_back(splitField(field));
        return made;
    }
};

void addSceneOptions(CLI::App& command, SceneArguments& arguments) {
    command
        .add_option("--scenes", arguments.scenes,
                    "Scenes, files and heavy:RATIO; default: those of docs/performance.md")
        ->delimiter(',');
    command.add_option("--variant", arguments.variants, "Cairn once more with other settings beside it. Repeatable")
        ->type_name("NAME:FIELD=VALUE,...")
        ->allow_extra_args(false);
    command.add_option("--preset", arguments.preset, "Of Cairn; default: the scene's, or else performance")
        ->check(CLI::IsMember({"performance", "accuracy"}));
    command.add_option("--set", arguments.fields, "Set a field of Cairn's settings. Repeatable")
        ->type_name("FIELD=VALUE")
        ->allow_extra_args(false);
    command.add_option("--repeat", arguments.repetitions, "Runs of each, in turns; default: 3")
        ->check(CLI::Range(1, most_repetitions));
    command.add_option("--duration", arguments.duration, "End the scenes after S seconds")
        ->type_name("S")
        ->check(CLI::Range(1e-3, longest_duration));
}

struct PeersArguments {
    SuiteArguments suite;
    SceneArguments scene;
    std::vector<std::string> engines;
    double steps_per_second = 240;
    std::int64_t threads = 1;
    bool awake = false;
};

struct ScenesArguments {
    SuiteArguments suite;
    SceneArguments scene;
    std::optional<double> steps_per_second;
    std::vector<std::int64_t> threads = {1};
};

/// NAME:FIELD=VALUE[,FIELD=VALUE…]
bench::Variant parseVariant(const std::string& text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos || colon == 0) {
        throw InputError(fmt::format(
            "--variant is given '{}'; it must be NAME:FIELD=VALUE, for example sweeps20:sweep_limit=20", text));
    }
    bench::Variant variant{text.substr(0, colon), {}};
    for (const std::string& field : CLI::detail::split(text.substr(colon + 1), ',')) {
        variant.fields.push_back(splitField(field));
    }
    return variant;
}

std::vector<bench::Variant> parseVariants(const std::vector<std::string>& texts) {
    std::vector<bench::Variant> variants;
    for (const std::string& text : texts) variants.push_back(parseVariant(text));
    return variants;
}

bench::PeersOptions peersOptions(const PeersArguments& arguments) {
    bench::PeersOptions options;
    options.scenes = arguments.scene.scenes;
    options.engines = arguments.engines;
    options.overrides = arguments.scene.overrides();
    options.variants = parseVariants(arguments.scene.variants);
    options.steps_per_second = arguments.steps_per_second;
    options.threads = arguments.threads;
    options.repetitions = arguments.scene.repetitions;
    options.sleeping = !arguments.awake;
    options.longest = arguments.scene.duration;
    options.extent = arguments.suite.extent();
    return options;
}

void addPeersSuite(CLI::App& bench, int& exit_code) {
    CLI::App* command =
        bench.add_subcommand("peers", "Compare with Bullet and ODE: time and quality in the same scenes");
    auto arguments = std::make_shared<PeersArguments>();
    addSceneOptions(*command, arguments->scene);
    command->add_option("--engines", arguments->engines, "Of cairn, bullet and ode; default: all")->delimiter(',');
    command->add_option("--steps-per-second", arguments->steps_per_second, "Of every engine; default: 240");
    command->add_option("--threads", arguments->threads, "Of Cairn; default: 1, as the peers have");
    command->add_flag("--awake", arguments->awake, "No body sleeps, in any engine");
    addSuiteOptions(*command, arguments->suite);
    command->callback([arguments, &exit_code] {
        bench::PeersOptions options = peersOptions(*arguments);
        exit_code = runSuite(arguments->suite, [&](const bench::Progress& progress) {
            options.progress = progress;
            return bench::runPeers(options);
        });
    });
}

void addScenesSuite(CLI::App& bench, int& exit_code) {
    CLI::App* command = bench.add_subcommand("scenes", "Measure Cairn's scenes: time by stage, and overlaps");
    auto arguments = std::make_shared<ScenesArguments>();
    addSceneOptions(*command, arguments->scene);
    command->add_option("--steps-per-second", arguments->steps_per_second, "Default: the preset's");
    command->add_option("--threads", arguments->threads, "One number or more, such as 1,2; default: 1")->delimiter(',');
    addSuiteOptions(*command, arguments->suite);
    command->callback([arguments, &exit_code] {
        bench::ScenesOptions options;
        options.scenes = arguments->scene.scenes;
        options.overrides = arguments->scene.overrides();
        options.overrides.steps_per_second = arguments->steps_per_second;
        options.variants = parseVariants(arguments->scene.variants);
        options.threads = arguments->threads;
        options.repetitions = arguments->scene.repetitions;
        options.longest = arguments->scene.duration;
        options.extent = arguments->suite.extent();
        exit_code = runSuite(arguments->suite, [&](const bench::Progress& progress) {
            options.progress = progress;
            return bench::runScenes(options);
        });
    });
}

}  // namespace

void addBenchSuites(CLI::App& bench, int& exit_code) {
    addScenesSuite(bench, exit_code);
    addPeersSuite(bench, exit_code);
}

}  // namespace cairn::cli
