#include "validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench_thesis/machine.h"
#include "bench_thesis/store.h"
#include "cairn/version.h"
#include "markdown.h"
#include "page.h"

namespace cairn::validation {

namespace {

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

Json head(Extent extent) {
    const thesis::Machine machine = thesis::thisMachine({});
    return {{"version", cairn::version},
            {"extent", extent == Extent::full ? "full" : "quick"},
            {"machine",
             {{"processor", machine.processor},
              {"cores", machine.cores},
              {"system", machine.system},
              {"compiler", machine.compiler}}},
            {"cases", Json::array()}};
}

void measure(const Case& c, const ValidateOptions& options, const std::vector<Toss>& tosses, ValidateOutcome& outcome) {
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
    outcome.report["cases"].push_back(std::move(json));
    options.finished(fmt::format("{:<22} {:>6}  {:>3} of {:>3} targets met  {:>8.1f} s", c.name,
                                 result.passed() ? "passed" : "MISSED", met, judged, spent.count()));
}

void write(const ValidateOptions& options, ValidateOutcome& outcome) {
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (error) throw IoError(fmt::format("{}: cannot be made: {}", options.out.string(), error.message()));
    outcome.json = options.out / "validation.json";
    thesis::writeWhole(outcome.json, outcome.report.dump(1) + "\n");
    thesis::writeWhole(options.out / "validation.md", toMarkdown(outcome.report));
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
    for (const Case& c : allCases()) {
        if (!isSelected(c, options.only)) continue;
        measure(c, options, tosses, outcome);
        // After every case, so that an interrupted run leaves what it found.
        if (!options.out.empty()) write(options, outcome);
    }
    return outcome;
}

}  // namespace cairn::validation
