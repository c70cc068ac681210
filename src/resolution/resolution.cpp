#include "resolution/resolution.h"

#include "resolution/algorithms.h"
#include "resolution/impacts_first.h"

namespace cairn {

namespace {

/// Leaves everything as it is: bodies fall through each other.
class NoResolution final : public Resolution {
  public:
    ResolutionCounts resolve(const ResolutionInput&) override { return {}; }
};

}  // namespace

std::unique_ptr<Resolution> makeResolution(ResolutionKind kind) {
    switch (kind) {
        case ResolutionKind::impulse_queue:
        case ResolutionKind::arbitrary_order:
            return makePerBatch([] { return makeImpactsFirst(makeImpulseQueueResolution(), Impacts::sequential); });
        case ResolutionKind::sweep:
            return makePerBatch([] { return makeImpactsFirst(makeSweepResolution(), Impacts::sequential); });
        case ResolutionKind::accelerated_sweeps:
            return makeSweepsOfAll();
        case ResolutionKind::none:
            break;
    }
    return std::make_unique<NoResolution>();
}

}  // namespace cairn
