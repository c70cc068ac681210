/// @file Which bodies may touch: candidates for the narrow phase, from axis-aligned bounds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_storage.h"
#include "geometry/geometry.h"
#include "parallel/executor.h"

namespace cairn {

/// Two bodies whose bounds overlap; a < b, not both fixed.
struct BodyPair {
    BodyIndex a = 0;
    BodyIndex b = 0;

    friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

/// What the broad phase sees of the bodies; one entry per slot, holes have kind `hole`.
struct BroadPhaseInput {
    std::span<const BodyKind> kind;
    std::span<const Bounds>
        bounds;  ///< [m, W], already grown by the contact margin; infinite bodies have infinite ones
    std::span<const std::uint8_t>
        still{};  ///< 1 = of no interest with others that are, too; empty = all are of interest

    bool isStill(BodyIndex i) const { return !still.empty() && still[i] != 0; }
};

/// Finds the pairs of overlapping bounds.
class BroadPhase {
  public:
    virtual ~BroadPhase() = default;
    /// @param pairs replaced by all pairs (a < b, not both fixed or both still, bounds overlap), sorted by (a, b), each
    ///        once; the same on any number of threads
    virtual void findPairs(const BroadPhaseInput& input, const Executor& executor, std::vector<BodyPair>& pairs) = 0;
    /// Level of the hierarchy a body is in, for display; −1 for bodies outside it.
    virtual int level(BodyIndex body) const = 0;
};

}  // namespace cairn
