/// @file The order in which batches are worked on, and which threads do it. @source thesis §4, Figure 26
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "batches/batches.h"
#include "parallel/executor.h"

namespace cairn {

/// Batches with at least 32 contacts are handed out one at a time, by descending size (ties by index); the smaller ones
/// follow in ascending order, in blocks. Keeps its memory.
class BatchSchedule {
  public:
    void arrange(std::span<const BatchView> batches);
    std::span<const std::uint32_t> order() const { return order_; }
    std::size_t large() const { return large_; }  ///< how many of the order are handed out one at a time

    /// Calls work(batch, thread) for all.
    template <class Work>
    void forEach(const Executor& executor, const Work& work) const {
        executor.forEachDynamic(large_, [&](std::size_t i, int thread) { work(order_[i], thread); });
        executor.forBlocks(
            order_.size() - large_,
            [&](std::size_t begin, std::size_t end, int thread) {
                for (std::size_t i = begin; i < end; ++i) work(order_[large_ + i], thread);
            },
            small_grain);
    }

  private:
    /// Fewest small batches worth a thread of their own.
    static constexpr std::size_t small_grain = 64;

    std::vector<std::uint32_t> order_;  ///< indices of batches
    std::size_t large_ = 0;
};

}  // namespace cairn
