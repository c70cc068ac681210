/// @file What a step reports: stages with their times, counters, overlap and energy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cairn {

/// The nine stages of a time step, in order. @source thesis Algorithm 6
enum class Stage { events, positions, detection, batches, correction, velocities, resolution, sleeping, output };

/// Number of stages.
inline constexpr std::size_t stage_count = 9;

/// Names of the stages, as in tables, CSV headers and JSON keys.
inline constexpr std::array<std::string_view, stage_count> stage_names = {
    "events", "positions", "detection", "batches", "correction", "velocities", "resolution", "sleeping", "output"};

/// Counters of one time step, or sums (counters, times) and extremes (overlap) over several.
struct Statistics {
    std::array<double, stage_count> stage_ms{};  ///< wall time per stage [ms]
    std::int64_t contacts = 0;
    std::int64_t penetrating_contacts = 0;  ///< deeper than the penetration threshold
    std::int64_t corrected_contacts = 0;    ///< of these, brought back within the threshold
    std::int64_t uncorrected_contacts = 0;  ///< of these, left because every candidate was invalid
    std::int64_t displaced_bodies = 0;      ///< moves of bodies by the correction
    std::int64_t global_iterations = 0;     ///< contacts resolved by the global resolution
    std::int64_t shock_iterations = 0;      ///< contacts resolved by the shock propagation
    std::int64_t shock_batches = 0;         ///< batches that needed the shock propagation
    std::int64_t batches = 0;
    std::int64_t largest_batch = 0;  ///< contacts of the largest batch
    std::int64_t asleep = 0;         ///< bodies asleep at the end
    std::int64_t woken = 0;          ///< bodies woken
    double largest_overlap = 0;      ///< after the correction [m]
    double mean_overlap = 0;         ///< over the overlapping contacts, after the correction [m]

    /// Adds another step: sums of counters and times, largest of largest_batch and largest_overlap, and the newer
    /// value of asleep and mean_overlap.
    void add(const Statistics& next);
};

}  // namespace cairn
