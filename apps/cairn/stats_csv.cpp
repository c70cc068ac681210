#include "stats_csv.h"

#include <fmt/format.h>

#include <array>
#include <iterator>

namespace cairn::cli {

namespace {

struct Counter {
    std::string_view name;
    std::int64_t Statistics::*member;
};

constexpr std::array<Counter, 12> counters = {{
    {"contacts", &Statistics::contacts},
    {"penetrating_contacts", &Statistics::penetrating_contacts},
    {"corrected_contacts", &Statistics::corrected_contacts},
    {"uncorrected_contacts", &Statistics::uncorrected_contacts},
    {"displaced_bodies", &Statistics::displaced_bodies},
    {"global_iterations", &Statistics::global_iterations},
    {"shock_iterations", &Statistics::shock_iterations},
    {"shock_batches", &Statistics::shock_batches},
    {"batches", &Statistics::batches},
    {"largest_batch", &Statistics::largest_batch},
    {"asleep", &Statistics::asleep},
    {"woken", &Statistics::woken},
}};

std::string header(const Settings& settings) {
    std::string text = "step,time,ms";
    for (const std::string_view stage : stage_names) text += fmt::format(",{}_ms", stage);
    for (const Counter& counter : counters) text += fmt::format(",{}", counter.name);
    text += ",largest_overlap_m,mean_overlap_m,kinetic_energy_J,potential_energy_J";
    if (settings.diagnostics.diagnostics) {
        for (const DiagnosticsField& field : diagnosticsFields()) text += fmt::format(",{}", field.name);
    }
    return text + "\n";
}

}  // namespace

StatsCsv::StatsCsv(const std::filesystem::path& file, const Settings& settings) : file_(file) {
    file_.write(header(settings));
}

void StatsCsv::add(const World& world, double ms, const Statistics& step, const WorldSums& sums) {
    std::string text = fmt::format("{},{},{}", ++rows_, world.time(), ms);
    const auto out = std::back_inserter(text);
    for (const double stage : step.stage_ms) fmt::format_to(out, ",{}", stage);
    for (const Counter& counter : counters) fmt::format_to(out, ",{}", step.*counter.member);
    fmt::format_to(out, ",{},{},{},{}", step.largest_overlap, step.mean_overlap, sums.kinetic_energy,
                   sums.potential_energy);
    if (world.settings().diagnostics.diagnostics) {
        Diagnostics diagnostics = step.diagnostics;
        for (const DiagnosticsField& field : diagnosticsFields()) fmt::format_to(out, ",{}", field.of(diagnostics));
    }
    text += '\n';
    file_.write(text);
}

}  // namespace cairn::cli
