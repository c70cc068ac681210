/// @file What sweeps work on, and what they change.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "parallel/executor.h"
#include "resolution/local_batch.h"

namespace cairn {

/// In which order sweeps visit the contacts of a batch.
enum class SweepOrder : std::uint8_t {
    one_by_one,  ///< from body to body
    in_order,    ///< as if from body to body, in lanes on one thread
    by_colours   ///< in lanes on all threads
};

/// What sweeps work on.
struct PgsBatch {
    LocalBatch& local;
    const BatchView& batch;
    std::span<Contact> contacts;
    const BodyState& bodies;
    const ResolutionSettings& settings;
    const Executor& executor;
    SweepOrder order = SweepOrder::one_by_one;
};

/// How much a sweep changed.
struct SweepChange {
    double squared = 0;        ///< of the impulses, weighted by the normal part of K: twice an energy [J]
    double largest_speed = 0;  ///< largest change of a contact's velocity by its own impulse [m/s]

    void add(const SweepChange& other) {
        squared += other.squared;
        largest_speed = std::max(largest_speed, other.largest_speed);
    }
};

/// Fewest contacts or bodies worth a thread of their own in simple loops.
inline constexpr std::size_t loop_grain = 256;

/// Calls work(i) for all i below count.
template <class Work>
void forEach(std::size_t count, const Executor& executor, const Work& work, std::size_t grain = loop_grain) {
    executor.forBlocks(
        count,
        [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) work(i);
        },
        grain);
}

}  // namespace cairn
