/// @file cairn-validate: the physics against closed forms and experiments.
#include "validate/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string_view>

#include "cli/companions.h"
#include "cli/interrupt.h"
#include "cli/output.h"
#include "cli/override_options.h"
#include "cli/program.h"
#include "validate/pile_suite.h"

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
    catchInterrupts();
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

struct PilesArguments {
    std::string part;
    std::string json;
    std::int64_t threads = allCores();
    bool quick = false;
    bool list = false;
};

/// The piles of a part as 2/4, or all. @throws InputError
std::vector<validation::Pile> pilesOf(const PilesArguments& arguments) {
    const std::vector<validation::Pile> piles = arguments.quick ? validation::quickPiles() : validation::pileSuite();
    if (arguments.part.empty()) return piles;
    std::size_t part = 0;
    std::size_t parts = 0;
    const std::string_view text = arguments.part;
    const auto [slash, error] = std::from_chars(text.data(), text.data() + text.size(), part);
    const bool divided = error == std::errc() && slash != text.data() + text.size() && *slash == '/';
    const bool whole = divided && std::from_chars(slash + 1, text.data() + text.size(), parts).ptr == text.end();
    if (!whole) throw InputError(fmt::format("part '{}'; give it as 2/4, the second of four", text));
    return validation::partOf(piles, part, parts);
}

/// The rows of the piles that have ended, in the order of the suite.
nlohmann::ordered_json endedOf(const std::vector<nlohmann::ordered_json>& rows) {
    nlohmann::ordered_json ended = nlohmann::ordered_json::array();
    std::ranges::copy_if(rows, std::back_inserter(ended), [](const auto& row) { return !row.is_null(); });
    return ended;
}

int runPiles(const PilesArguments& arguments) {
    const std::vector<validation::Pile> piles = pilesOf(arguments);
    if (arguments.list) {
        for (const validation::Pile& pile : piles) printOut(validation::nameOf(pile) + "\n");
        return fine;
    }
    // Said before hours of work rather than after.
    if (!arguments.json.empty()) TextFile(arguments.json).write("[]\n");
    catchInterrupts();
    std::vector<nlohmann::ordered_json> rows(piles.size());
    std::size_t ended = 0;
    std::size_t met = 0;
    const auto alive = [] {
        if (interrupted()) throw validation::Interrupted{};
    };
    const auto done = [&](std::size_t i, const validation::PileResult& result) {
        printOut(validation::lineOf(piles[i], result) + "\n");
        rows[i] = validation::rowOf(piles[i], result);
        ++ended;
        met += validation::missedBy(piles[i], result).empty() ? 1 : 0;
        if (!arguments.json.empty()) TextFile(arguments.json).write(endedOf(rows).dump(1) + "\n");
    };
    try {
        validation::runPiles(piles, static_cast<std::size_t>(arguments.threads), alive, done);
    } catch (const validation::Interrupted&) {
        printError(fmt::format("interrupted after {} of {} piles", ended, piles.size()));
        return run_failed;
    }
    printOut(fmt::format("{} of {} piles met all bounds\n", met, piles.size()));
    return met == piles.size() ? fine : run_failed;
}

void addPiles(CLI::App& validate, int& exit_code) {
    CLI::App* command = validate.add_subcommand("piles", "Pour piles of all kinds and judge how they come to rest");
    auto arguments = std::make_shared<PilesArguments>();
    command->add_flag("--list", arguments->list, "Name the piles and end");
    command->add_flag("--quick", arguments->quick, "24 small ones");
    command->add_option("--part", arguments->part, "The I-th of N parts, for several machines")->type_name("I/N");
    command->add_option("--json", arguments->json, "Write a row per pile")->type_name("FILE");
    command->add_option("--threads", arguments->threads, "Piles side by side, a thread each; default: all cores")
        ->check(CLI::Range(std::int64_t{1}, most_threads));
    command->callback([arguments, &exit_code] { exit_code = runPiles(*arguments); });
}

void addOptions(CLI::App& command, int& exit_code) {
    addPiles(command, exit_code);
    auto arguments = std::make_shared<ValidateArguments>();
    command.add_option("--only", arguments->only, "Cases or groups by name, renewed in the page; default: all")
        ->delimiter(',');
    command.add_option("--out", arguments->out, "Folder of the page; default: validation")->type_name("DIR");
    command.add_option("--toss", arguments->tosses, "Recorded tosses of a cube for the case 'cube-toss'")
        ->type_name("FILE")
        ->delimiter(',');
    command.add_flag("--quick", arguments->quick, "Coarser and shorter: for a first look");
    command.add_flag("--list", arguments->list, "Name the cases and end");
    command.callback([&command, arguments, &exit_code] {
        if (command.get_subcommands().empty()) exit_code = runValidate(*arguments);
    });
}

}  // namespace

}  // namespace cairn::cli

int main(int argc, char** argv) {
    using namespace cairn::cli;
    return runProgram(argc, argv, "cairn validate", std::string(validate_companion.description), addOptions);
}
