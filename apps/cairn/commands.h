/// @file The subcommands. A new one is a file of its own and a line in all_commands.
#pragma once

#include <CLI/CLI.hpp>
#include <array>

namespace cairn::cli {

/// What the program returns to the shell.
enum ExitCode : int { fine = 0, run_failed = 1, wrong_use = 2 };

/// Adds a subcommand; its callback sets the exit code or throws InputError (wrong use) or IoError (failure).
using AddCommand = void(CLI::App& app, int& exit_code);

AddCommand addRun, addResume, addReplay, addScenes, addInfo, addExport, addSettings, addView, addBench, addValidate;

inline constexpr std::array<AddCommand*, 10> all_commands = {addRun,    addResume,   addReplay, addScenes, addInfo,
                                                             addExport, addSettings, addView,   addBench,  addValidate};

}  // namespace cairn::cli
