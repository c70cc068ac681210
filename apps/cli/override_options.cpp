#include "cli/override_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace cairn::cli {

std::int64_t allCores() {
    return std::clamp<std::int64_t>(std::thread::hardware_concurrency(), 1, most_threads);
}

std::pair<std::string, std::string> splitField(const std::string& text) {
    const std::size_t at = text.find('=');
    if (at == std::string::npos || at == 0) {
        throw InputError(fmt::format("--set is given '{}'; it must be field=value, for example --set damping=0", text));
    }
    return {text.substr(0, at), text.substr(at + 1)};
}

void addOverrideOptions(CLI::App& command, OverrideOptions& options) {
    command.add_option("--preset", options.preset, "The default is the scene's, or else performance")
        ->check(CLI::IsMember(std::vector<std::string>(presetNames().begin(), presetNames().end())));
    command.add_option("--threads", options.threads, "Threads of a step; default: all cores");
    command.add_option("--steps-per-second", options.steps_per_second,
                       "Time steps per simulated second; default: by the preset and the sizes of the bodies");
    command.add_option("--set", options.fields, "Set a field of the settings; see 'cairn settings'. Repeatable")
        ->type_name("FIELD=VALUE")
        ->allow_extra_args(false);
}

SettingOverrides overridesFrom(const OverrideOptions& options, const Scene& scene) {
    SettingOverrides overrides{{}, options.steps_per_second, {}};
    if (!options.preset.empty()) overrides.preset = presetNamed(options.preset);
    const bool scene_decides = std::any_of(scene.settings.begin(), scene.settings.end(),
                                           [](const auto& field) { return field.first == "threads"; });
    if (options.threads || !scene_decides) {
        overrides.fields.emplace_back("threads", fmt::format("{}", options.threads.value_or(allCores())));
    }
    for (const std::string& field : options.fields) overrides.fields.push_back(splitField(field));
    return overrides;
}

}  // namespace cairn::cli
