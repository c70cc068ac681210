/// @file cairn run: simulates a scene, records it, reports.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cairn/recording.h"
#include "cli/override_options.h"
#include "cli/scene_argument.h"
#include "commands.h"
#include "ranks_options.h"

namespace cairn::cli {

namespace {

struct RunOptions {
    std::string scene;
    std::string bodies;
    OverrideOptions overrides;
    std::optional<double> duration;
    OutputOptions outputs;
    RanksOptions ranks;
};

SceneSource withBodies(const RunOptions& options) {
    if (!isBuiltInScene(options.scene)) return readSceneSource(options.scene, options.bodies);
    throw InputError(
        fmt::format("--bodies adds to a scene file, and '{}' is built in: 'cairn scenes {} --json FILE' writes "
                    "the file, to which templates are to be added",
                    options.scene, options.scene));
}

/// @param alone one rank has all bodies: then a file is read once, while what is told is read twice
SceneSource sourceFrom(const RunOptions& options, bool alone) {
    const bool once = alone && !isBuiltInScene(options.scene);
    const auto open = [&] { return once ? SceneSource(loadScene(options.scene)) : openScene(options.scene); };
    SceneSource source = options.bodies.empty() ? open() : withBodies(options);
    if (options.duration) source.setDuration(requireDuration(*options.duration));
    return source;
}

int runScene(const RunOptions& options) {
    return runOnRanks(options.ranks, options.outputs, [&](Ranks* ranks, const Partition& partition) -> PreparedRun {
        SceneSource source = sourceFrom(options, ranks == nullptr);
        const Settings settings = settingsFor(source, overridesFrom(options.overrides, source.scene()));
        refuseSameFiles(options.outputs, isBuiltInScene(options.scene) ? "" : options.scene);
        refuseSameFiles(options.outputs, options.bodies);
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
    command
        ->add_option("--bodies", options->bodies,
                     "More bodies, which stand in arrays by the templates of the scene (HDF5)")
        ->type_name("FILE");
    addOverrideOptions(*command, options->overrides);
    command->add_option("--duration", options->duration, "Simulated time [s]; default: the scene's");
    addOutputOptions(*command, options->outputs);
    addRanksOptions(*command, options->ranks);
    command->callback([options, &exit_code] { exit_code = runScene(*options); });
}

}  // namespace cairn::cli
