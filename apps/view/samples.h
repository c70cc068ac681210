/// @file The numbers of one simulation step, for the charts.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "cairn/statistics.h"
#include "wire.h"

namespace cairn::view {

/// One simulation step of 1/30 s.
struct Sample {
    double time = 0;  ///< at its end [s]
    Statistics statistics;
    double kinetic_energy = 0;    ///< [J]
    double potential_energy = 0;  ///< [J]
};

/// Names of the numbers of a sample, in their order.
nlohmann::json sampleFields();
/// The numbers of a sample, appended in that order.
void appendSample(const Sample& sample, std::vector<double>& values);
/// The message with some samples.
SharedMessage makeSampleMessage(const std::vector<Sample>& samples);

}  // namespace cairn::view
