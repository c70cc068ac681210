/// @file What a run is measured by, step by step.
#pragma once

#include <vector>

#include "cairn/statistics.h"

namespace cairn::cli {

/// Collected over the simulation steps of a run.
struct Measurements {
    std::vector<double> step_ms;  ///< wall time of each simulation step, without recording [ms]
    Statistics total;             ///< sums over the run
    Statistics last;              ///< of the last simulation step
    double largest_overlap = 0;   ///< of the run [m]
    double sum_mean_overlap = 0;  ///< of the mean overlaps of the frames [m]

    /// @param ms wall time of a step that simulates so many times 1/30 s: more than one where time steps are longer
    void add(double ms, std::size_t times, const Statistics& step);
};

}  // namespace cairn::cli
