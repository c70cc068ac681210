#include "cli/program.h"

#include <cstdio>
#include <exception>
#include <sstream>

#include "cairn/types.h"
#include "cairn/version.h"
#include "cli/interrupt.h"
#include "cli/output.h"

namespace cairn::cli {

namespace {

int parseAndRun(int argc, char** argv, CLI::App& app, const int& exit_code) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& request) {  // --help or --version
        std::ostringstream text;
        app.exit(request, text, text);
        printOut(text.str());
    } catch (const CLI::ParseError& error) {
        printError(error.what());
        printLine(stderr, "Run with --help for the commands and their options.");
        return wrong_use;
    }
    return exit_code;
}

}  // namespace

int runProgram(int argc, char** argv, const std::string& name, const std::string& description, AddCommands& add) {
    ignoreBrokenPipes();
    try {
        int exit_code = fine;
        CLI::App app(description, name);
        add(app, exit_code);
        const std::string version_text = "cairn " + std::string(version);
        app.set_version_flag("--version", version_text, "Print the version and exit");
        for (CLI::App* command : app.get_subcommands({})) {
            command->set_version_flag("--version", version_text, "Print the version and exit");
        }
        return parseAndRun(argc, argv, app, exit_code);
    } catch (const ReaderGone&) {
        return run_failed;
    } catch (const InputError& error) {
        printError(error.what());
        return wrong_use;
    } catch (const std::bad_alloc&) {
        printError("out of memory");
    } catch (const std::exception& error) {
        printError(error.what());
    }
    return run_failed;
}

}  // namespace cairn::cli
