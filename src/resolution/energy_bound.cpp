#include "resolution/energy_bound.h"

#include <algorithm>
#include <vector>

#include "resolution/energy_gain.h"

namespace cairn {

namespace {

class EnergyBound final : public Resolution {
  public:
    explicit EnergyBound(std::unique_ptr<Resolution> resolution) : resolution_(std::move(resolution)) {}

    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings, const Executor& executor) override {
        if (isDriven(batch, contacts, bodies)) {
            return resolution_->resolve(batch, contacts, bodies, settings, executor);
        }
        noteMotion(batch.bodies, bodies, before_);
        ResolutionCounts counts = resolution_->resolve(batch, contacts, bodies, settings, executor);
        EnergyGain gain = gainOf(batch, bodies);
        if (!isAboveRounding(gain, batch, bodies)) return counts;
        if (hasHistory(batch, contacts)) {
            keepPart(0, batch, contacts, bodies);
            for (const std::uint32_t i : batch.contacts) contacts[i].last_impulse.setZero();
            const ResolutionCounts again = resolution_->resolve(batch, contacts, bodies, settings, executor);
            counts.global_iterations += again.global_iterations;
            gain = gainOf(batch, bodies);
            if (!isAboveRounding(gain, batch, bodies)) return counts;
        }
        keepPart(gain.largestPart(0), batch, contacts, bodies);
        return counts;
    }

    bool wantsAllThreads(const BatchView& batch, std::span<const Contact> contacts) const override {
        return resolution_->wantsAllThreads(batch, contacts);
    }

  private:
    static bool isDriven(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
        return std::ranges::any_of(batch.joints, hasMotor) || !hasStillSupports(batch, contacts, bodies);
    }

    static bool hasMotor(const JointBlock& joint) {
        return std::any_of(joint.bound.begin(), joint.bound.begin() + joint.bounds,
                           [](const BoundRow& bound) { return bound.is_motor; });
    }

    static bool hasHistory(const BatchView& batch, std::span<const Contact> contacts) {
        return std::ranges::any_of(batch.contacts,
                                   [&](std::uint32_t i) { return !contacts[i].last_impulse.isZero(0); });
    }

    EnergyGain gainOf(const BatchView& batch, const BodyState& bodies) const {
        EnergyGain gain;
        for (std::size_t n = 0; n < batch.bodies.size(); ++n) {
            const BodyIndex i = batch.bodies[n];
            gain.add(bodies, i, before_[n], {bodies.v[i], bodies.w[i]});
        }
        return gain;
    }

    bool isAboveRounding(const EnergyGain& gain, const BatchView& batch, const BodyState& bodies) const {
        if (!(gain.whole() > 0)) return false;
        double energy = 0;
        for (std::size_t n = 0; n < batch.bodies.size(); ++n) {
            energy += kineticEnergyOf(bodies, batch.bodies[n], before_[n]);
        }
        return gain.whole() > energy_rounding * energy;
    }

    void keepPart(double part, const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies) const {
        for (std::size_t n = 0; n < batch.bodies.size(); ++n) {
            const BodyIndex i = batch.bodies[n];
            bodies.v[i] = before_[n].v + part * (bodies.v[i] - before_[n].v);
            bodies.w[i] = before_[n].w + part * (bodies.w[i] - before_[n].w);
        }
        for (const std::uint32_t i : batch.contacts) {
            contacts[i].impulse *= part;
            contacts[i].angular_impulse *= part;
        }
        for (JointBlock& joint : batch.joints) {
            for (double& impulse : joint.impulse) impulse *= part;
            for (std::uint32_t i = 0; i < joint.bounds; ++i) joint.bound[i].impulse *= part;
        }
    }

    std::unique_ptr<Resolution> resolution_;
    std::vector<BodyMotion> before_;  ///< [bodies of the batch]
};

}  // namespace

std::unique_ptr<Resolution> makeEnergyBound(std::unique_ptr<Resolution> resolution) {
    return std::make_unique<EnergyBound>(std::move(resolution));
}

}  // namespace cairn
