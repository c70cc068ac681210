#include "bench/kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <utility>

#include "kernel.h"

namespace cairn::kernels {

namespace {

constexpr double quick_seconds = 1e-3;

/// Keeps the runs instead of printing them.
class Collector final : public benchmark::BenchmarkReporter {
  public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override { runs_.insert(runs_.end(), runs.begin(), runs.end()); }
    const std::vector<Run>& runs() const { return runs_; }

  private:
    std::vector<Run> runs_;
};

/// One repetition of a kernel.
struct Sample {
    double item_ns = 0;
    double gigabytes = 0;  ///< per second; 0 = not counted
};

Sample measure(const Kernel& kernel, double seconds) {
    const Pass pass = kernel.make();
    benchmark::ClearRegisteredBenchmarks();
    benchmark::RegisterBenchmark(kernel.name.c_str(),
                                 [&pass](benchmark::State& state) {
                                     for ([[maybe_unused]] auto round : state) {
                                         pass.prepare();
                                         const bench::Stopwatch stopwatch;
                                         pass.run();
                                         state.SetIterationTime(1e-3 * stopwatch.read().processor_ms);
                                     }
                                 })
        ->UseManualTime()
        ->Unit(benchmark::kNanosecond)
        ->MinTime(seconds);
    Collector collector;
    benchmark::RunSpecifiedBenchmarks(&collector, "all");
    benchmark::ClearRegisteredBenchmarks();
    const double pass_ns = collector.runs().back().GetAdjustedRealTime();
    return {pass_ns / static_cast<double>(pass.items), static_cast<double>(pass.bytes) / pass_ns};
}

std::vector<Kernel> chosenKernels(const std::string& filter) {
    std::vector<Kernel> all;
    for (const auto kernels :
         {limitKernels, resolutionKernels, correctionKernels, narrowPhaseKernels, broadPhaseKernels}) {
        for (Kernel& kernel : kernels()) all.push_back(std::move(kernel));
    }
    std::vector<Kernel> chosen;
    try {
        const std::regex pattern(filter);
        std::copy_if(all.begin(), all.end(), std::back_inserter(chosen),
                     [&](const Kernel& kernel) { return std::regex_search(kernel.name, pattern); });
    } catch (const std::regex_error& error) {
        throw InputError(
            fmt::format("--filter is given '{}', which is not a regular expression: {}", filter, error.what()));
    }
    if (chosen.empty()) {
        std::string names;
        for (const Kernel& kernel : all) names += "\n  " + kernel.name;
        throw InputError(fmt::format("--filter is given '{}', which matches no kernel; they are{}", filter, names));
    }
    return chosen;
}

std::string rowOf(const bench::Json& entry) {
    const bench::Json& values = entry.at("values");
    std::string row = fmt::format("{:<44} {:>10.2f} {:<10}", entry.at("name").get<std::string>(),
                                  values.at("item_ns").get<double>(), entry.at("item").get<std::string>());
    if (values.contains("gigabytes_per_s")) {
        row += fmt::format(" {:>8.2f}", values.at("gigabytes_per_s").get<double>());
    }
    return row + '\n';
}

}  // namespace

}  // namespace cairn::kernels

namespace cairn::bench {

Outcome runKernels(const KernelsOptions& options) {
    const std::vector<kernels::Kernel> chosen = kernels::chosenKernels(options.filter);
    const bool quick = options.extent == Extent::quick;
    const std::size_t repetitions = quick ? 1 : options.repetitions;
    const double seconds = quick ? kernels::quick_seconds : options.seconds;
    std::vector<std::vector<double>> item_ns(chosen.size());
    std::vector<std::vector<double>> gigabytes(chosen.size());
    for (std::size_t repetition = 0; repetition < repetitions; ++repetition) {
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            options.progress(
                static_cast<double>(repetition * chosen.size() + i) / static_cast<double>(repetitions * chosen.size()),
                fmt::format("{} ({} of {})", chosen[i].name, repetition + 1, repetitions));
            const kernels::Sample sample = kernels::measure(chosen[i], seconds);
            item_ns[i].push_back(sample.item_ns);
            gigabytes[i].push_back(sample.gigabytes);
        }
    }
    Outcome outcome;
    outcome.json = originOf("kernels", options.extent);
    outcome.json["repetitions"] = repetitions;
    outcome.json["entries"] = Json::array();
    outcome.table = fmt::format("processor time, medians of {} runs\n\n{:<44} {:>10} {:<10} {:>8}\n", repetitions,
                                "kernel", "ns", "per", "GB/s");
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        Json entry = {
            {"name", chosen[i].name}, {"item", chosen[i].item}, {"values", {{"item_ns", median(item_ns[i])}}}};
        const double rate = median(gigabytes[i]);
        if (rate > 0) entry["values"]["gigabytes_per_s"] = rate;
        outcome.table += kernels::rowOf(entry);
        outcome.json["entries"].push_back(std::move(entry));
    }
    return outcome;
}

}  // namespace cairn::bench
