#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "resolution/algorithms.h"
#include "resolution/contact_law.h"
#include "resolution/impulse.h"
#include "resolution/local_batch.h"

namespace cairn {

namespace {

/// What changes of a contact while its batch is swept; contact coordinates.
struct SweptContact {
    Vec3 impulse;                   ///< accumulated, on A [N·s]; always in the friction cone after a sweep
    Vec3 direction;                 ///< last direction of the conjugate gradients [N·s]
    double friction = 0;            ///< coefficient that holds at present: static, once it slides kinetic
    Vec3 before;                    ///< impulse at the beginning of the sweep [N·s]
    double target = 0;              ///< normal velocity that the contact must at least have [m/s]
    Symmetric3 k;                   ///< K [1/kg]
    double largest_tangential = 0;  ///< eigenvalue of K's tangential part [1/kg]
};

/// Likewise the angular impulse of a contact that resists rolling.
struct SweptRolling {
    Vec3 impulse = Vec3::Zero();    ///< accumulated, on A [N·m·s]
    Vec3 direction = Vec3::Zero();  ///< last direction of the conjugate gradients [N·m·s]
    Vec3 before = Vec3::Zero();     ///< at the beginning of the sweep [N·m·s]
};

/// Rounds of slidingSteps() in every visit of a sliding contact. The sweeps converge with any number; a few save
/// sweeps.
constexpr int sliding_rounds = 4;

/// Largest eigenvalue of the tangential part of K [1/kg].
double largestTangential(const Symmetric3& k) {
    const double mean = (k.yy + k.zz) / 2;
    const double half = (k.yy - k.zz) / 2;
    return mean + std::sqrt(half * half + k.yz * k.yz);
}

/// The accumulated impulse of a contact that slides: in turns the normal part gives the target velocity and the
/// tangential part is moved against the sliding velocity and put back onto the friction cone. What stays the same under
/// this is Coulomb's law: friction exactly against the sliding. The direction of the impulse that would stop the
/// sliding at once, which the law of a single impact takes, is another one wherever the normal and tangential
/// directions are coupled, and lets a sliding box feel too little friction.
/// @param velocity ϑA − ϑB less the target, with the present impulse [m/s, contact coordinates]
Vec3 slidingSteps(const SweptContact& contact, const Vec3& velocity) {
    const double step = 1 / contact.largest_tangential;
    Vec3 j = contact.impulse;
    Vec3 c = velocity;
    for (int round = 0; round < sliding_rounds; ++round) {
        const double normal = std::max(0.0, j[0] - c[0] / contact.k.xx);
        c += contact.k * Vec3(normal - j[0], 0, 0);
        Vec3 next(normal, j[1] - step * c[1], j[2] - step * c[2]);
        const double tangential = std::sqrt(next[1] * next[1] + next[2] * next[2]);
        const double limit = contact.friction * normal;
        if (tangential > limit) {
            next[1] *= limit / tangential;
            next[2] *= limit / tangential;
        }
        c += contact.k * Vec3(0, next[1] - j[1], next[2] - j[2]);
        j = next;
    }
    return j;
}

/// The accumulated impulse that gives the contact its target velocity and stops its sliding, within the friction cone.
/// @param velocity ϑA − ϑB with the present impulse [m/s, contact coordinates]
Vec3 projectedImpulse(const ContactFrame& frame, const SweptContact& contact, const Vec3& velocity) {
    const Vec3 excess(velocity[0] - contact.target, velocity[1], velocity[2]);
    const Vec3 stick = contact.impulse - frame.k_inv * excess;
    const double tangential = stick[1] * stick[1] + stick[2] * stick[2];
    const double cone = contact.friction * stick[0];
    if (stick[0] > 0 && tangential <= cone * cone) return stick;
    return slidingSteps(contact, excess);
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
        counts.global_iterations = sweepUntilSteady(settings);
        // Only what static friction cannot hold slides. Where both are the same this costs nothing.
        if (releaseSliding(settings)) counts.global_iterations += sweepUntilSteady(settings);
        finish(batch, contacts, bodies);
        return counts;
    }

  private:
    /// How much a sweep changed.
    struct Change {
        double squared = 0;        ///< of the impulses, weighted by K00: twice an energy [J]
        double largest_speed = 0;  ///< largest change of a contact's velocity by its own impulse [m/s]
    };

    /// @return contacts visited
    std::int64_t sweepUntilSteady(const ResolutionSettings& settings) {
        std::int64_t visited = 0;
        double squared_gradient = 0;
        for (std::int64_t sweep = 1;; ++sweep) {
            const bool bounds_changed = local_.joints.resolveBounds(local_.bodies, settings.resolution_threshold);
            noteBefore();
            for (std::size_t i = 0; i < swept_.size(); ++i) resolveContact(i);
            for (std::size_t i = swept_.size(); i-- > 0;) resolveContact(i);
            visited += 2 * static_cast<std::int64_t>(swept_.size());
            const Change change = changeOfSweep();
            const bool steady = !(change.largest_speed > settings.resolution_threshold) && !bounds_changed;
            if (steady || sweep >= settings.sweep_limit) break;
            const bool descends = !bounds_changed && squared_gradient > 0 && change.squared <= squared_gradient;
            accelerate(descends ? change.squared / squared_gradient : 0);
            squared_gradient = change.squared;
        }
        return visited;
    }

    /// Gives the contacts that slide their kinetic friction. @return whether any has another one now
    bool releaseSliding(const ResolutionSettings& settings) {
        // What is slower than this only has not converged yet.
        const double sliding = 10 * settings.resolution_threshold;
        bool released = false;
        for (std::size_t i = 0; i < swept_.size(); ++i) {
            const ContactFrame& frame = local_.contacts[i];
            if (!(frame.kinetic_friction < frame.static_friction) || !(swept_[i].impulse[0] > 0)) continue;
            const Vec3 velocity = local_.velocityOf(frame);
            if (velocity[1] * velocity[1] + velocity[2] * velocity[2] <= sliding * sliding) continue;
            swept_[i].friction = frame.kinetic_friction;
            released = true;
        }
        return released;
    }

    void begin(const BatchView& batch, std::span<const Contact> contacts, const ResolutionSettings& settings) {
        law_.begin(batch, contacts, local_, settings);
        rolling_.assign(local_.rolling.size(), {});
        swept_.resize(local_.contacts.size());
        bodies_before_.resize(local_.dynamic_bodies);
        body_direction_.assign(local_.dynamic_bodies, {Vec3::Zero(), Vec3::Zero()});
        for (std::size_t i = 0; i < swept_.size(); ++i) {
            const ContactFrame& frame = local_.contacts[i];
            const double closing = local_.velocityOf(frame)[0];
            SweptContact& s = swept_[i];
            s.k = local_.collisionMatrixOf(frame);
            s.friction = frame.static_friction;
            s.largest_tangential = largestTangential(s.k);
            s.target = law_.separatingSpeed(i, frame, closing);
            s.impulse = frame.basis.transpose() * contacts[batch.contacts[i]].last_impulse;
            if (!(s.impulse[0] > 0) || !isResolvable(frame)) s.impulse.setZero();
            s.direction.setZero();
        }
        for (std::size_t i = 0; i < swept_.size(); ++i) local_.push(local_.contacts[i], swept_[i].impulse);
    }

    void noteBefore() {
        for (SweptContact& s : swept_) s.before = s.impulse;
        for (SweptRolling& s : rolling_) s.before = s.impulse;
        for (std::size_t i = 0; i < bodies_before_.size(); ++i) {
            bodies_before_[i] = {local_.bodies[i].v, local_.bodies[i].w};
        }
    }

    void resolveContact(std::size_t i) {
        const ContactFrame& frame = local_.contacts[i];
        const Vec3 velocity = local_.velocityOf(frame);
        if (!isResolvable(frame) || !velocity.allFinite()) return;
        if (frame.rolling != ContactFrame::rolls_freely) {
            resolveRolling(i);
            return;
        }
        const Vec3 impulse = projectedImpulse(frame, swept_[i], velocity);
        local_.push(frame, impulse - swept_[i].impulse);
        swept_[i].impulse = impulse;
    }

    void resolveRolling(std::size_t i) {
        const ContactFrame& frame = local_.contacts[i];
        SweptContact& swept = swept_[i];
        SweptRolling& turned = rolling_[frame.rolling];
        Vec6 excess = relativeTwist(frame, local_.bodies[frame.a], local_.bodies[frame.b]);
        excess[0] -= swept.target;
        Vec6 present;
        present << swept.impulse, turned.impulse;
        const Vec6 next = solveRolling(local_.rolling[frame.rolling], swept.friction, swept.friction, excess, present,
                                       RollingRounds::few);
        local_.push(frame, next.head<3>() - swept.impulse);
        local_.turn(frame, next.tail<3>() - turned.impulse);
        swept.impulse = next.head<3>();
        turned.impulse = next.tail<3>();
    }

    Change changeOfSweep() const {
        Change change;
        for (std::size_t i = 0; i < swept_.size(); ++i) {
            const Vec3 difference = swept_[i].impulse - swept_[i].before;
            const Vec3& k_row = local_.contacts[i].k_row;
            change.squared += k_row[0] * difference.squaredNorm();
            change.largest_speed = std::max(change.largest_speed, (swept_[i].k * difference).norm());
        }
        if (!rolling_.empty()) addRolling(change);
        return change;
    }

    void addRolling(Change& change) const {
        for (std::size_t i = 0; i < swept_.size(); ++i) {
            const std::uint32_t rolling = local_.contacts[i].rolling;
            if (rolling == ContactFrame::rolls_freely) continue;
            const Mat6& k = local_.rolling[rolling].k;
            const Vec3 difference = rolling_[rolling].impulse - rolling_[rolling].before;
            change.squared += k(3, 3) * difference.squaredNorm();
            change.largest_speed = std::max(change.largest_speed, (k.topRightCorner<3, 3>() * difference).norm());
        }
    }

    /// Adds β times the last direction to impulses and velocities; the new direction is the sweep's change plus that.
    void accelerate(double beta) {
        for (SweptContact& s : swept_) {
            const Vec3 change = s.impulse - s.before;
            const Vec3 step = beta * s.direction;
            s.impulse += step;
            s.direction = change + step;
        }
        for (SweptRolling& s : rolling_) {
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
        for (const ContactFrame& frame : local_.contacts) {
            if (frame.rolling == ContactFrame::rolls_freely) continue;
            local_.rolling[frame.rolling].impulse_W = frame.basis * rolling_[frame.rolling].impulse;
        }
        local_.joints.settle(local_.contacts, local_.rolling, local_.bodies);
        local_.scatter(batch, contacts, bodies);
    }

    LocalBatch local_;
    ContactLaw law_;
    std::vector<SweptContact> swept_;    ///< [contacts]
    std::vector<SweptRolling> rolling_;  ///< as LocalBatch::rolling
    std::vector<Twist> bodies_before_;   ///< [dynamic bodies] at the beginning of the sweep
    std::vector<Twist> body_direction_;  ///< [dynamic bodies] last direction
};

}  // namespace

std::unique_ptr<Resolution> makeAcceleratedSweepsResolution() {
    return std::make_unique<AcceleratedSweepsResolution>();
}

}  // namespace cairn
