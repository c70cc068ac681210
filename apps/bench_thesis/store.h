/// @file The results file, written after every measurement so that an interrupted run goes on where it was.
#pragma once

#include <filesystem>
#include <string>

#include "experiment.h"

namespace cairn::thesis {

/// Writes a file so that it is either the old or the new one, whatever happens. @throws IoError
void writeWhole(const std::filesystem::path& file, const std::string& text);
/// @throws IoError
std::string readWhole(const std::filesystem::path& file);

/// The measurements of results.json.
class Store {
  public:
    /// Keeps what is in the file if it was measured by the same program on the same machine.
    /// @param origin engine, machine and extent; results of another origin are left out @throws IoError
    Store(std::filesystem::path file, Json origin);

    /// How often an experiment was measured with its present scene and settings.
    std::size_t repetitions(const Experiment& experiment) const;
    /// Milliseconds that they took together.
    double spent(const Experiment& experiment) const;
    /// Adds a measurement and writes the file. @throws IoError
    void add(const Experiment& experiment, const Json& value, double ms);
    /// Adds the report to the file. @throws IoError
    void setReport(const Json& report);
    Results results() const;

  private:
    void write() const;

    std::filesystem::path file_;
    Json origin_;
    Json experiments_ = Json::object();
    Json report_;
};

}  // namespace cairn::thesis
