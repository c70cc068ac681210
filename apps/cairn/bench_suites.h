/// @file The suites of `cairn bench` beside the thesis's.
#pragma once

#include <CLI/CLI.hpp>

namespace cairn::cli {

/// Adds a subcommand for each suite. @param bench the command they belong to
void addBenchSuites(CLI::App& bench, int& exit_code);

}  // namespace cairn::cli
