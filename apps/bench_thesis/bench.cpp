#include "bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <set>

#include "cairn/version.h"
#include "machine.h"
#include "page.h"
#include "pictures.h"
#include "section.h"
#include "store.h"

namespace cairn::thesis {

namespace {

constexpr std::size_t most_repetitions = 5;
constexpr double enough_ms = 60'000;  ///< after which an experiment is not repeated

constexpr const char* engine =
#include "engine_hash.inc"
    ;

const char* nameOf(Extent extent) {
    return extent == Extent::full ? "full" : "quick";
}

Json originOf(const Machine& machine, Extent extent) {
    return {{"engine", engine},       {"extent", nameOf(extent)}, {"processor", machine.processor},
            {"cores", machine.cores}, {"system", machine.system}, {"compiler", machine.compiler}};
}

bool isSelected(const Section& section, const std::vector<std::string>& only) {
    return only.empty() || std::find(only.begin(), only.end(), section.id) != only.end();
}

void refuseUnknownSections(const std::vector<Section>& sections, const std::vector<std::string>& only) {
    std::string known;
    for (const Section& section : sections) known += (known.empty() ? "" : ", ") + section.id;
    for (const std::string& id : only) {
        const auto is = [&](const Section& section) { return section.id == id; };
        if (std::none_of(sections.begin(), sections.end(), is)) {
            throw InputError(
                fmt::format("--only is given '{}'; the sections of the thesis's benchmarks are {}", id, known));
        }
    }
}

/// Measures everything that is missing. The repetitions of an experiment do not follow each other, so that a
/// disturbance does not hit all of them, and runs that are compared are close together.
class Measuring {
  public:
    Measuring(Store& store, const BenchOptions& options) : store_(store), options_(options) {}

    void add(const Section& section) {
        for (const Experiment& experiment : section.experiments) {
            if (keys_.insert(experiment.key).second) experiments_.push_back(experiment);
        }
    }

    void run() {
        for (const Experiment& experiment : experiments_)
            total_ += experiment.weight * static_cast<double>(rounds(experiment));
        for (std::size_t round = 0; round < most_repetitions; ++round) {
            for (const Experiment& experiment : experiments_) {
                if (round >= rounds(experiment)) continue;
                if (store_.repetitions(experiment) == round && isWorthIt(experiment)) measure(experiment, round);
                done_ += experiment.weight;
            }
        }
    }

  private:
    std::size_t rounds(const Experiment& experiment) const {
        return experiment.timed && options_.extent == Extent::full ? most_repetitions : 1;
    }
    bool isWorthIt(const Experiment& experiment) const {
        return store_.repetitions(experiment) == 0 || store_.spent(experiment) < enough_ms;
    }

    void measure(const Experiment& experiment, std::size_t round) {
        Surroundings surroundings;
        if (round == 0) surroundings.recording = recordingOf(options_.out, experiment.key);
        const std::string what = rounds(experiment) == 1
                                     ? experiment.key
                                     : fmt::format("{} ({} of {})", experiment.key, round + 1, rounds(experiment));
        surroundings.progress = [&](double part) {
            options_.progress({(done_ + part * experiment.weight) / total_, what});
            if (options_.interrupted()) throw Interrupted{};
        };
        surroundings.progress(0);
        const auto begin = std::chrono::steady_clock::now();
        const Json value = experiment.run(surroundings);
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
        store_.add(experiment, value, spent.count());
    }

    Store& store_;
    const BenchOptions& options_;
    std::vector<Experiment> experiments_;
    std::set<std::string> keys_;
    double total_ = 0;
    double done_ = 0;
};

bool isMeasured(const Section& section, const Store& store) {
    return std::all_of(section.experiments.begin(), section.experiments.end(),
                       [&](const Experiment& experiment) { return store.repetitions(experiment) > 0; });
}

std::string numberText(const Json& value) {
    return value.is_null() ? "-" : fmt::format("{:.4g}", value.get<double>());
}

std::string summaryOf(const Json& section) {
    std::string text =
        fmt::format("§{} {}\n", section.at("id").get<std::string>(), section.at("title").get<std::string>());
    text += fmt::format("  {:<64} {:>10} {:>10} {:>9}\n", "", "thesis", "ours", "differs");
    for (const Json& entry : section.at("entries")) {
        const Json& difference = entry.at("difference_percent");
        const std::string unit = entry.at("unit").get<std::string>();
        const std::string differs = entry.at("shortened").get<bool>() ? "shortened"
                                    : difference.is_null()            ? ""
                                                           : fmt::format("{:+.0f} %", difference.get<double>());
        text += fmt::format("  {:<64} {:>10} {:>10} {:>9}\n",
                            entry.at("what").get<std::string>() + (unit.empty() ? "" : " [" + unit + "]"),
                            numberText(entry.at("thesis")), numberText(entry.at("ours")), differs);
    }
    for (const Json& goal : section.at("goals")) {
        text += fmt::format("  aim {}: {}\n", goal.at("reached").get<bool>() ? "reached" : "missed",
                            goal.at("what").get<std::string>());
    }
    return text;
}

/// The day of the report, in UTC.
std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    return fmt::format("{:04}-{:02}-{:02}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday);
}

Json reportHead(const Machine& machine, Extent extent) {
    return {{"extent", nameOf(extent)},
            {"version", version},
            {"date", today()},
            {"machine",
             {{"processor", machine.processor},
              {"cores", machine.cores},
              {"system", machine.system},
              {"compiler", machine.compiler},
              {"rating", machine.rating ? Json(*machine.rating) : Json(nullptr)},
              {"rating_source", machine.rating_source},
              {"rating_e6400", rating_e6400},
              {"rating_i7_940", rating_i7_940}}},
            {"sections", Json::array()},
            {"warnings", Json::array()}};
}

/// What is broken in a section: its checks, entries without a number, differences that nobody explains.
std::vector<std::string> brokenIn(const Section& section, const SectionResult& result, Extent extent) {
    std::vector<std::string> broken;
    for (const Check& check : result.checks) {
        if (!check.holds) broken.push_back(fmt::format("§{}: does not hold: {}", section.id, check.what));
    }
    for (const Entry& entry : result.entries) {
        if (entry.thesis && !entry.ours) broken.push_back(fmt::format("§{}: no value for {}", section.id, entry.what));
        const auto difference = differenceOf(entry);
        const bool owes = extent == Extent::full && difference && std::abs(*difference) > explained_difference;
        if (owes && explanationOf(entry).empty()) {
            broken.push_back(fmt::format("{} differs by {:.0f} % without an explanation", entry.id, 100 * *difference));
        }
    }
    return broken;
}

}  // namespace

BenchOutcome runBench(const BenchOptions& options) {
    const Machine machine = thisMachine(options.rating);
    const Plan plan{options.extent, machine.cores, machine.rating};
    const std::vector<Section> sections = allSections(plan);
    refuseUnknownSections(sections, options.only);
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (error) throw IoError(fmt::format("{}: cannot be made: {}", options.out.string(), error.message()));
    Store store(options.out / "results.json", originOf(machine, options.extent));

    Measuring measuring(store, options);
    for (const Section& section : sections) {
        if (isSelected(section, options.only)) measuring.add(section);
    }
    measuring.run();

    BenchOutcome outcome;
    outcome.results = options.out / "results.json";
    Json report = reportHead(machine, options.extent);
    Pictures pictures(options);
    for (const Section& section : sections) {
        if (!isMeasured(section, store)) continue;
        const SectionResult result = section.evaluate(store.results());
        Json json = toJson(section, result);
        for (Json& row : json["pictures"]) row["files"] = pictures.draw(row.at("key"), row.at("camera"));
        for (std::string& text : brokenIn(section, result, options.extent)) outcome.broken.push_back(std::move(text));
        if (isSelected(section, options.only)) outcome.summary += summaryOf(json);
        report["sections"].push_back(std::move(json));
    }
    outcome.warnings = pictures.warnings();
    report["warnings"] = outcome.warnings;
    store.setReport(report);
    if (const auto page = makePage(report, options.out)) {
        outcome.page = options.out / "index.html";
        writeWhole(outcome.page, *page);
    }
    return outcome;
}

}  // namespace cairn::thesis
