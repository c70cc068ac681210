/// @file The obviously right broad phase: tests every pair.
#pragma once

#include "broad_phase/broad_phase.h"
#include "broad_phase/pair_rows.h"

namespace cairn {

/// Tests every body against every other: O(n²). The oracle of the hash grids.
class AllPairs final : public BroadPhase {
  public:
    void findPairs(const BroadPhaseInput& input, const Executor& executor, std::vector<BodyPair>& pairs) override;
    int level(BodyIndex) const override { return -1; }

  private:
    std::vector<PairBuffer> blocks_;  ///< one per block of bodies
};

}  // namespace cairn
