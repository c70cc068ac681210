/// @file cairn scenes: the built-in scenes, and scenes written as files.
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "cairn/scene.h"
#include "cli/output.h"
#include "cli/scene_argument.h"
#include "commands.h"

namespace cairn::cli {

namespace {

struct ScenesOptions {
    std::string scene;
    std::string json;
    std::vector<double> scale{1, 1, 1};
};

void list() {
    std::string text;
    for (const BuiltInScene& scene : builtInScenes()) {
        text += fmt::format("{:<13} {}", scene.name, scene.description);
        if (scene.example != scene.name) text += fmt::format(", for example {}", scene.example);
        text += '\n';
    }
    printOut(text);
}

}  // namespace

void addScenes(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("scenes", "List the built-in scenes, or write a scene as a file");
    auto options = std::make_shared<ScenesOptions>();
    CLI::Option* scene = command->add_option("SCENE", options->scene, "A built-in scene or a scene file");
    CLI::Option* json = command->add_option("--json", options->json, "Write the scene to this file")->needs(scene);
    scene->needs(json);
    command
        ->add_option("--scale", options->scale,
                     "Multiply lengths, times and masses by these numbers, and every other value as its unit asks")
        ->type_name("L,T,M")
        ->delimiter(',')
        ->expected(3)
        ->needs(json);
    command->callback([options] {
        if (options->scene.empty()) return list();
        const Scales scales{options->scale[0], options->scale[1], options->scale[2]};
        const Scene written = scaled(loadScene(options->scene), scales);
        // No file is written that could not be run, with lengths below a micrometre for instance.
        const SceneRun run(written, settingsFor(written));
        writeScene(written, options->json);
    });
}

}  // namespace cairn::cli
