#include <cmath>
#include <memory>

#include "resolution/algorithms.h"
#include "resolution/contact_law.h"
#include "resolution/local_batch.h"

namespace cairn {

namespace {

/// Goes through the contacts in ascending order, again and again, and resolves each that closes (projected Gauss–Seidel
/// in the sense that no impulse pulls). Shares with the thesis's algorithm the law of one contact, nothing else: no
/// queue, no lists, every velocity computed afresh.
class SweepResolution final : public BatchResolution {
  public:
    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings, const Executor&) override {
        local_.gather(batch, contacts, bodies);
        law_.begin(batch, contacts, settings);
        ResolutionCounts counts;
        const std::int64_t limit = sweepLimit(settings);
        for (std::int64_t sweep = 0; sweep < limit; ++sweep) {
            const bool bounds_changed = local_.joints.resolveBounds(local_.bodies, settings.resolution_threshold);
            const std::int64_t resolved = sweepOnce(settings);
            counts.global_iterations += resolved;
            if (resolved == 0 && !bounds_changed) break;
        }
        local_.scatter(batch, contacts, bodies);
        return counts;
    }

  private:
    std::int64_t sweepOnce(const ResolutionSettings& settings) {
        std::int64_t resolved = 0;
        for (std::size_t i = 0; i < local_.contacts.size(); ++i) {
            ContactFrame& contact = local_.contacts[i];
            const Vec3 velocity = local_.velocityOf(contact);
            const bool closing = velocity[0] < -settings.resolution_threshold && std::isfinite(velocity[0]);
            if (!closing || !isResolvable(contact)) continue;
            const ContactWrench wrench = law_.resolve(i, local_, velocity);
            local_.push(contact, wrench.impulse);
            contact.impulse += contact.basis * wrench.impulse;
            if (!wrench.angular.isZero(0)) local_.turn(contact, wrench.angular);
            ++resolved;
        }
        return resolved;
    }

    LocalBatch local_;
    ContactLaw law_;
};

}  // namespace

std::unique_ptr<BatchResolution> makeSweepResolution() {
    return std::make_unique<SweepResolution>();
}

}  // namespace cairn
