#include "resolution/energy_bound.h"

#include <algorithm>
#include <vector>

#include "resolution/batch_motion.h"
#include "resolution/symmetric3.h"

namespace cairn {

namespace {

/// Part of the energy that rounding may add.
constexpr double rounding = 1e-12;

/// What part s of a change of velocities adds to the kinetic energy: s·linear + s²·quadratic [J].
struct Gain {
    double linear = 0;
    double quadratic = 0;

    double whole() const { return linear + quadratic; }
    /// The part above 0 that adds nothing, or 0.
    double neutralPart() const { return std::max(-linear / quadratic, 0.0); }
};

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
        Gain gain = gainOf(batch, bodies);
        if (!isAboveRounding(gain, batch, bodies)) return counts;
        if (hasHistory(batch, contacts)) {
            keepPart(0, batch, contacts, bodies);
            for (const std::uint32_t i : batch.contacts) contacts[i].last_impulse.setZero();
            const ResolutionCounts again = resolution_->resolve(batch, contacts, bodies, settings, executor);
            counts.global_iterations += again.global_iterations;
            gain = gainOf(batch, bodies);
            if (!isAboveRounding(gain, batch, bodies)) return counts;
        }
        keepPart(gain.neutralPart(), batch, contacts, bodies);
        return counts;
    }

    std::size_t sharedFrom() const override { return resolution_->sharedFrom(); }

  private:
    static bool isDriven(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
        return std::ranges::any_of(batch.joints, [](const JointBlock& joint) { return joint.bounds > 0; }) ||
               !hasStillSupports(batch, contacts, bodies);
    }

    static bool hasHistory(const BatchView& batch, std::span<const Contact> contacts) {
        return std::ranges::any_of(batch.contacts,
                                   [&](std::uint32_t i) { return !contacts[i].last_impulse.isZero(0); });
    }

    Gain gainOf(const BatchView& batch, const BodyState& bodies) const {
        Gain gain;
        for (std::size_t n = 0; n < batch.bodies.size(); ++n) {
            const BodyIndex i = batch.bodies[n];
            const BodyMotion& before = before_[n];
            const Vec3 dv = bodies.v[i] - before.v;
            const Vec3 dw = bodies.w[i] - before.w;
            const double mass = 1 / bodies.mass_inv[i];
            const Vec3 turned = inverse(Symmetric3::from(bodies.inertiaInv_W[i])) * dw;
            gain.linear += mass * before.v.dot(dv) + before.w.dot(turned);
            gain.quadratic += 0.5 * (mass * dv.squaredNorm() + dw.dot(turned));
        }
        return gain;
    }

    bool isAboveRounding(const Gain& gain, const BatchView& batch, const BodyState& bodies) const {
        if (!(gain.whole() > 0)) return false;
        double energy = 0;
        for (std::size_t n = 0; n < batch.bodies.size(); ++n) {
            const BodyIndex i = batch.bodies[n];
            const BodyMotion& before = before_[n];
            const Vec3 spin = inverse(Symmetric3::from(bodies.inertiaInv_W[i])) * before.w;
            energy += 0.5 * (before.v.squaredNorm() / bodies.mass_inv[i] + before.w.dot(spin));
        }
        return gain.whole() > rounding * energy;
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
