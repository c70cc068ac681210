#include "resolution/energy_guard.h"

#include <algorithm>

namespace cairn {

namespace {

/// Part of the energy that sweeps which end early may add where a joint or a moving support gives some: less than that
/// is no reason to begin anew, and to weaken what holds a joint.
constexpr double driven_rounding = 0.01;

bool hasMotor(const JointBlock& joint) {
    return std::any_of(joint.bound.begin(), joint.bound.begin() + joint.bounds,
                       [](const BoundRow& bound) { return bound.is_motor; });
}

double rateOf(const JointRow& row, const BodyMotion& a, const BodyMotion& b) {
    return row.linear.dot(a.v - b.v) + row.angular_a.dot(a.w) + row.angular_b.dot(b.w);
}

bool hasHistory(const BatchView& batch, std::span<const Contact> contacts) {
    return std::ranges::any_of(batch.contacts, [&](std::uint32_t i) { return !contacts[i].last_impulse.isZero(0); });
}

}  // namespace

void EnergyGuard::begin(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
    carried_ = !hasStillSupports(batch, contacts, bodies);
    driven_ = std::ranges::any_of(batch.joints, hasMotor);
    saveMotion(batch.bodies, bodies, before_);
}

bool EnergyGuard::refuses(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies) {
    const EnergyGain gain = gainOf(batch, bodies);
    const double given = givenTo(batch, contacts, bodies);
    if (!isAboveRounding(gain, given, batch, bodies)) return false;
    if (!hasHistory(batch, contacts)) {
        keepPart(gain.largestPart(given), batch, contacts, bodies);
        return false;
    }
    keepPart(0, batch, contacts, bodies);
    for (const std::uint32_t i : batch.contacts) contacts[i].last_impulse.setZero();
    return true;
}

void EnergyGuard::bound(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies) const {
    const EnergyGain gain = gainOf(batch, bodies);
    const double given = givenTo(batch, contacts, bodies);
    if (isAboveRounding(gain, given, batch, bodies)) keepPart(gain.largestPart(given), batch, contacts, bodies);
}

/// What may be added [J].
double EnergyGuard::givenTo(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) const {
    return givenByJoints(batch, bodies) + givenBySupports(batch, contacts, bodies);
}

/// The work of fixed bodies that move, or whose surface does: the impulse that they give times their velocity.
double EnergyGuard::givenBySupports(const BatchView& batch, std::span<const Contact> contacts,
                                    const BodyState& bodies) const {
    if (!carried_) return 0;
    double given = 0;
    for (const std::uint32_t n : batch.contacts) {
        const Contact& contact = contacts[n];
        const auto work = [&](BodyIndex i) {
            if (!bodies.isFixed(i)) return 0.0;
            const Vec3 velocity = bodies.v[i] + bodies.w[i].cross(contact.pointOn(i) - bodies.position[i]) +
                                  bodies.surfaceVelocity(i, contact.normal);
            return contact.impulse.dot(velocity) + contact.angular_impulse.dot(bodies.w[i]);
        };
        given += std::max(0.0, work(contact.b) - work(contact.a));
    }
    return given;
}

/// The work of the rows of driven joints that gave any: impulse times the mean rate.
double EnergyGuard::givenByJoints(const BatchView& batch, const BodyState& bodies) const {
    if (!driven_) return 0;
    double given = 0;
    const auto placeOf = [&](BodyIndex body) {
        return static_cast<std::size_t>(std::ranges::lower_bound(batch.bodies, body) - batch.bodies.begin());
    };
    // Twice the mean; bodies that are not among those of the batch cannot move.
    const auto sumOfMotions = [&](BodyIndex body) -> BodyMotion {
        const std::size_t n = placeOf(body);
        if (n == batch.bodies.size() || batch.bodies[n] != body) return {Vec3::Zero(), Vec3::Zero()};
        return {before_[n].v + bodies.v[body], before_[n].w + bodies.w[body]};
    };
    const auto add = [&](double impulse, double sum_of_rates) { given += std::max(0.0, 0.5 * impulse * sum_of_rates); };
    for (const JointBlock& joint : batch.joints) {
        const BodyMotion a = sumOfMotions(joint.a);
        const BodyMotion b = sumOfMotions(joint.b);
        for (std::uint32_t i = 0; i < joint.size && joint.ends.empty(); ++i) {
            add(joint.impulse[i], rateOf(joint.rows[i], a, b));
        }
        double coupled = 0;
        for (const RowEnd& end : joint.ends) {
            const BodyMotion motion = sumOfMotions(end.body);
            coupled += end.linear.dot(motion.v) + end.angular.dot(motion.w);
        }
        if (!joint.ends.empty()) add(joint.impulse[0], coupled);
        for (const BoundRow& bound : std::span(joint.bound).first(joint.bounds)) {
            add(bound.impulse, rateOf(bound.row, a, b));
        }
    }
    return given;
}

EnergyGain EnergyGuard::gainOf(const BatchView& batch, const BodyState& bodies) const {
    EnergyGain gain;
    for (std::size_t n = 0; n < batch.bodies.size(); ++n) {
        const BodyIndex i = batch.bodies[n];
        gain.add(bodies, i, before_[n], {bodies.v[i], bodies.w[i]});
    }
    return gain;
}

bool EnergyGuard::isAboveRounding(const EnergyGain& gain, double given, const BatchView& batch,
                                  const BodyState& bodies) const {
    if (!(gain.whole() > given)) return false;
    double energy = given;
    for (std::size_t n = 0; n < batch.bodies.size(); ++n) {
        energy += kineticEnergyOf(bodies, batch.bodies[n], before_[n]);
    }
    return gain.whole() - given > (driven_ || carried_ ? driven_rounding : energy_rounding) * energy;
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
