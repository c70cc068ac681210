/// @file The obviously right broad phase: tests every body against every other. The oracle of the hash grids.
#pragma once

#include <vector>

#include "broad_phase/broad_phase.h"

namespace cairn::broad_phase_tests {

/// What BroadPhase::findPairs() is to find.
inline std::vector<BodyPair> allPairs(const BroadPhaseInput& input) {
    std::vector<BodyPair> pairs;
    const auto slots = static_cast<BodyIndex>(input.kind.size());
    for (BodyIndex a = 0; a < slots; ++a) {
        for (BodyIndex b = a + 1; b < slots; ++b) {
            if (input.kind[a] == BodyKind::hole || input.kind[b] == BodyKind::hole) continue;
            if (input.kind[a] == BodyKind::fixed && input.kind[b] == BodyKind::fixed) continue;
            if (input.isStill(a) && input.isStill(b)) continue;
            if (input.bounds[a].overlaps(input.bounds[b])) pairs.push_back({a, b});
        }
    }
    return pairs;
}

}  // namespace cairn::broad_phase_tests
