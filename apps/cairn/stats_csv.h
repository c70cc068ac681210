/// @file The statistics of a run as a CSV file.
#pragma once

#include "cairn/scene.h"
#include "output.h"

namespace cairn::cli {

/// One row per simulation step, written as the run goes on. @source docs/cli.md names the columns
class StatsCsv {
  public:
    /// @throws IoError
    explicit StatsCsv(const std::filesystem::path& file);
    /// @param ms wall time of the simulation step [ms] @throws IoError
    void add(const World& world, double ms, const Statistics& step);

  private:
    TextFile file_;
    std::size_t rows_ = 0;
};

}  // namespace cairn::cli
