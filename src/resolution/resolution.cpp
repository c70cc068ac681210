#include "resolution/resolution.h"

#include "resolution/algorithms.h"
#include "resolution/energy_bound.h"
#include "resolution/impacts_first.h"

namespace cairn {

namespace {

/// Leaves everything as it is: bodies fall through each other.
class NoResolution final : public Resolution {
  public:
    ResolutionCounts resolve(const BatchView&, std::span<Contact>, const BodyState&, const ResolutionSettings&,
                             const Executor&) override {
        return {};
    }
};

}  // namespace

std::unique_ptr<Resolution> makeResolution(ResolutionKind kind) {
    switch (kind) {
        case ResolutionKind::impulse_queue:
            return makeImpactsFirst(makeImpulseQueueResolution(), Impacts::sequential);
        case ResolutionKind::sweep:
            return makeImpactsFirst(makeSweepResolution(), Impacts::sequential);
        case ResolutionKind::accelerated_sweeps:
            return makeEnergyBound(makeImpactsFirst(makeAcceleratedSweepsResolution(), Impacts::simultaneous));
        case ResolutionKind::none:
            break;
    }
    return std::make_unique<NoResolution>();
}

}  // namespace cairn
