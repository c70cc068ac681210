#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "resolution/algorithms.h"
#include "resolution/impulse.h"
#include "resolution/local_batch.h"

namespace cairn {

namespace {

/// What changes of a contact while its batch is swept; contact coordinates.
struct SweptContact {
    Vec3 impulse;       ///< accumulated, on A [N·s]; always in the friction cone after a sweep
    Vec3 direction;     ///< last direction of the conjugate gradients [N·s]
    Vec3 before;        ///< impulse at the beginning of the sweep [N·s]
    double target = 0;  ///< normal velocity that the contact must at least have [m/s]
};

/// Velocities of a body, or a direction in their space.
struct Twist {
    Vec3 v;  ///< [m/s, W]
    Vec3 w;  ///< [rad/s, W]
};

/// The accumulated impulse that gives the contact its target velocity and stops its sliding, within the friction cone.
/// @param velocity ϑA − ϑB with the present impulse [m/s, contact coordinates]
Vec3 projectedImpulse(const ContactFrame& frame, const SweptContact& contact, const Vec3& velocity) {
    const Vec3& old = contact.impulse;
    const Vec3 stick = old + frame.k_inv * Vec3(contact.target - velocity[0], -velocity[1], -velocity[2]);
    const double tangential = stick[1] * stick[1] + stick[2] * stick[2];
    const double cone = frame.static_friction * stick[0];
    if (stick[0] > 0 && tangential <= cone * cone) return stick;
    // Outside: the direction of sliding stays, the normal impulse follows from the first row of K as in (3.5.8), here
    // for the accumulated impulse.
    const double beta = tangential > 0 ? frame.kinetic_friction / std::sqrt(tangential) : 0;
    const double wanted = contact.target - velocity[0] + frame.k_row.dot(old);
    const double denominator = frame.k_row[0] + beta * (frame.k_row[1] * stick[1] + frame.k_row[2] * stick[2]);
    const double normal = denominator > 0 ? wanted / denominator : wanted / frame.k_row[0];
    if (!(normal > 0)) return Vec3::Zero();
    return {normal, beta * normal * stick[1], beta * normal * stick[2]};
}

/// Sweeps over the contacts, forth and back, with accumulated impulses that begin where the last step ended, and
/// accelerates the sweeps by the nonsmooth nonlinear conjugate gradient method: the change of the impulses by a sweep
/// is taken as the negative gradient. Sweeping back as well as forth keeps the contacts of a body alike, so that
/// resting piles do not creep, and makes a sweep a symmetric preconditioner.
/// @source Silcowitz-Hansen, Niebe, Erleben: A nonsmooth nonlinear conjugate gradient method for interactive contact
///         force problems, The Visual Computer 26 (2010), doi:10.1007/s00371-010-0502-6
class AcceleratedSweepsResolution final : public Resolution {
  public:
    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings) override {
        local_.gather(batch, contacts, bodies);
        begin(batch, contacts, settings);
        ResolutionCounts counts;
        double squared_gradient = 0;
        for (std::int64_t sweep = 1;; ++sweep) {
            noteBefore();
            for (std::size_t i = 0; i < swept_.size(); ++i) resolveContact(i);
            for (std::size_t i = swept_.size(); i-- > 0;) resolveContact(i);
            counts.global_iterations += 2 * static_cast<std::int64_t>(swept_.size());
            const Change change = changeOfSweep();
            if (!(change.largest_speed > settings.resolution_threshold) || sweep >= settings.sweep_limit) break;
            const bool descends = squared_gradient > 0 && change.squared <= squared_gradient;
            accelerate(descends ? change.squared / squared_gradient : 0);
            squared_gradient = change.squared;
        }
        finish(batch, contacts, bodies);
        return counts;
    }

  private:
    /// How much a sweep changed.
    struct Change {
        double squared = 0;        ///< of the impulses, weighted by K00: twice an energy [J]
        double largest_speed = 0;  ///< largest change of a contact's normal velocity by its own impulse [m/s]
    };

    void begin(const BatchView& batch, std::span<const Contact> contacts, const ResolutionSettings& settings) {
        swept_.resize(local_.contacts.size());
        bodies_before_.resize(local_.dynamic_bodies);
        body_direction_.assign(local_.dynamic_bodies, {Vec3::Zero(), Vec3::Zero()});
        for (std::size_t i = 0; i < swept_.size(); ++i) {
            const ContactFrame& frame = local_.contacts[i];
            const double closing = local_.velocityOf(frame)[0];
            SweptContact& s = swept_[i];
            s.target = closing < -settings.restitution_threshold ? -frame.restitution * closing : 0;
            s.impulse = frame.basis.transpose() * contacts[batch.contacts[i]].last_impulse;
            if (!(s.impulse[0] > 0) || !isResolvable(frame)) s.impulse.setZero();
            s.direction.setZero();
        }
        for (std::size_t i = 0; i < swept_.size(); ++i) push(local_.contacts[i], swept_[i].impulse);
    }

    void push(const ContactFrame& frame, const Vec3& j) {
        const Vec3 impulse = frame.basis * j;
        apply(velocityChange(local_.bodies[frame.a], frame.r_a, impulse), local_.bodies[frame.a]);
        apply(velocityChange(local_.bodies[frame.b], frame.r_b, -impulse), local_.bodies[frame.b]);
    }

    void noteBefore() {
        for (SweptContact& s : swept_) s.before = s.impulse;
        for (std::size_t i = 0; i < bodies_before_.size(); ++i) {
            bodies_before_[i] = {local_.bodies[i].v, local_.bodies[i].w};
        }
    }

    void resolveContact(std::size_t i) {
        const ContactFrame& frame = local_.contacts[i];
        const Vec3 velocity = local_.velocityOf(frame);
        if (!isResolvable(frame) || !velocity.allFinite()) return;
        const Vec3 impulse = projectedImpulse(frame, swept_[i], velocity);
        push(frame, impulse - swept_[i].impulse);
        swept_[i].impulse = impulse;
    }

    Change changeOfSweep() const {
        Change change;
        for (std::size_t i = 0; i < swept_.size(); ++i) {
            const Vec3 difference = swept_[i].impulse - swept_[i].before;
            const Vec3& k_row = local_.contacts[i].k_row;
            change.squared += k_row[0] * difference.squaredNorm();
            change.largest_speed = std::max(change.largest_speed, std::abs(k_row.dot(difference)));
        }
        return change;
    }

    /// Adds β times the last direction to impulses and velocities; the new direction is the sweep's change plus that.
    void accelerate(double beta) {
        for (SweptContact& s : swept_) {
            const Vec3 change = s.impulse - s.before;
            const Vec3 step = beta * s.direction;
            s.impulse += step;
            s.direction = change + step;
        }
        for (std::size_t i = 0; i < bodies_before_.size(); ++i) {
            LocalBody& body = local_.bodies[i];
            const Twist change{body.v - bodies_before_[i].v, body.w - bodies_before_[i].w};
            const Twist step{beta * body_direction_[i].v, beta * body_direction_[i].w};
            body.v += step.v;
            body.w += step.w;
            body_direction_[i] = {change.v + step.v, change.w + step.w};
        }
    }

    /// Writes back. Sleeping bodies wake only if they now move.
    void finish(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies) {
        for (std::size_t i = 0; i < swept_.size(); ++i) {
            local_.contacts[i].impulse = local_.contacts[i].basis * swept_[i].impulse;
        }
        local_.scatter(batch, contacts, bodies);
    }

    LocalBatch local_;
    std::vector<SweptContact> swept_;    ///< [contacts]
    std::vector<Twist> bodies_before_;   ///< [dynamic bodies] at the beginning of the sweep
    std::vector<Twist> body_direction_;  ///< [dynamic bodies] last direction
};

}  // namespace

std::unique_ptr<Resolution> makeAcceleratedSweepsResolution() {
    return std::make_unique<AcceleratedSweepsResolution>();
}

}  // namespace cairn
