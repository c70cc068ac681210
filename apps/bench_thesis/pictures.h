/// @file Pictures of the recorded moments.
#pragma once

#include <map>

#include "bench.h"

namespace cairn::thesis {

/// Where an experiment's moments are recorded.
std::filesystem::path recordingOf(const std::filesystem::path& out, const std::string& key);

/// Draws what is not drawn yet.
class Pictures {
  public:
    explicit Pictures(const BenchOptions& options) : options_(options) {}

    /// The pictures of an experiment, always from the same camera: objects with "time" [s] and "file" (relative to the
    /// output folder); fewer where they cannot be drawn, which is noted in warnings(). @throws Interrupted
    Json draw(const std::string& key, const std::vector<double>& camera);
    const std::vector<std::string>& warnings() const { return warnings_; }

  private:
    Json drawAll(const std::string& key, const std::vector<double>& camera);

    const BenchOptions& options_;
    std::map<std::string, Json> drawn_;
    std::vector<std::string> warnings_;
};

}  // namespace cairn::thesis
