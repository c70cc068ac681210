/// @file The command-line program; what a subcommand does stands in the file of its name. Some are programs of their
/// own.
#include "cli/companions.h"
#include "cli/output.h"
#include "commands.h"

namespace {

using namespace cairn::cli;

constexpr std::array companions = {view_companion, bench_companion, validate_companion};

void addAll(CLI::App& app, int& exit_code) {
    app.require_subcommand(1);
    for (AddCommands* add : all_commands) add(app, exit_code);
    for (const Companion& companion : companions) {
        app.add_subcommand(std::string(companion.command), std::string(companion.description));
    }
}

/// A command of a companion goes to it as it is, --help included.
void handOver(int argc, char** argv) {
    const auto is = [&](int place, std::string_view word) { return argc > place && argv[place] == word; };
    if (is(1, bench_companion.command) && is(2, thesis_companion.command)) {
        becomeCompanion(thesis_companion, {argv + 3, argv + argc});
    }
    for (const Companion& companion : companions) {
        if (is(1, companion.command)) becomeCompanion(companion, {argv + 2, argv + argc});
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        handOver(argc, argv);
    } catch (const std::exception& error) {
        printError(error.what());
        return run_failed;
    }
    return runProgram(argc, argv, "cairn", "Rigid-body dynamics whose piles and stacks stand", addAll);
}
