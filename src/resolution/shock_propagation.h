/// @file Shock propagation: from the ground up, layer by layer, what is done becomes immovable for what comes after.
/// @source thesis §3.7, Algorithm 10
#pragma once

#include <cstdint>
#include <vector>

#include "resolution/impulse_queue.h"

namespace cairn {

/// What a shock propagation did.
struct ShockOutcome {
    std::int64_t iterations = 0;
    std::int64_t stages = 0;  ///< 0 = nothing in the batch touches a fixed body, nothing was done
};

/// Algorithm 10. Its infinite masses exist in the solver's copies only, which the next batch overwrites: the masses of
/// the bodies themselves need no restoring.
class ShockPropagation {
  public:
    /// @param solver a batch after its global resolution @param iterations_per_contact limit of each stage as a
    /// multiple of its contacts; 0 = unlimited
    ShockOutcome run(QueueSolver& solver, double iterations_per_contact);

  private:
    void findFirstSubset(const LocalBatch& batch);
    void listContactsOfSubset(const QueueSolver& solver);
    void freezeSubset(QueueSolver& solver);

    std::uint32_t stage_ = 0;
    std::vector<std::uint32_t> subset_, next_subset_;  ///< local bodies, ascending
    std::vector<std::uint32_t> members_;               ///< contacts of the subset, ascending
    std::vector<std::uint32_t> stage_of_body_;         ///< [bodies]; `unreached` until found
    std::vector<std::uint64_t> marked_;                ///< a bit for each contact of the batch
};

}  // namespace cairn
