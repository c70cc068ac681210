/// @file Sweeps over the contacts of a batch, whatever the order and layout of the contacts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "parallel/executor.h"
#include "resolution/local_batch.h"
#include "resolution/resolution.h"

namespace cairn {

/// What a sweeper works on.
struct SweptBatch {
    LocalBatch& local;
    const BatchView& batch;
    std::span<Contact> contacts;
    const BodyState& bodies;
    const ResolutionSettings& settings;
    const Executor& executor;
    bool framed;  ///< local has frames of the contacts: there are joints, or rolling friction
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

/// Holds the accumulated impulses of a batch's contacts while it is resolved, and their last direction of the
/// conjugate gradients. Keeps its memory between batches.
class Sweeper {
  public:
    virtual ~Sweeper() = default;

    /// Takes over a batch that local has gathered, and applies the impulses that contacts remember.
    virtual void begin(const SweptBatch& swept) = 0;
    virtual std::size_t size() const = 0;  ///< contacts
    /// Visits every contact twice: forth and back.
    virtual void sweep(const SweptBatch& swept) = 0;
    /// Remembers the impulses before a sweep.
    virtual void note(const SweptBatch& swept) = 0;
    /// What changed since note(). The same on any number of threads.
    virtual SweepChange change(const SweptBatch& swept) = 0;
    /// Adds β times the last direction to the impulses; the new direction is the change since note() plus that.
    virtual void accelerate(double beta, const SweptBatch& swept) = 0;
    /// Forgets the last direction.
    virtual void restart() = 0;
    /// Gives the contacts that slide their kinetic friction. @return whether any has another one now
    virtual bool releaseSliding(const SweptBatch& swept) = 0;
    /// Writes the impulses to the contacts.
    virtual void finish(const SweptBatch& swept) = 0;
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
