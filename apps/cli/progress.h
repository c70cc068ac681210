/// @file The progress bar of a run.
#pragma once

#include <chrono>

namespace cairn::cli {

/// Draws on the standard error, a few times a second, only if that is a terminal.
class Progress {
  public:
    enum class Wish { show, hide };

    /// @param duration of the run [s, simulated]
    Progress(double duration, Wish wish);
    /// Clears the line.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// @param time reached [s, simulated]
    void update(double time);

  private:
    using Clock = std::chrono::steady_clock;

    double duration_;
    bool shown_;
    Clock::time_point begin_ = Clock::now();
    Clock::time_point next_ = begin_;
};

}  // namespace cairn::cli
