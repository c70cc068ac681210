/// @file What the repetitions of a measured scene say together.
#pragma once

#include <string>
#include <vector>

#include "experiment.h"

namespace cairn::thesis {

/// A measured scene: one number per simulation step, times as the median of the repetitions.
struct Series {
    std::vector<double> total_ms;       ///< wall time
    std::vector<double> detection_ms;   ///< of it, contact detection and batch generation
    std::vector<double> response_ms;    ///< of it, correction, velocities, resolution and sleeping
    std::vector<double> iterations;     ///< contacts resolved, shock propagation included
    std::vector<double> contacts;       ///< sum over the time steps
    std::vector<double> largest_batch;  ///< contacts of each time step's largest batch, summed
    std::vector<double> asleep;         ///< bodies asleep at the end of the step
    double total_s = 0;                 ///< of the whole run, the median of the repetitions
    double bodies = 0;
    double threads = 0;
    double lost = 0;         ///< bodies that left the finite numbers
    std::string state_hash;  ///< of the last state
    std::size_t repetitions = 0;

    std::size_t steps() const { return total_ms.size(); }
};

/// @throws std::logic_error if there is no such result or it is not that of a scene
Series seriesOf(const Results& results, const std::string& key);

double sum(const std::vector<double>& values);
double largest(const std::vector<double>& values);
double median(std::vector<double> values);
/// Sum of the first `count`.
double sumOfFirst(const std::vector<double>& values, std::size_t count);

/// The step in which the second run gains most over the first.
struct BestStep {
    double ratio = 0;      ///< first / second
    std::size_t step = 0;  ///< from 1
};
/// @param floor steps in which the first takes less than this part of its largest step do not count: what is short
/// scatters most
BestStep bestStep(const std::vector<double>& first, const std::vector<double>& second, double floor);

}  // namespace cairn::thesis
