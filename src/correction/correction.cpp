#include "correction/correction.h"

#include <fmt/format.h>

#include "correction/position_sweeps.h"
#include "correction/propagated_correction.h"

namespace cairn {

namespace {

/// Moves nothing; counts what it leaves.
class NoCorrection final : public Correction {
  public:
    CorrectionCounts correct(const BatchView& batch, const ContactsOfBodies&, std::span<Contact> contacts,
                             const BodyState&, double) override {
        CorrectionCounts counts;
        for (const std::uint32_t index : batch.contacts) {
            if (contacts[index].isTooDeep()) ++counts.penetrating;
        }
        counts.uncorrected = counts.penetrating;
        return counts;
    }
};

}  // namespace

std::unique_ptr<Correction> makeCorrection(CorrectionKind kind) {
    switch (kind) {
        case CorrectionKind::propagated:
            return std::make_unique<PropagatedCorrection>();
        case CorrectionKind::none:
            return std::make_unique<NoCorrection>();
        case CorrectionKind::position_sweeps:
            return std::make_unique<PositionSweeps>();
    }
    throw InputError(
        fmt::format("correction is {}; allowed are propagated (0), none (1) and "
                    "position_sweeps (2)",
                    static_cast<int>(kind)));
}

}  // namespace cairn
