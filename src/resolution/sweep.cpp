#include <cmath>
#include <memory>

#include "resolution/algorithms.h"
#include "resolution/impulse.h"
#include "resolution/local_batch.h"

namespace cairn {

namespace {

/// Goes through the contacts in ascending order, again and again, and resolves each that closes (projected Gauss–Seidel
/// in the sense that no impulse pulls). Shares with the thesis's algorithm the law of one contact, nothing else: no
/// queue, no lists, every velocity computed afresh.
class SweepResolution final : public Resolution {
  public:
    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings) override {
        local_.gather(batch, contacts, bodies);
        ResolutionCounts counts;
        for (std::int64_t sweep = 0; sweep < settings.sweeps; ++sweep) {
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
        for (ContactFrame& contact : local_.contacts) {
            const Vec3 velocity = local_.velocityOf(contact);
            const bool closing = velocity[0] < -settings.resolution_threshold && std::isfinite(velocity[0]);
            if (!closing || !isResolvable(contact)) continue;
            const Vec3 j = contactImpulse(contact, velocity, settings.restitution_threshold);
            local_.push(contact, j);
            contact.impulse += contact.basis * j;
            ++resolved;
        }
        return resolved;
    }

    LocalBatch local_;
};

}  // namespace

std::unique_ptr<Resolution> makeSweepResolution() {
    return std::make_unique<SweepResolution>();
}

}  // namespace cairn
