/// @file cairn scenes: the built-in scenes.
#include <fmt/format.h>

#include "cairn/scene.h"
#include "cli/output.h"
#include "commands.h"

namespace cairn::cli {

void addScenes(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("scenes", "List the built-in scenes");
    command->callback([] {
        std::string text;
        for (const BuiltInScene& scene : builtInScenes()) {
            text += fmt::format("{:<13} {}", scene.name, scene.description);
            if (scene.example != scene.name) text += fmt::format(", for example {}", scene.example);
            text += '\n';
        }
        printOut(text);
    });
}

}  // namespace cairn::cli
