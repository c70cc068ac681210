/// @file cairn run: simulates a scene, records it, reports.
#include <memory>
#include <optional>

#include "cli/override_options.h"
#include "cli/scene_argument.h"
#include "commands.h"
#include "ranks_options.h"

namespace cairn::cli {

namespace {

struct RunOptions {
    std::string scene;
    OverrideOptions overrides;
    std::optional<double> duration;
    OutputOptions outputs;
    RanksOptions ranks;
};

SceneSource sourceFrom(const RunOptions& options) {
    SceneSource source = openScene(options.scene);
    if (options.duration) source.setDuration(requireDuration(*options.duration));
    return source;
}

int runScene(const RunOptions& options) {
    return runOnRanks(options.ranks, options.outputs, [&](Ranks* ranks, const Partition& partition) -> PreparedRun {
        SceneSource source = sourceFrom(options);
        const Settings settings = settingsFor(source, overridesFrom(options.overrides, source.scene()));
        refuseSameFiles(options.outputs, isBuiltInScene(options.scene) ? "" : options.scene);
        std::filesystem::path checkpoint = usualCheckpointFile(source.scene().name);
        if (ranks == nullptr) return {SceneRun(std::move(source), settings), std::move(checkpoint)};
        return {SceneRun(std::move(source), settings, *ranks, partition), std::move(checkpoint)};
    });
}

}  // namespace

void addRun(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("run", "Simulate a scene and report how fast and how accurate it was");
    auto options = std::make_shared<RunOptions>();
    command->add_option("SCENE", options->scene, "The name of a built-in scene, or a scene file")->required();
    addOverrideOptions(*command, options->overrides);
    command->add_option("--duration", options->duration, "Simulated time [s]; default: the scene's");
    addOutputOptions(*command, options->outputs);
    addRanksOptions(*command, options->ranks);
    command->callback([options, &exit_code] { exit_code = runScene(*options); });
}

}  // namespace cairn::cli
