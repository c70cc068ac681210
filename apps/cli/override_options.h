/// @file Options that change a scene's settings, shared by the subcommands that simulate.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cairn/scene.h"

namespace cairn::cli {

constexpr std::int64_t most_threads = 1024;

/// As many threads as there are processors.
std::int64_t allCores();

/// What the command line changes.
struct OverrideOptions {
    std::string preset;  ///< empty = not given
    std::optional<std::int64_t> threads;
    std::optional<double> steps_per_second;
    std::vector<std::string> fields;
};

/// Adds --preset, --threads, --steps-per-second and --set. @param options must outlive the command
void addOverrideOptions(CLI::App& command, OverrideOptions& options);

/// The two sides of `--set field=value`. @throws InputError
std::pair<std::string, std::string> splitField(const std::string& text);

/// The threads are all cores unless somebody asks for a number. @throws InputError
SettingOverrides overridesFrom(const OverrideOptions& options, const Scene& scene);

}  // namespace cairn::cli
