#include "report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>

namespace cairn::cli {

namespace {

constexpr double ms_per_simulation_step = 1000 / simulation_steps_per_second;

/// The smallest value that at least that part of the values do not exceed. @param sorted ascending, not empty
double quantile(const std::vector<double>& sorted, double part) {
    const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(sorted.size())));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

bool isBehind(const Pose& pose, const HalfSpace& half_space, const Vec3& p_W) {
    return half_space.normal.normalized().dot(pose.toInner(p_W)) < half_space.offset;
}

std::string row(std::string_view name, std::string_view value) {
    return fmt::format("  {:<26}{}\n", name, value);
}

std::string formatStages(const Report& report) {
    const double sum = std::accumulate(report.total.stage_ms.begin(), report.total.stage_ms.end(), 0.0);
    std::string text = fmt::format("\n  {:<26}{:>10}  {:>5}\n", "stage", "total ms", "part");
    for (std::size_t i = 0; i < stage_count; ++i) {
        const double ms = report.total.stage_ms[i];
        text += fmt::format("  {:<26}{:>10.1f}  {:>4.1f} %\n", stage_names[i], ms, sum > 0 ? 100 * ms / sum : 0);
    }
    return text + '\n';
}

}  // namespace

void Measurements::add(double ms, std::size_t times, const Statistics& step) {
    step_ms.insert(step_ms.end(), times, ms / static_cast<double>(times));
    total.add(step);
    last = step;
    largest_overlap = std::max(largest_overlap, step.largest_overlap);
    sum_mean_overlap += static_cast<double>(times) * step.mean_overlap;
}

std::size_t countLost(const SceneRun& run) {
    const World& world = run.world();
    std::vector<BodyId> planes;
    for (const BodyId id : run.ids()) {
        if (world.contains(id) && std::holds_alternative<HalfSpace>(world.shape(id))) planes.push_back(id);
    }
    std::size_t lost = 0;
    for (const BodyId id : run.ids()) {
        if (!world.isOwn(id)) continue;
        // The origin of a shape's frame may lie outside of the shape.
        const Vec3 p_W = world.centreOfMass(id);
        const auto isHere = [&](BodyId plane) {
            return isBehind(world.pose(plane), std::get<HalfSpace>(world.shape(plane)), p_W);
        };
        const bool faulty = std::ranges::find(world.faults(), id, &FaultInfo::body) != world.faults().end();
        if (faulty || (!world.isFixed(id) && std::ranges::any_of(planes, isHere))) ++lost;
    }
    return lost;
}

Report makeReport(const SceneRun& run, const Measurements& measurements, const WorldSums& sums) {
    const World& world = run.world();
    Report report;
    report.scene = run.scene().name;
    report.bodies = run.ids().size();
    report.threads = world.settings().parallel.threads;
    report.steps = measurements.step_ms.size();
    report.steps_per_second = world.settings().steps_per_second;
    report.seconds = world.time();
    if (!measurements.step_ms.empty()) {
        std::vector<double> sorted = measurements.step_ms;
        std::sort(sorted.begin(), sorted.end());
        const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
        const auto steps = static_cast<double>(sorted.size());
        report.wall_seconds = sum / 1000;
        report.average_ms = sum / steps;
        report.median_ms = quantile(sorted, 0.5);
        report.p99_ms = quantile(sorted, 0.99);
        report.worst_ms = sorted.back();
        report.mean_overlap_mm = 1000 * measurements.sum_mean_overlap / steps;
    }
    report.real_time = report.worst_ms <= ms_per_simulation_step;
    report.total = measurements.total;
    report.largest_overlap_mm = 1000 * measurements.largest_overlap;
    report.last_overlap_mm = 1000 * measurements.last.largest_overlap;
    report.kinetic_energy = sums.kinetic_energy;
    report.potential_energy = sums.potential_energy;
    report.asleep = sums.asleep;
    report.state_hash = sums.state_hash;
    return report;
}

namespace {

std::string formatRanks(const RanksReport& ranks) {
    const double count = ranks.count;
    return row("ranks", fmt::format("{}; waiting {:.3f} s on average, the slowest {:.3f} s", ranks.count,
                                    ranks.sum.waiting / count, ranks.least_waiting)) +
           row("messages", fmt::format("{} in {} rounds, {:.3f} MB", ranks.sum.messages, ranks.sum.rounds,
                                       1e-6 * static_cast<double>(ranks.sum.bytes)));
}

nlohmann::ordered_json toJson(const RanksReport& ranks) {
    return {
        {"count", ranks.count},
        {"rounds", ranks.sum.rounds},
        {"messages", ranks.sum.messages},
        {"bytes", ranks.sum.bytes},
        {"waiting_s",
         {{"mean", ranks.sum.waiting / ranks.count}, {"least", ranks.least_waiting}, {"most", ranks.most_waiting}}}};
}

}  // namespace

std::string formatTable(const Report& report) {
    const Statistics& total = report.total;
    std::string text = fmt::format("{}: {} bodies, {} {}\n", report.scene, report.bodies, report.threads,
                                   report.threads == 1 ? "thread" : "threads");
    text += row("simulated", fmt::format("{:.4g} s in {} simulation steps", report.seconds, report.steps));
    text += row("time steps", fmt::format("{:g} per second", report.steps_per_second));
    text += row("total time", fmt::format("{:.3f} s", report.wall_seconds));
    text +=
        row("ms per simulation step", fmt::format("average {:.2f}, median {:.2f}, 99 % {:.2f}, worst {:.2f}",
                                                  report.average_ms, report.median_ms, report.p99_ms, report.worst_ms));
    text += row("real time", fmt::format("{} (worst step {:.2f} ms of {:.2f} ms)", report.real_time ? "yes" : "no",
                                         report.worst_ms, ms_per_simulation_step));
    text += formatStages(report);
    text += row("contacts", fmt::format("{}", total.contacts));
    text += row("iterations", fmt::format("{} global, {} shock", total.global_iterations, total.shock_iterations));
    text += row("corrected contacts", fmt::format("{}", total.corrected_contacts));
    text += row("displaced bodies", fmt::format("{}", total.displaced_bodies));
    text += row("overlap", fmt::format("largest {:.3f} mm, mean {:.3f} mm, in the last frame {:.3f} mm",
                                       report.largest_overlap_mm, report.mean_overlap_mm, report.last_overlap_mm));
    text += row("energy",
                fmt::format("{:.6g} J kinetic, {:.6g} J potential", report.kinetic_energy, report.potential_energy));
    text += row("bodies asleep", fmt::format("{}", report.asleep));
    text += row("bodies lost", fmt::format("{}", report.lost));
    if (report.ranks) text += formatRanks(*report.ranks);
    text += row("state hash", fmt::format("{:016x}", report.state_hash));
    return text;
}

nlohmann::ordered_json toJson(const Report& report) {
    nlohmann::ordered_json stages = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < stage_count; ++i) stages[std::string(stage_names[i])] = report.total.stage_ms[i];
    nlohmann::ordered_json json = {
        {"scene", report.scene},
        {"bodies", report.bodies},
        {"threads", report.threads},
        {"steps", report.steps},
        {"steps_per_second", report.steps_per_second},
        {"seconds", report.seconds},
        {"wall_seconds", report.wall_seconds},
        {"ms_per_simulation_step",
         {{"average", report.average_ms},
          {"median", report.median_ms},
          {"p99", report.p99_ms},
          {"worst", report.worst_ms}}},
        {"real_time", report.real_time},
        {"stages_ms", stages},
        {"contacts", report.total.contacts},
        {"iterations", {{"global", report.total.global_iterations}, {"shock", report.total.shock_iterations}}},
        {"corrected_contacts", report.total.corrected_contacts},
        {"displaced_bodies", report.total.displaced_bodies},
        {"overlap_mm",
         {{"largest", report.largest_overlap_mm}, {"mean", report.mean_overlap_mm}, {"last", report.last_overlap_mm}}},
        {"energy_J", {{"kinetic", report.kinetic_energy}, {"potential", report.potential_energy}}},
        {"asleep", report.asleep},
        {"lost", report.lost},
        {"state_hash", fmt::format("{:016x}", report.state_hash)},
    };
    if (report.ranks) json["ranks"] = toJson(*report.ranks);
    return json;
}

}  // namespace cairn::cli
