/// @file Whether other processors are free, found out beside the work of the caller.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace cairn {

/// Now and then other threads take some milliseconds of a processor each, for nothing, and find out how much of that
/// time they were given. A caller who worked with them to find it out would wait for whoever does not get a processor;
/// this one works on alone meanwhile.
class ProcessorProbe {
  public:
    /// @param others threads that need a processor each, ≥ 1
    explicit ProcessorProbe(int others);
    ~ProcessorProbe();
    ProcessorProbe(const ProcessorProbe&) = delete;
    ProcessorProbe& operator=(const ProcessorProbe&) = delete;

    /// Whether the others were free last time. Not while that is found out: the others must be left alone then.
    /// Returns at once.
    bool areFree();

  private:
    using Clock = std::chrono::steady_clock;

    void begin();
    void end();
    void take();

    int others_;
    bool free_ = false;
    bool asks_ = false;                 ///< the threads are at it, or done
    Clock::time_point next_ = {};       ///< when to ask again
    Clock::duration pause_{};           ///< between two times that they were not free
    std::vector<std::thread> threads_;  ///< while asking
    std::atomic<int> unfinished_ = 0;   ///< of them
    std::atomic<double> given_ = 0;     ///< sum of the parts of their time that they were given
    std::atomic<bool> given_up_ = false;
};

}  // namespace cairn
