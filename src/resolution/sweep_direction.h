/// @file What a sweep changed, and the direction of the conjugate gradients made of it.
#pragma once

#include <span>
#include <vector>

#include "parallel/executor.h"
#include "resolution/local_batch.h"
#include "resolution/swept_contact.h"

namespace cairn {

/// The angular impulse of a contact that resists rolling; contact coordinates.
struct SweptRolling {
    Vec3 impulse = Vec3::Zero();    ///< accumulated, on A [N·m·s]
    Vec3 direction = Vec3::Zero();  ///< last direction of the conjugate gradients [N·m·s]
    Vec3 before = Vec3::Zero();     ///< at the beginning of the sweep [N·m·s]
};

/// How much a sweep changed.
struct SweepChange {
    double squared = 0;        ///< of the impulses, weighted by the normal part of K: twice an energy [J]
    double largest_speed = 0;  ///< largest change of a contact's velocity by its own impulse [m/s]
};

/// The nonsmooth nonlinear conjugate gradient method: the change of the impulses by a sweep is taken as the negative
/// gradient. Keeps its memory between batches.
/// @source Silcowitz-Hansen, Niebe, Erleben, The Visual Computer 26 (2010), doi:10.1007/s00371-010-0502-6
class SweepDirection {
  public:
    /// What is swept: contacts, the rolling ones of them, and the batch with its velocities.
    struct Swept {
        std::span<SweptContact> contacts;
        std::span<SweptRolling> rolling;
        LocalBatch& batch;
        const Executor& executor;
    };

    /// Call it before a sweep.
    void note(const Swept& swept);
    /// What changed since note(). The same on any number of threads.
    SweepChange change(const Swept& swept);
    /// Adds β times the last direction to impulses and velocities; the new direction is the change since note() plus
    /// that.
    void accelerate(double beta, const Swept& swept);
    /// Forgets the last direction. @param swept decides about the sizes
    void restart(const Swept& swept);

  private:
    SweepChange changeOfBlock(std::size_t block, std::span<const SweptContact> contacts) const;

    std::vector<Vec3> impulses_before_;  ///< [contacts] [N·s]
    std::vector<Vec3> direction_;        ///< [contacts] [N·s]
    std::vector<Twist> bodies_before_;   ///< [dynamic bodies]
    std::vector<Twist> body_direction_;  ///< [dynamic bodies]
    std::vector<SweepChange> sums_;      ///< [blocks]
};

}  // namespace cairn
