/// @file Loops over ranges on several threads: the only room that knows OpenMP. Stages hand in independent work items;
/// which thread runs which item never changes a result.
#pragma once

#include <cstddef>

#include "parallel/function_ref.h"

namespace cairn {

/// Runs loops on a given number of threads. Exceptions thrown by work items are rethrown after the loop (the one of
/// the lowest thread).
class Executor {
  public:
    /// @param threads 1 or more
    explicit Executor(int threads = 1);

    int threads() const { return threads_; }

    /// Splits [0, count) into one contiguous block per thread ("static" of thesis §4), ascending with the thread.
    /// @param work called with (begin, end, thread), thread in [0, threads())
    /// @param grain fewest items worth a thread of their own: starting one costs about as much as 5 µs of work
    void forBlocks(std::size_t count, FunctionRef<void(std::size_t, std::size_t, int)> work,
                   std::size_t grain = 512) const;

    /// Hands out the items of [0, count) one by one, in ascending order ("dynamic,1" of thesis §4).
    /// @param work called with (item, thread)
    void forEachDynamic(std::size_t count, FunctionRef<void(std::size_t, int)> work) const;

  private:
    /// On a machine that is busy with other things a thread may get its turn milliseconds late, and a loop waits for
    /// all of its threads. After such a loop the next ones run on the caller's thread alone, twice as many after each.
    /// Only times depend on this, results never do.
    struct Patience {
        int paused = 0;      ///< loops still to be run alone
        double penalty = 0;  ///< loops that were run alone after the last late one, shrinking with loops in time
    };

    bool isPaused() const { return patience_.paused > 0; }
    /// @param lateness how long threads of a loop waited for a processor [s]
    void judge(double lateness) const;

    int threads_;
    mutable Patience patience_;
};

}  // namespace cairn
