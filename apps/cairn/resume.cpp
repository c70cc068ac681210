/// @file cairn resume: goes on with a run that was written by --checkpoint.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "commands.h"
#include "ranks_options.h"

namespace cairn::cli {

namespace {

struct ResumeOptions {
    std::string file;
    std::optional<std::int64_t> threads;
    std::optional<double> duration;
    OutputOptions outputs;
    RanksOptions ranks;
};

SceneRun runFrom(const ResumeOptions& options, Ranks* ranks, const Partition& partition) {
    SceneRun run = ranks != nullptr ? readCheckpoint(options.file, *ranks, partition) : readCheckpoint(options.file);
    if (options.threads) {
        // Results do not depend on the threads; every other setting would make another run of it.
        Settings settings = run.world().settings();
        setField(settings, "threads", *options.threads);
        run.world().setSettings(settings);
    }
    if (options.duration) run.setDuration(requireDuration(*options.duration));
    if (!(run.world().time() < run.scene().duration - 1e-9)) {
        throw InputError(fmt::format("the run of '{}' is at its end, {} s; give a longer --duration to go on",
                                     options.file, run.scene().duration));
    }
    refuseSameFiles(options.outputs, options.file);
    return run;
}

}  // namespace

void addResume(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("resume", "Go on with a run from its checkpoint, as if it had never stopped");
    auto options = std::make_shared<ResumeOptions>();
    command->add_option("FILE", options->file, "What 'cairn run --checkpoint' wrote")->required();
    command->add_option("--threads", options->threads, "Threads of a step; default: as before");
    command->add_option("--duration", options->duration, "Simulated time of the whole run [s]; default: as before");
    addOutputOptions(*command, options->outputs);
    addRanksOptions(*command, options->ranks);
    command->callback([options, &exit_code] {
        const auto prepare = [&](Ranks* ranks, const Partition& partition) -> PreparedRun {
            return {runFrom(*options, ranks, partition), options->file};
        };
        exit_code = runOnRanks(options->ranks, options->outputs, prepare);
    });
}

}  // namespace cairn::cli
