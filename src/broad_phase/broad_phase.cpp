#include "broad_phase/broad_phase.h"

#include <stdexcept>

#include "broad_phase/all_pairs.h"
#include "broad_phase/hash_grids.h"

namespace cairn {

std::unique_ptr<BroadPhase> makeBroadPhase(BroadPhaseKind kind) {
    switch (kind) {
        case BroadPhaseKind::hash_grids:
            return std::make_unique<HashGrids>();
        case BroadPhaseKind::all_pairs:
            return std::make_unique<AllPairs>();
    }
    throw std::logic_error("makeBroadPhase: not a kind of broad phase");
}

}  // namespace cairn
