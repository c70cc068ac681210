/// @file cairn-validate: the physics against closed forms and experiments.
#include "validate/validate.h"

#include <fmt/format.h>

#include <memory>

#include "cli/companions.h"
#include "cli/interrupt.h"
#include "cli/output.h"
#include "cli/program.h"

namespace cairn::cli {

namespace {

struct ValidateArguments {
    std::vector<std::string> only;
    std::string out = "validation";
    std::vector<std::string> tosses;
    bool quick = false;
    bool list = false;
};

void listCases() {
    for (const validation::Case& c : validation::allCases()) {
        printOut(fmt::format("{:<22} {:<18} {}\n", c.name, c.group, c.title));
    }
}

int runValidate(const ValidateArguments& arguments) {
    if (arguments.list) {
        listCases();
        return fine;
    }
    noteInterrupts();
    validation::ValidateOptions options;
    options.out = arguments.out;
    options.only = arguments.only;
    options.tosses.assign(arguments.tosses.begin(), arguments.tosses.end());
    options.extent = arguments.quick ? validation::Extent::quick : validation::Extent::full;
    options.finished = [](const std::string& line) { printOut(line + "\n"); };
    options.interrupted = interrupted;
    try {
        const validation::ValidateOutcome outcome = validation::runValidation(options);
        for (const std::string& missed : outcome.missed) printOut("missed: " + missed + "\n");
        const std::string files = outcome.page.empty() ? outcome.json.string() : outcome.page.string();
        printOut(fmt::format("{} of {} cases passed; written: {}\n", outcome.passed, outcome.cases, files));
        return outcome.missed.empty() ? fine : run_failed;
    } catch (const validation::Interrupted&) {
        printError("interrupted; the cases that were done are in " + arguments.out);
        return run_failed;
    }
}

void addOptions(CLI::App& command, int& exit_code) {
    auto arguments = std::make_shared<ValidateArguments>();
    command.add_option("--only", arguments->only, "Cases or groups by name, renewed in the page; default: all")
        ->delimiter(',');
    command.add_option("--out", arguments->out, "Folder of the page; default: validation")->type_name("DIR");
    command.add_option("--toss", arguments->tosses, "Recorded tosses of a cube for the case 'cube-toss'")
        ->type_name("FILE")
        ->delimiter(',');
    command.add_flag("--quick", arguments->quick, "Coarser and shorter: for a first look");
    command.add_flag("--list", arguments->list, "Name the cases and end");
    command.callback([arguments, &exit_code] { exit_code = runValidate(*arguments); });
}

}  // namespace

}  // namespace cairn::cli

int main(int argc, char** argv) {
    using namespace cairn::cli;
    return runProgram(argc, argv, "cairn validate", std::string(validate_companion.description), addOptions);
}
