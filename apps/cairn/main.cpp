/// @file The command-line program; what a subcommand does stands in the file of its name.
#include <cstdio>
#include <exception>
#include <iostream>

#include "cairn/types.h"
#include "cairn/version.h"
#include "commands.h"
#include "interrupt.h"
#include "output.h"

namespace {

using namespace cairn::cli;

int parseAndRun(int argc, char** argv) {
    int exit_code = fine;
    CLI::App app("Rigid-body dynamics whose piles and stacks stand", "cairn");
    app.require_subcommand(1);
    for (AddCommand* add : all_commands) add(app, exit_code);
    const std::string version = "cairn " + std::string(cairn::version);
    app.set_version_flag("--version", version, "Print the version and exit");
    for (CLI::App* command : app.get_subcommands({})) {
        command->set_version_flag("--version", version, "Print the version and exit");
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& request) {  // --help or --version
        std::ostringstream text;
        app.exit(request, text, text);
        printOut(text.str());
    } catch (const CLI::ParseError& error) {
        printError(error.what());
        printLine(stderr, "Run with --help for the commands and their options.");
        exit_code = wrong_use;
    }
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    ignoreBrokenPipes();
    try {
        return parseAndRun(argc, argv);
    } catch (const ReaderGone&) {
        return run_failed;
    } catch (const cairn::InputError& error) {
        printError(error.what());
        return wrong_use;
    } catch (const std::bad_alloc&) {
        printError("out of memory");
    } catch (const std::exception& error) {
        printError(error.what());
    }
    return run_failed;
}
