#include "resolution/resolution.h"

#include "resolution/algorithms.h"
#include "resolution/awake_part.h"
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
            return makeAwakePart(makeImpactsFirst(makeImpulseQueueResolution(), Impacts::sequential), Sleepers::wake);
        case ResolutionKind::sweep:
            return makeAwakePart(makeImpactsFirst(makeSweepResolution(), Impacts::sequential), Sleepers::wake);
        case ResolutionKind::accelerated_sweeps:
            return makeAwakePart(
                makeEnergyBound(makeImpactsFirst(makeAcceleratedSweepsResolution(), Impacts::simultaneous)),
                Sleepers::remain);
        case ResolutionKind::none:
            break;
    }
    return std::make_unique<NoResolution>();
}

}  // namespace cairn
