/// @file The statistics of a run as a CSV file.
#pragma once

#include "cairn/scene.h"
#include "cli/output.h"

namespace cairn::cli {

/// One row per simulation step, written as the run goes on. @source docs/cli.md names the columns
class StatsCsv {
  public:
    /// @param settings whose diagnostics add columns @throws IoError
    StatsCsv(const std::filesystem::path& file, const Settings& settings);
    /// @param ms wall time of the simulation step [ms] @param sums of the whole world @throws IoError
    void add(const World& world, double ms, const Statistics& step, const WorldSums& sums);

  private:
    TextFile file_;
    std::size_t rows_ = 0;
};

}  // namespace cairn::cli
