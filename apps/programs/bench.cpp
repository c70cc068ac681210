/// @file cairn-bench: the suites of our own; the thesis's benchmarks are a program beside it.

#include <fmt/format.h>

#include <memory>

#include "bench/kernels.h"
#include "bench/peers.h"
#include "bench/plot.h"
#include "bench/rays.h"
#include "bench/scaling.h"
#include "bench/scenes.h"
#include "bench/threads.h"
#include "cli/bench_progress.h"
#include "cli/companions.h"
#include "cli/interrupt.h"
#include "cli/output.h"
#include "cli/override_options.h"
#include "cli/program.h"

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
    catchInterrupts();
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

/// How Cairn is set, once or in several ways side by side.
struct SettingArguments {
    std::vector<std::string> variants;
    std::vector<std::string> resolvers;
    std::string preset;
    std::vector<std::string> fields;
    std::size_t repetitions = 3;

    SettingOverrides overrides() const;
    std::vector<bench::Variant> allVariants() const;
};

/// What the suites that simulate scenes are asked.
struct SceneArguments {
    std::vector<std::string> scenes;
    double duration = longest_duration;
};

/// NAME:FIELD=VALUE[,FIELD=VALUE…]
bench::Variant parseVariant(const std::string& text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos || colon == 0) {
        throw InputError(fmt::format(
            "--variant is given '{}'; it must be NAME:FIELD=VALUE, for example exact:tolerance=0.01", text));
    }
    bench::Variant variant{text.substr(0, colon), {}};
    for (const std::string& part : CLI::detail::split(text.substr(colon + 1), ',')) {
        const auto [field, value] = splitField(part);
        if (field == "preset") {
            variant.preset = presetNamed(value);
        } else {
            variant.fields.emplace_back(field, value);
        }
    }
    return variant;
}

SettingOverrides SettingArguments::overrides() const {
    SettingOverrides made;
    if (!preset.empty()) made.preset = presetNamed(preset);
    for (const std::string& field : fields) made.fields.push_back(splitField(field));
    return made;
}

std::vector<bench::Variant> SettingArguments::allVariants() const {
    std::vector<bench::Variant> all;
    for (const std::string& resolver : resolvers) all.push_back({resolver, {{"resolution", resolver}}});
    for (const std::string& text : variants) all.push_back(parseVariant(text));
    return all;
}

void addRepeatOption(CLI::App& command, std::size_t& repetitions) {
    command.add_option("--repeat", repetitions, "Runs of each, in turns; default: 3")
        ->check(CLI::Range(1, most_repetitions));
}

void addSettingOptions(CLI::App& command, SettingArguments& arguments) {
    command.add_option("--resolver", arguments.resolvers, "Cairn once more with each of these resolutions beside it")
        ->type_name("NAME,...")
        ->delimiter(',');
    command
        .add_option("--variant", arguments.variants,
                    "Cairn once more with other settings (or preset=...) beside it. Repeatable")
        ->type_name("NAME:FIELD=VALUE,...")
        ->allow_extra_args(false);
    command.add_option("--preset", arguments.preset, "Of Cairn; default: the scene's, or else performance")
        ->check(CLI::IsMember({"performance", "accuracy"}));
    command.add_option("--set", arguments.fields, "Set a field of Cairn's settings. Repeatable")
        ->type_name("FIELD=VALUE")
        ->allow_extra_args(false);
    addRepeatOption(command, arguments.repetitions);
}

void addSceneOptions(CLI::App& command, SceneArguments& arguments) {
    command
        .add_option("--scenes", arguments.scenes,
                    "Scenes, files and heavy:RATIO; default: those of docs/performance.md")
        ->delimiter(',');
    command.add_option("--duration", arguments.duration, "End the scenes after S seconds")
        ->type_name("S")
        ->check(CLI::Range(1e-3, longest_duration));
}

void addThreadsOption(CLI::App& command, std::vector<std::int64_t>& threads, std::string_view usual) {
    command.add_option("--threads", threads, fmt::format("One number or more; default: {}", usual))->delimiter(',');
}

struct PeersArguments {
    SuiteArguments suite;
    SettingArguments settings;
    SceneArguments scene;
    std::vector<std::string> engines;
    double steps_per_second = 240;
    std::int64_t threads = 1;
    bool awake = false;
    std::string plot;
};

struct ScenesArguments {
    SuiteArguments suite;
    SettingArguments settings;
    SceneArguments scene;
    std::optional<double> steps_per_second;
    std::vector<std::int64_t> threads = {1};
};

struct ScalingArguments {
    SuiteArguments suite;
    SettingArguments settings;
    std::vector<std::int64_t> sizes;
    std::vector<std::int64_t> threads = {1, 2};
};

struct KernelsArguments {
    SuiteArguments suite;
    std::string filter;
    std::size_t repetitions = 3;
    double seconds = 0.1;
};

bench::PeersOptions peersOptions(const PeersArguments& arguments) {
    bench::PeersOptions options;
    options.scenes = arguments.scene.scenes;
    options.engines = arguments.engines;
    options.overrides = arguments.settings.overrides();
    options.variants = arguments.settings.allVariants();
    options.steps_per_second = arguments.steps_per_second;
    options.threads = arguments.threads;
    options.repetitions = arguments.settings.repetitions;
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
    addSettingOptions(*command, arguments->settings);
    command->add_option("--engines", arguments->engines, "Of cairn, bullet and ode; default: all")->delimiter(',');
    command->add_option("--steps-per-second", arguments->steps_per_second, "Of every engine; default: 240");
    command->add_option("--threads", arguments->threads, "Of Cairn; default: 1, as the peers have");
    command->add_flag("--awake", arguments->awake, "No body sleeps, in any engine");
    command->add_option("--plot", arguments->plot, "Draw times and overlaps as an SVG")->type_name("FILE");
    addSuiteOptions(*command, arguments->suite);
    command->callback([arguments, &exit_code] {
        if (!arguments->plot.empty() && arguments->plot == arguments->suite.save) {
            throw InputError(fmt::format("--plot and --save are both given '{}'; give two names", arguments->plot));
        }
        bench::PeersOptions options = peersOptions(*arguments);
        exit_code = runSuite(arguments->suite, [&](const bench::Progress& progress) {
            options.progress = progress;
            bench::Outcome outcome = bench::runPeers(options);
            if (!arguments->plot.empty()) TextFile(arguments->plot).write(bench::peersPlot(outcome.json));
            return outcome;
        });
    });
}

void addScenesSuite(CLI::App& bench, int& exit_code) {
    CLI::App* command = bench.add_subcommand("scenes", "Measure Cairn's scenes: time by stage, and overlaps");
    auto arguments = std::make_shared<ScenesArguments>();
    addSceneOptions(*command, arguments->scene);
    addSettingOptions(*command, arguments->settings);
    command->add_option("--steps-per-second", arguments->steps_per_second, "Default: the preset's");
    addThreadsOption(*command, arguments->threads, "1");
    addSuiteOptions(*command, arguments->suite);
    command->callback([arguments, &exit_code] {
        bench::ScenesOptions options;
        options.scenes = arguments->scene.scenes;
        options.overrides = arguments->settings.overrides();
        options.overrides.steps_per_second = arguments->steps_per_second;
        options.variants = arguments->settings.allVariants();
        options.threads = arguments->threads;
        options.repetitions = arguments->settings.repetitions;
        options.longest = arguments->scene.duration;
        options.extent = arguments->suite.extent();
        exit_code = runSuite(arguments->suite, [&](const bench::Progress& progress) {
            options.progress = progress;
            return bench::runScenes(options);
        });
    });
}

void addScalingSuite(CLI::App& bench, int& exit_code) {
    CLI::App* command = bench.add_subcommand("scaling", "Measure how time and memory grow from 1000 to 100000 bodies");
    auto arguments = std::make_shared<ScalingArguments>();
    command->add_option("--sizes", arguments->sizes, "Bodies, about; default: 1000,3000,10000,30000,100000")
        ->delimiter(',');
    addThreadsOption(*command, arguments->threads, "1,2");
    addSettingOptions(*command, arguments->settings);
    addSuiteOptions(*command, arguments->suite);
    command->callback([arguments, &exit_code] {
        bench::ScalingOptions options;
        options.sizes = arguments->sizes;
        options.overrides = arguments->settings.overrides();
        options.variants = arguments->settings.allVariants();
        options.threads = arguments->threads;
        options.repetitions = arguments->settings.repetitions;
        options.extent = arguments->suite.extent();
        exit_code = runSuite(arguments->suite, [&](const bench::Progress& progress) {
            options.progress = progress;
            return bench::runScaling(options);
        });
    });
}

struct ThreadsArguments {
    std::vector<std::string> scenes;
    double seconds = 2;
    std::size_t pairs = 15;
    SuiteArguments suite;
};

void addThreadsSuite(CLI::App& bench, int& exit_code) {
    CLI::App* command = bench.add_subcommand("threads", "Measure whether a second thread ever costs time");
    auto arguments = std::make_shared<ThreadsArguments>();
    command->add_option("--scenes", arguments->scenes, "Default: stacks5,well392,cage384")->delimiter(',');
    command->add_option("--duration", arguments->seconds, "Longest simulated time of a run; default: 2")
        ->type_name("S")
        ->check(CLI::Range(1e-3, longest_duration));
    command->add_option("--pairs", arguments->pairs, "Runs on one and on two threads, in turns; default: 15")
        ->check(CLI::Range(1, most_repetitions));
    addSuiteOptions(*command, arguments->suite);
    command->callback([arguments, &exit_code] {
        bench::ThreadsOptions options;
        options.scenes = arguments->scenes;
        options.seconds = arguments->seconds;
        options.pairs = arguments->pairs;
        options.extent = arguments->suite.extent();
        exit_code = runSuite(arguments->suite, [&](const bench::Progress& progress) {
            options.progress = progress;
            return bench::runThreads(options);
        });
    });
}

void addKernelsSuite(CLI::App& bench, int& exit_code) {
    CLI::App* command = bench.add_subcommand("kernels", "Measure the inner loops alone: ns per contact, pair or body");
    auto arguments = std::make_shared<KernelsArguments>();
    command->add_option("--filter", arguments->filter, "Only kernels whose name has a match of this")
        ->type_name("REGEX");
    command->add_option("--seconds", arguments->seconds, "Least time of a repetition; default: 0.1")
        ->type_name("S")
        ->check(CLI::Range(1e-3, 100.0));
    addRepeatOption(*command, arguments->repetitions);
    addSuiteOptions(*command, arguments->suite);
    command->callback([arguments, &exit_code] {
        bench::KernelsOptions options;
        options.filter = arguments->filter;
        options.repetitions = arguments->repetitions;
        options.seconds = arguments->seconds;
        options.extent = arguments->suite.extent();
        exit_code = runSuite(arguments->suite, [&](const bench::Progress& progress) {
            options.progress = progress;
            return bench::runKernels(options);
        });
    });
}

struct RaysArguments {
    std::string scene = "heap:10000";
    double seconds = 3;
    std::size_t rays = 100'000;
    std::size_t repetitions = 5;
    SuiteArguments suite;
};

void addRaysSuite(CLI::App& bench, int& exit_code) {
    CLI::App* command = bench.add_subcommand("rays", "Compare with Bullet: rays into a pile, time and hits");
    auto arguments = std::make_shared<RaysArguments>();
    command->add_option("--scene", arguments->scene, "Default: heap:10000");
    command->add_option("--duration", arguments->seconds, "How long it falls before; default: 3")
        ->type_name("S")
        ->check(CLI::Range(0.0, longest_duration));
    command->add_option("--rays", arguments->rays, "Default: 100000")->check(CLI::Range(1, 100'000'000));
    command->add_option("--repeat", arguments->repetitions, "Of each engine, in turns; default: 5")
        ->check(CLI::Range(1, most_repetitions));
    addSuiteOptions(*command, arguments->suite);
    command->callback([arguments, &exit_code] {
        bench::RaysOptions options;
        options.scene = arguments->scene;
        options.seconds = arguments->seconds;
        options.rays = arguments->rays;
        options.repetitions = arguments->repetitions;
        options.extent = arguments->suite.extent();
        exit_code = runSuite(arguments->suite, [&](const bench::Progress& progress) {
            options.progress = progress;
            return bench::runRays(options);
        });
    });
}

void addSuites(CLI::App& bench, int& exit_code) {
    bench.require_subcommand(1);
    bench.add_subcommand(std::string(thesis_companion.command), std::string(thesis_companion.description));
    addKernelsSuite(bench, exit_code);
    addScenesSuite(bench, exit_code);
    addScalingSuite(bench, exit_code);
    addThreadsSuite(bench, exit_code);
    addPeersSuite(bench, exit_code);
    addRaysSuite(bench, exit_code);
}

}  // namespace

}  // namespace cairn::cli

int main(int argc, char** argv) {
    using namespace cairn::cli;
    if (argc > 1 && argv[1] == thesis_companion.command) {
        try {
            becomeCompanion(thesis_companion, {argv + 2, argv + argc});
        } catch (const std::exception& error) {
            printError(error.what());
            return run_failed;
        }
    }
    return runProgram(argc, argv, "cairn bench", "Measure", addSuites);
}
