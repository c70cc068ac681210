/// @file A line on the standard error that says where a benchmark is.
#pragma once

#include <chrono>
#include <string>

namespace cairn::cli {

/// Drawn a few times a second, only if the standard error is a terminal.
class BenchProgress {
  public:
    BenchProgress();
    BenchProgress(const BenchProgress&) = delete;
    BenchProgress& operator=(const BenchProgress&) = delete;
    /// Ends the line.
    ~BenchProgress();

    /// @param part of all work, 0 to 1 @param what runs
    void update(double part, const std::string& what);

  private:
    using Clock = std::chrono::steady_clock;
    bool shown_;
    Clock::time_point next_ = Clock::now();
};

}  // namespace cairn::cli
