/// @file The moments of a run that pictures show.
#pragma once

#include <optional>

#include "cairn/recording.h"
#include "experiment.h"

namespace cairn::thesis {

/// Records the moments of an experiment, and nothing in between.
class Moments {
  public:
    /// @param file to write; empty = nothing is recorded @throws IoError
    Moments(const SceneExperiment& what, const std::filesystem::path& file);
    /// @param step simulation step, 0 = the beginning
    void look(const SceneRun& run, std::int64_t step, const Statistics& statistics);
    void close();

  private:
    std::optional<RecordingWriter> writer_;
    std::vector<std::int64_t> steps_;
};

/// A hash of what a scene and its settings say. @return 16 hexadecimal digits
std::string fingerprintOf(const Scene& scene, const Settings& settings);

}  // namespace cairn::thesis
