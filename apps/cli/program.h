/// @file What all programs have in common: --help and --version, messages, exit codes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace cairn::cli {

/// What a program returns to the shell.
enum ExitCode : int { fine = 0, run_failed = 1, wrong_use = 2 };

/// Adds options and subcommands; their callbacks set the exit code or throw InputError (wrong use) or IoError
/// (failure).
using AddCommands = void(CLI::App& app, int& exit_code);

/// The whole of a main function. @param name as users call the program @return the exit code
int runProgram(int argc, char** argv, const std::string& name, const std::string& description, AddCommands& add);

}  // namespace cairn::cli
