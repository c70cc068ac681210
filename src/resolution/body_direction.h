/// @file The bodies' part of the direction of the conjugate gradients.
#pragma once

#include <vector>

#include "parallel/executor.h"
#include "resolution/local_batch.h"

namespace cairn {

/// What the impulses of a sweep do to the velocities is linear in them, so that a direction of the impulses has one of
/// the velocities beside it. Keeps its memory between batches.
class BodyDirection {
  public:
    /// Remembers the velocities before a sweep.
    void save(const LocalBatch& batch, const Executor& executor);
    /// Adds β times the last direction to the velocities; the new direction is the change since save() plus that.
    void accelerate(double beta, LocalBatch& batch, const Executor& executor);
    /// Forgets the last direction. @pre save()
    void restart();

  private:
    std::vector<Twist> before_;     ///< [dynamic bodies]
    std::vector<Twist> direction_;  ///< [dynamic bodies]
};

}  // namespace cairn
