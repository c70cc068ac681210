/// @file Pairs of bodies that are near each other, kept until a body leaves the place that they were found for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broad_phase/broad_phase.h"

namespace cairn {

/// What near pairs depend on; one entry per slot.
struct NearPairsInput {
    std::span<const BodyKind> kind;
    std::span<const Bounds> bounds;       ///< [m, W] grown by the contact margin
    std::span<const Vec3> v;              ///< [m/s, W]
    std::span<const std::uint8_t> still;  ///< 1 = it did not move in the last time step
};

/// Searches with bounds that are larger than needed: by a part of the body's size on all sides, and by its way in the
/// time that follows. As long as all bodies stay within these, no pair can be missing, and nothing has to be searched.
/// Which pairs really overlap is left to the caller, so that nothing depends on when was searched last.
/// @source Verlet: Computer "experiments" on classical fluids, Physical Review 159 (1967), doi:10.1103/PhysRev.159.98:
///         lists of neighbours that last for several time steps
class NearPairs {
  public:
    /// Brings the pairs up to date.
    void update(const NearPairsInput& input, BroadPhase& broad_phase, const Executor& executor);
    /// To be called when the bodies are others: the next update begins anew, with the memory of this one.
    void forget();
    /// Sorted by (a, b), each once; among them all pairs (a < b, not both fixed) whose bounds overlap.
    std::span<const BodyPair> pairs() const { return pairs_; }

  private:
    bool findLeft(const NearPairsInput& input, const Executor& executor);
    void cover(const NearPairsInput& input, bool all, const Executor& executor);

    std::vector<BodyPair> pairs_;
    std::vector<Bounds> covered_;      ///< [slots] bounds of the last search [m, W]
    std::vector<BodyKind> kind_;       ///< [slots] at the last search
    std::vector<std::uint8_t> stays_;  ///< [slots] 1 = within covered_
    bool searched_ = false;            ///< by the last update
    std::vector<BodyPair> new_pairs_;  ///< those with a body whose covered_ is new
};

}  // namespace cairn
