/// @file Loops over ranges on several threads. Stages hand in independent work items; which thread runs which item
/// never changes a result.
#pragma once

#include <cstddef>
#include <memory>

#include "parallel/function_ref.h"
#include "parallel/processor_probe.h"
#include "parallel/thread_pool.h"

namespace cairn {

/// Runs loops on a given number of threads. Exceptions thrown by work items are rethrown after the loop (the one of
/// the lowest thread). Work items must not start loops of the same executor, and only one thread at a time may use it.
class Executor {
  public:
    /// @param threads 1 to 65 534; beyond that as many
    explicit Executor(int threads = 1);

    int threads() const { return threads_; }
    /// Whether the processors of the other threads are free for them, as far as is known; not if there are none.
    bool othersAreFree() { return probe_ != nullptr && probe_->areFree(); }
    /// Whether the other threads take part in loops from now on; at first they do. No result depends on it.
    void setHelped(bool helped) { helped_ = helped; }

    /// Splits [0, count) into one contiguous block per thread ("static" of thesis §4), ascending with the thread.
    /// @param work called with (begin, end, thread), thread in [0, threads())
    /// @param grain fewest items worth a thread of their own: starting one costs about as much as 1 µs of work
    void forBlocks(std::size_t count, FunctionRef<void(std::size_t, std::size_t, int)> work,
                   std::size_t grain = 512) const;

    /// Hands out the items of [0, count) one by one, in ascending order ("dynamic,1" of thesis §4).
    /// @param work called with (item, thread)
    void forEachDynamic(std::size_t count, FunctionRef<void(std::size_t, int)> work) const;

  private:
    int threads_;
    bool helped_ = true;
    std::unique_ptr<ThreadPool> pool_;       ///< none for one thread
    std::unique_ptr<ProcessorProbe> probe_;  ///< none where no other comes
};

}  // namespace cairn
