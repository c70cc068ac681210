#include "resolution/impacts_first.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "batches/batch_motion.h"
#include "resolution/algorithms.h"
#include "resolution/contact_law.h"

namespace cairn {

namespace {

/// Resolutions of impacts one after the other, as a multiple of the contacts; elastic chains need many.
constexpr double sequential_limit = 1000;
constexpr double simultaneous_sweeps = 1000;

/// Which rule the settings ask for. Energetic restitution is a law of single impacts.
Impacts wantedOf(const ResolutionSettings& settings, Impacts own) {
    if (settings.impacts != Impacts::of_resolution) return settings.impacts;
    return settings.restitution_law == RestitutionLaw::energetic ? Impacts::sequential : own;
}

class ImpactsFirst final : public BatchResolution {
  public:
    ImpactsFirst(std::unique_ptr<BatchResolution> resolution, Impacts own)
        : resolution_(std::move(resolution)), own_(own) {}

    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings, const Executor& executor) override {
        const Impacts wanted = wantedOf(settings, own_);
        if (wanted == own_ || !hasImpact(batch, contacts, bodies, settings)) {
            return resolution_->resolve(batch, contacts, bodies, settings, executor);
        }
        const ResolutionCounts first = resolveImpacts(wanted, batch, contacts, bodies, settings, executor);
        saveJoints(batch);
        ResolutionSettings rest = settings;
        rest.restitution_threshold = std::numeric_limits<double>::infinity();
        ResolutionCounts counts = resolution_->resolve(batch, contacts, bodies, rest, executor);
        counts.global_iterations += first.global_iterations;
        addJoints(batch);
        return counts;
    }

  private:
    static bool hasImpact(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies,
                          const ResolutionSettings& settings) {
        return std::ranges::any_of(batch.contacts, [&](std::uint32_t i) {
            return isImpact(contacts[i], normalVelocity(contacts[i], bodies), settings.restitution_threshold);
        });
    }

    ResolutionCounts resolveImpacts(Impacts wanted, const BatchView& batch, std::span<Contact> contacts,
                                    const BodyState& bodies, const ResolutionSettings& settings,
                                    const Executor& executor) {
        ResolutionSettings impacts = settings;
        if (wanted == Impacts::sequential) {
            if (!sequential_) sequential_ = makeImpulseQueueResolution();
            impacts.resolution_threshold = std::max(settings.resolution_threshold, settings.restitution_threshold);
            impacts.iterations = sequential_limit;
            impacts.shock_propagation = false;
            return sequential_->resolve(batch, contacts, bodies, impacts, executor);
        }
        if (!simultaneous_) simultaneous_ = makeSweepsOfOne();
        if (settings.iterations > 0) impacts.iterations = std::max(settings.iterations, simultaneous_sweeps);
        impacts.tolerance = 0;
        return simultaneous_->resolve(batch, contacts, bodies, impacts, executor);
    }

    /// A resolution writes the impulses of joints, it does not add them.
    void saveJoints(const BatchView& batch) { joints_.assign(batch.joints.begin(), batch.joints.end()); }
    void addJoints(const BatchView& batch) const {
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            for (std::uint32_t row = 0; row < joints_[i].size; ++row) {
                batch.joints[i].impulse[row] += joints_[i].impulse[row];
            }
        }
    }

    std::unique_ptr<BatchResolution> resolution_;
    Impacts own_;
    std::unique_ptr<BatchResolution> sequential_;
    std::unique_ptr<BatchResolution> simultaneous_;
    std::vector<JointBlock> joints_;  ///< after the impacts
};

}  // namespace

bool putsImpactsFirst(const ResolutionSettings& settings, Impacts own) {
    return wantedOf(settings, own) != own;
}

std::unique_ptr<BatchResolution> makeImpactsFirst(std::unique_ptr<BatchResolution> resolution, Impacts own) {
    return std::make_unique<ImpactsFirst>(std::move(resolution), own);
}

}  // namespace cairn
