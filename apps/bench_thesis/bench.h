/// @file The thesis's benchmarks from one call. @source thesis §5
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cairn/recording.h"
#include "experiment.h"

namespace cairn::thesis {

/// Where a bench is.
struct Position {
    double part = 0;   ///< of all work, 0 to 1
    std::string what;  ///< the measurement that runs
};

/// A picture to draw.
struct Picture {
    std::filesystem::path recording;
    double time = 0;             ///< in the recording [s]
    std::vector<double> camera;  ///< position and the point looked at [m]; empty = everything is seen
    std::filesystem::path file;  ///< PNG
};

/// How a bench is run.
struct BenchOptions {
    std::filesystem::path out;      ///< folder; made if it does not exist
    std::vector<std::string> only;  ///< sections such as "5.3"; empty = all
    Extent extent = Extent::full;
    std::optional<double> rating;  ///< PassMark single-thread rating of this processor
    std::function<void(const Position&)> progress = [](const Position&) {};
    std::function<bool()> interrupted = [] { return false; };
    std::function<void(const Picture&)> picture = {};  ///< or throws IoError; none = no pictures
};

/// What came out.
struct BenchOutcome {
    std::filesystem::path results;      ///< results.json
    std::filesystem::path page;         ///< index.html; empty if the page was not built in
    std::string summary;                ///< a table for the terminal
    std::vector<std::string> broken;    ///< checks that do not hold
    std::vector<std::string> warnings;  ///< such as pictures that could not be drawn
};

/// Measures what is missing and writes results.json and index.html. Whatever was measured before by the same engine on
/// the same machine is kept. @throws InputError for an unknown section, IoError, Interrupted
BenchOutcome runBench(const BenchOptions& options);

}  // namespace cairn::thesis
