/// @file The report at the end of a run, as a table and as JSON; docs/cli.md says what each value means.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "cairn/scene.h"
#include "measurements.h"
#include "together.h"

namespace cairn::cli {

struct Report {
    std::string scene;
    std::size_t bodies = 0;                                          ///< of the scene, fixed ones as well
    std::int64_t threads = 0;                                        ///< that a step may use
    std::size_t steps = 0;                                           ///< simulation steps
    double steps_per_second = 0;                                     ///< time steps, at the end [1/s]
    double seconds = 0;                                              ///< simulated [s]
    double wall_seconds = 0;                                         ///< of the simulation steps, without recording [s]
    double average_ms = 0, median_ms = 0, p99_ms = 0, worst_ms = 0;  ///< per simulation step
    bool real_time = false;  ///< the worst step took no longer than it simulates
    Statistics total;        ///< sums over the run
    double largest_overlap_mm = 0, mean_overlap_mm = 0, last_overlap_mm = 0;
    double kinetic_energy = 0, potential_energy = 0;  ///< at the end [J]
    std::int64_t asleep = 0;                          ///< at the end
    std::size_t lost = 0;                             ///< see countLost()
    std::uint64_t state_hash = 0;                     ///< at the end
    std::optional<RanksReport> ranks;                 ///< of a run that ranks shared
};

/// Dynamic bodies of this rank that were fixed by a fault, or whose centre is inside a fixed half-space at the end.
std::size_t countLost(const SceneRun& run);

/// @param sums of the whole world @pre the number of lost bodies is filled in afterwards
Report makeReport(const SceneRun& run, const Measurements& measurements, const WorldSums& sums);
std::string formatTable(const Report& report);
nlohmann::ordered_json toJson(const Report& report);

}  // namespace cairn::cli
