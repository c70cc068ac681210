#include "resolution/energy_guard.h"

#include <algorithm>

namespace cairn {

namespace {

bool hasMotor(const JointBlock& joint) {
    return std::any_of(joint.bound.begin(), joint.bound.begin() + joint.bounds,
                       [](const BoundRow& bound) { return bound.is_motor; });
}

bool isDriven(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
    return std::ranges::any_of(batch.joints, hasMotor) || !hasStillSupports(batch, contacts, bodies);
}

bool hasHistory(const BatchView& batch, std::span<const Contact> contacts) {
    return std::ranges::any_of(batch.contacts, [&](std::uint32_t i) { return !contacts[i].last_impulse.isZero(0); });
}

}  // namespace

void EnergyGuard::begin(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
    watches_ = !isDriven(batch, contacts, bodies);
    if (watches_) saveMotion(batch.bodies, bodies, before_);
}

bool EnergyGuard::refuses(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies) {
    if (!watches_) return false;
    const EnergyGain gain = gainOf(batch, bodies);
    if (!isAboveRounding(gain, batch, bodies)) return false;
    if (!hasHistory(batch, contacts)) {
        keepPart(gain.largestPart(0), batch, contacts, bodies);
        return false;
    }
    keepPart(0, batch, contacts, bodies);
    for (const std::uint32_t i : batch.contacts) contacts[i].last_impulse.setZero();
    return true;
}

void EnergyGuard::bound(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies) const {
    const EnergyGain gain = gainOf(batch, bodies);
    if (isAboveRounding(gain, batch, bodies)) keepPart(gain.largestPart(0), batch, contacts, bodies);
}

EnergyGain EnergyGuard::gainOf(const BatchView& batch, const BodyState& bodies) const {
    EnergyGain gain;
    for (std::size_t n = 0; n < batch.bodies.size(); ++n) {
        const BodyIndex i = batch.bodies[n];
        gain.add(bodies, i, before_[n], {bodies.v[i], bodies.w[i]});
    }
    return gain;
}

bool EnergyGuard::isAboveRounding(const EnergyGain& gain, const BatchView& batch, const BodyState& bodies) const {
    if (!(gain.whole() > 0)) return false;
    double energy = 0;
    for (std::size_t n = 0; n < batch.bodies.size(); ++n) {
        energy += kineticEnergyOf(bodies, batch.bodies[n], before_[n]);
    }
    return gain.whole() > energy_rounding * energy;
}

void EnergyGuard::keepPart(double part, const BatchView& batch, std::span<Contact> contacts,
                           const BodyState& bodies) const {
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

}  // namespace cairn
