#include "resolution/impulse_queue.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "resolution/algorithms.h"
#include "resolution/energy_gain.h"
#include "resolution/shock_propagation.h"

namespace cairn {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

bool rests(const LocalBody& body) {
    return body.v.isZero(0) && body.w.isZero(0);
}

}  // namespace

std::int64_t iterationLimit(double multiple, std::size_t contacts) {
    const double limit = std::ceil(multiple * static_cast<double>(contacts));
    if (multiple <= 0 || limit >= static_cast<double>(iteration_cap)) return iteration_cap;
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(limit));
}

void QueueSolver::begin(const BatchView& view, std::span<const Contact> contacts, const BodyState& bodies,
                        const ResolutionSettings& settings) {
    settings_ = settings;
    threshold_ = -settings.resolution_threshold;
    batch.gatherUnprepared(view, contacts, bodies);
    law_.begin(view, contacts, settings);
    rows.begin(batch);
    delta_.assign(batch.contacts.size() + 1, never);
}

RunOutcome QueueSolver::run(std::span<const std::uint32_t> members, double iterations_per_contact) {
    const std::int64_t limit = iterationLimit(iterations_per_contact, members.size());
    if (settings_.resolution == ResolutionKind::arbitrary_order) return runWith(latest_first_queue_, members, limit);
    if (members.size() > queue_switch_) return runWith(tournament_queue_, members, limit);
    return runWith(array_queue_, members, limit);
}

template <class Queue>
RunOutcome QueueSolver::runWith(Queue& queue, std::span<const std::uint32_t> members, std::int64_t limit) {
    queue.reset(rows.lists(), delta_, threshold_);
    for (const std::uint32_t i : members) {
        const auto [a, b] = batch.ends[i];
        if (rests(batch.bodies[a]) && rests(batch.bodies[b])) {
            delta_[i] = 0;
            continue;
        }
        const double delta = batch.normalVelocityOf(i) + law_.allowedClosing(i);
        if (!std::isfinite(delta)) continue;
        delta_[i] = delta;
        if (!(delta < threshold_)) continue;
        if (batch.bodies[a].mass_inv > 0) queue.insert(i, a);
        if (batch.bodies[b].mass_inv > 0) queue.insert(i, b);
    }
    RunOutcome outcome;
    for (std::uint32_t next = queue.next(); next != no_contact; next = queue.next()) {
        if (outcome.iterations == limit) {
            outcome.still_closing = true;
            break;
        }
        outcome.iterations += resolve(queue, next);
    }
    for (const std::uint32_t i : members) delta_[i] = never;
    return outcome;
}

/// The impulse of a contact whose bodies have joints changes everything that these tie together.
template <class Queue>
void QueueSolver::pushJointed(Queue& queue, std::uint32_t contact, const Vec3& j) {
    ContactFrame& frame = batch.contacts[contact];
    frame.impulse += frame.basis * j;
    batch.push(frame, j);
    jointedChanged(queue, contact);
}

template <class Queue>
void QueueSolver::jointedChanged(Queue& queue, std::uint32_t contact) {
    const ContactFrame& frame = batch.contacts[contact];
    batch.joints.forChanged(frame, [&](std::uint32_t body, const Twist& change) {
        if (batch.bodies[body].mass_inv > 0) rows.update(body, {change.v, change.w}, delta_);
    });
    batch.joints.forChanged(frame, [&](std::uint32_t body, const Twist&) {
        if (batch.bodies[body].mass_inv > 0) queue.bodyChanged(body);
    });
}

template <class Queue>
void QueueSolver::freeChanged(Queue& queue, std::uint32_t contact, const ContactChange& change) {
    const ContactFrame& frame = batch.contacts[contact];
    // A body of infinite mass keeps its velocity and with it the δ of its contacts.
    const bool a_changes = batch.bodies[frame.a].mass_inv > 0;
    const bool b_changes = batch.bodies[frame.b].mass_inv > 0;
    if (a_changes) rows.update(frame.a, change.a, delta_);
    if (b_changes) rows.update(frame.b, change.b, delta_);
    // Only now, with the contacts of both bodies complete, may the queue look at δ.
    if (a_changes) queue.bodyChanged(frame.a);
    if (b_changes) queue.bodyChanged(frame.b);
}

/// As the end of resolve(), with another law than the thesis's.
template <class Queue>
void QueueSolver::resolveByLaw(Queue& queue, std::uint32_t contact, const Vec3& velocity) {
    ContactFrame& frame = batch.contacts[contact];
    const ContactWrench wrench = law_.resolve(contact, batch, velocity);
    const bool turns = !wrench.angular.isZero(0);
    if (batch.joints.holds(frame)) {
        pushJointed(queue, contact, wrench.impulse);
        if (!turns) return;
        batch.turn(frame, wrench.angular);
        jointedChanged(queue, contact);
        return;
    }
    LocalBody& a = batch.bodies[frame.a];
    LocalBody& b = batch.bodies[frame.b];
    ContactChange change = applyImpulse(frame, wrench.impulse, a, b);
    if (turns) {
        const Vec3 w_a = a.w;
        const Vec3 w_b = b.w;
        batch.turn(frame, wrench.angular);
        change.a.w += a.w - w_a;
        change.b.w += b.w - w_b;
    }
    freeChanged(queue, contact, change);
}

/// Lines 12–23 of Algorithm 9. @return 1 if the contact was resolved, 0 if it turned out not to close
template <class Queue>
std::int64_t QueueSolver::resolve(Queue& queue, std::uint32_t contact) {
    batch.prepare(contact);
    ContactFrame& frame = batch.contacts[contact];
    LocalBody& a = batch.bodies[frame.a];
    LocalBody& b = batch.bodies[frame.b];
    const Vec3 velocity = relativeVelocity(frame, a, b);
    // δ follows the velocities by adding up their changes; its rounding errors end here, where its value matters.
    const bool usable = std::isfinite(velocity[0]) && isResolvable(frame);
    const double delta = velocity[0] + law_.allowedClosing(contact);
    if (!(delta < threshold_) || !usable) {
        // What is not finite is never touched again, so that it cannot spread.
        delta_[contact] = usable ? delta : never;
        queue.contactOpened(contact);
        return 0;
    }
    delta_[contact] = delta;
    if (!law_.isThesis()) {
        resolveByLaw(queue, contact, velocity);
        return 1;
    }
    const Vec3 j = contactImpulse(frame, velocity, settings_.restitution_threshold);
    if (batch.joints.holds(frame)) {
        pushJointed(queue, contact, j);
        return 1;
    }
    freeChanged(queue, contact, applyImpulse(frame, j, a, b));
    return 1;
}

namespace {

/// Algorithm 9 for the whole batch, then Algorithm 10 if that was not enough.
class ImpulseQueueResolution final : public BatchResolution {
  public:
    explicit ImpulseQueueResolution(const QueueConstants& constants)
        : constants_(constants), solver_(constants.queue_switch) {}

    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings, const Executor&) override {
        ResolutionCounts counts;
        solver_.begin(batch, contacts, bodies, settings);
        all_.resize(batch.contacts.size());
        std::iota(all_.begin(), all_.end(), 0U);
        const RunOutcome outcome = runAll(settings, counts);
        if (outcome.still_closing && settings.shock_propagation) {
            solver_.batch.save(before_shock_);
            const ShockOutcome shock = shock_propagation_.run(solver_, constants_.shock_iterations);
            counts.shock_iterations = shock.iterations;
            counts.shock_batches = shock.stages > 0 ? 1 : 0;
            if (shock.stages > 0 && hasStillSupports(batch, contacts, bodies)) boundEnergy(bodies);
        }
        solver_.batch.scatter(batch, contacts, bodies);
        return counts;
    }

  private:
    /// Contacts, and between them ropes, limits and motors, until neither changes the other.
    RunOutcome runAll(const ResolutionSettings& settings, ResolutionCounts& counts) {
        LocalBatch& batch = solver_.batch;
        batch.joints.resolveBounds(batch.bodies, settings.resolution_threshold);
        for (int round = 1;; ++round) {
            const RunOutcome outcome = solver_.run(all_, settings.iterations);
            counts.global_iterations += outcome.iterations;
            if (outcome.still_closing || round == most_rounds) return outcome;
            if (!batch.joints.resolveBounds(batch.bodies, settings.resolution_threshold)) return outcome;
        }
    }

    /// A body that becomes immovable while it moves drives what comes after it like a wall: with energy that nothing
    /// has. Where that leaves the batch more than it had before the resolution, or than the contacts' law and motors
    /// gave it before the shock propagation, only the part of the shock propagation that does not is kept.
    /// @param bodies with the velocities before the resolution
    void boundEnergy(const BodyState& bodies) {
        LocalBatch& batch = solver_.batch;
        EnergyGain global;
        EnergyGain shock;
        double energy = 0;
        for (std::size_t i = 0; i < batch.dynamic_bodies; ++i) {
            const LocalBody& body = batch.bodies[i];
            const BodyMotion begin{bodies.v[body.slot], bodies.w[body.slot]};
            const BodyMotion& before = before_shock_.motion[i];
            energy += kineticEnergyOf(bodies, body.slot, begin);
            global.add(bodies, body.slot, begin, before);
            shock.add(bodies, body.slot, before, {body.v, body.w});
        }
        const double allowed = std::max(0.0, -global.whole());
        if (!(shock.whole() > allowed + energy_rounding * energy)) return;
        batch.keepPartSince(before_shock_, shock.largestPart(allowed));
    }

    static constexpr int most_rounds = 20;

    QueueConstants constants_;
    QueueSolver solver_;
    ShockPropagation shock_propagation_;
    std::vector<std::uint32_t> all_;
    ResolvedSoFar before_shock_;
};

}  // namespace

std::unique_ptr<BatchResolution> makeImpulseQueueResolution(const QueueConstants& constants) {
    return std::make_unique<ImpulseQueueResolution>(constants);
}

}  // namespace cairn
