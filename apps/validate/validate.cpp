#include "validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "bench_thesis/machine.h"
#include "bench_thesis/store.h"
#include "cairn/version.h"
#include "markdown.h"
#include "page.h"

namespace cairn::validation {

namespace {

/// Of validation.json; reports of other formats are not added to.
constexpr int format = 1;

bool isSelected(const Case& c, const std::vector<std::string>& only) {
    return only.empty() ||
           std::any_of(only.begin(), only.end(), [&](const auto& name) { return name == c.name || name == c.group; });
}

void refuseUnknownNames(const std::vector<std::string>& only) {
    for (const std::string& name : only) {
        const auto has = [&](const Case& c) { return c.name == name || c.group == name; };
        if (std::ranges::any_of(allCases(), has)) continue;
        std::string known;
        for (const Case& c : allCases()) known += (known.empty() ? "" : ", ") + std::string(c.name);
        throw InputError(fmt::format("--only is given '{}'; the cases are {}", name, known));
    }
}

std::string textOf(const Case& c, const Quantity& q) {
    const std::string limit = q.rule == Rule::at_least ? fmt::format("at least {:.4g}", q.allowed)
                              : q.rule == Rule::at_most
                                  ? fmt::format("at most {:.4g}", q.allowed)
                                  : fmt::format("{:.6g} within {:.2g}{}", q.expected.value_or(0), q.allowed,
                                                q.rule == Rule::relative ? " of it" : "");
    const std::string unit = q.unit.empty() ? "" : " " + q.unit;
    return fmt::format("{}: {}{}: {:.6g}{} instead of {}", c.name, q.what, q.setup.empty() ? "" : " (" + q.setup + ")",
                       q.measured, unit, limit);
}

const char* nameOf(Extent extent) {
    return extent == Extent::full ? "full" : "quick";
}

Json head(Extent extent) {
    const thesis::Machine machine = thesis::thisMachine({});
    return {{"format", format},
            {"version", cairn::version},
            {"extent", nameOf(extent)},
            {"machine",
             {{"processor", machine.processor},
              {"cores", machine.cores},
              {"system", machine.system},
              {"compiler", machine.compiler}}},
            {"cases", Json::array()}};
}

/// The cases by their place in allCases(); null = not measured.
using Cases = std::vector<Json>;

/// What an earlier run of the same extent left in the folder, so that a run of single cases renews a whole page.
/// @throws IoError if there is a file that is no report
Cases storedCases(const ValidateOptions& options) {
    Cases cases(allCases().size());
    const std::filesystem::path file = options.out / "validation.json";
    if (options.out.empty() || options.only.empty() || !std::filesystem::exists(file)) return cases;
    try {
        const Json report = Json::parse(thesis::readWhole(file));
        if (report.at("format") != format || report.at("extent") != nameOf(options.extent)) return cases;
        for (const Json& stored : report.at("cases")) {
            const auto same = [&](const Case& c) { return stored.at("name") == c.name; };
            const auto found = std::ranges::find_if(allCases(), same);
            if (found != allCases().end()) cases[static_cast<std::size_t>(found - allCases().begin())] = stored;
        }
    } catch (const Json::exception& error) {
        throw IoError(fmt::format("{}: is no report of a validation ({}); remove it or give another folder with --out",
                                  file.string(), error.what()));
    }
    return cases;
}

Json measure(const Case& c, const ValidateOptions& options, const std::vector<Toss>& tosses, ValidateOutcome& outcome) {
    options.began(std::string(c.name));
    Plan plan{options.extent, tosses};
    plan.alive = [&] {
        if (options.interrupted()) throw Interrupted{};
    };
    plan.alive();
    const auto begin = std::chrono::steady_clock::now();
    const Result result = c.run(plan);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    std::size_t judged = 0;
    std::size_t met = 0;
    for (const Quantity& q : result.quantities) {
        if (q.rule == Rule::shown) continue;
        ++judged;
        if (q.passed()) ++met;
        if (!q.passed()) outcome.missed.push_back(textOf(c, q));
    }
    ++outcome.cases;
    if (result.passed()) ++outcome.passed;
    Json json = {{"name", c.name},     {"group", c.group}, {"title", c.title},
                 {"source", c.source}, {"setup", c.setup}, {"seconds", spent.count()}};
    json.update(toJson(result));
    options.finished(fmt::format("{:<22} {:>6}  {:>3} of {:>3} targets met  {:>8.1f} s", c.name,
                                 result.passed() ? "passed" : "MISSED", met, judged, spent.count()));
    return json;
}

void write(const ValidateOptions& options, ValidateOutcome& outcome) {
    const std::filesystem::path pages = options.out / "validation";
    std::error_code error;
    std::filesystem::create_directories(pages, error);
    if (error) throw IoError(fmt::format("{}: cannot be made: {}", pages.string(), error.message()));
    outcome.json = options.out / "validation.json";
    thesis::writeWhole(outcome.json, outcome.report.dump(1) + "\n");
    thesis::writeWhole(options.out / "validation.md", overviewMarkdown(outcome.report));
    for (const Json& c : outcome.report.at("cases")) {
        thesis::writeWhole(pages / (c.at("name").get<std::string>() + ".md"), caseMarkdown(c));
    }
    if (const auto page = makePage(outcome.report)) {
        outcome.page = options.out / "index.html";
        thesis::writeWhole(outcome.page, *page);
    }
}

}  // namespace

ValidateOutcome runValidation(const ValidateOptions& options) {
    refuseUnknownNames(options.only);
    // Files that cannot be read are told before hours of other cases.
    std::vector<Toss> tosses;
    for (const auto& file : options.tosses) tosses.push_back(readToss(file));
    ValidateOutcome outcome;
    outcome.report = head(options.extent);
    Cases cases = storedCases(options);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (!isSelected(allCases()[i], options.only)) continue;
        cases[i] = measure(allCases()[i], options, tosses, outcome);
        outcome.report["cases"] = Json::array();
        std::ranges::copy_if(cases, std::back_inserter(outcome.report["cases"]),
                             [](const Json& c) { return !c.is_null(); });
        // After every case, so that an interrupted run leaves what it found.
        if (!options.out.empty()) write(options, outcome);
    }
    return outcome;
}

}  // namespace cairn::validation
