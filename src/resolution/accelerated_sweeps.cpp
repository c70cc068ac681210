#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "resolution/algorithms.h"
#include "resolution/batch_motion.h"
#include "resolution/body_direction.h"
#include "resolution/direct_step.h"
#include "resolution/plain_sweeper.h"
#include "resolution/wide_sweeper.h"

namespace cairn {

namespace {

/// Batches with at least so many contacts are swept by colours, four contacts at once. In smaller ones the order of the
/// contacts, from body to body, carries impulses farther in a sweep.
constexpr std::size_t wide_contacts = 320;

/// Batches with at least so many contacts are worth all threads together.
constexpr std::size_t shared_contacts = 1024;

/// Batches with fewer contacts need fewer sweeps while they move.
constexpr std::size_t large_contacts = 1024;

/// Plain sweeps before the first direct step: they find out which contacts push and stick.
constexpr std::int64_t sweeps_before_leap = 3;

/// How much less a sweep changes than the one before it: what is assumed after the second sweep, since the first one
/// also changes what no other contact has a part in, and the bounds within which later ones are believed. Sweeps that
/// seem not to converge at all count as slow ones.
constexpr double assumed_rate = 0.7, fastest_rate = 0.3, slowest_rate = 0.95;

/// A sweep that still changes speeds by more than lets bodies into each other by this multiple of the overlap allowed
/// is not the last one.
constexpr double safe_multiple = 4;

/// A direct step is taken back unless it leaves less than this part of the squared change of a sweep.
constexpr double worthwhile = 0.25;

/// Whether the contacts of a batch need their frames: joints and rolling friction work with those.
bool needsFrames(const BatchView& batch, std::span<const Contact> contacts) {
    return !batch.joints.empty() || std::ranges::any_of(batch.contacts, [&](std::uint32_t i) {
        return contacts[i].rolling_friction > 0 || contacts[i].spinning_friction > 0;
    });
}

bool hasTwoFrictions(const BatchView& batch, std::span<const Contact> contacts) {
    return std::ranges::any_of(
        batch.contacts, [&](std::uint32_t i) { return contacts[i].kinetic_friction < contacts[i].static_friction; });
}

/// Whether a batch is a stack, a chain or an arch. Where bodies have more neighbours than there they stand on more
/// contacts than they need, which share the load as their friction allows and not as the stiffest solution wants: then
/// direct steps only cost time.
bool isChain(const LocalBatch& local, double most_pairs) {
    if (most_pairs == 0) return true;
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < local.ends.size(); ++i) {
        const ContactEnds& ends = local.ends[i];
        if (local.isFixed(ends.a) || local.isFixed(ends.b) || (i > 0 && ends == local.ends[i - 1])) continue;
        ++pairs;
    }
    return static_cast<double>(pairs) <= most_pairs * static_cast<double>(local.dynamic_bodies);
}

/// Whether some contact closes faster than one at rest does, or more than a part of them slide or separate faster.
bool isMoving(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies,
              const ResolutionSettings& settings) {
    const double threshold = settings.restitution_threshold;
    std::size_t sliding = 0;
    for (const std::uint32_t i : batch.contacts) {
        const Vec3 velocity = relativeVelocity(contacts[i], bodies);
        if (contacts[i].normal.dot(velocity) < -threshold) return true;
        sliding += velocity.squaredNorm() > threshold * threshold ? 1 : 0;
    }
    return static_cast<double>(sliding) > settings.sliding_part * static_cast<double>(batch.contacts.size());
}

/// Estimates what all further sweeps would change, from how fast the changes become smaller: after a change c of a part
/// r of the one before it, a geometric series leaves c·r/(1 − r). Deep piles, through which impulses have a long way,
/// converge slowly and so are swept longer than shallow ones.
class RemainingChange {
  public:
    /// @param gravity what gravity gives in a step; less than the same part of it is never of interest
    explicit RemainingChange(double gravity) : gravity_(gravity) {}

    /// To be called after every sweep. @param tolerance part that may be left; 0 = never
    bool isWithin(double tolerance, double change) {
        if (tolerance == 0) return false;
        const double least = number_ == 1 ? assumed_rate : fastest_rate;
        const double rate = last_ > 0 ? std::clamp(change / last_, least, slowest_rate) : slowest_rate;
        const double left = number_ == 0 ? change : change * rate / (1 - rate);
        last_ = change;
        if (number_++ == 0) first_ = change;
        return left <= tolerance * (number_ == 1 ? gravity_ : std::max(gravity_, first_));
    }

  private:
    double gravity_;
    double first_ = 0;
    double last_ = 0;
    int number_ = 0;  ///< of sweeps
};

/// Sweeps over the contacts, forth and back, with accumulated impulses that begin where the last step ended, and
/// accelerates the sweeps by the nonsmooth nonlinear conjugate gradient method: the change of the impulses by a sweep
/// is taken as the negative gradient. Sweeping back as well as forth keeps the contacts of a body alike, so that
/// resting piles do not creep, and makes a sweep a symmetric preconditioner.
/// @source Silcowitz-Hansen, Niebe, Erleben: A nonsmooth nonlinear conjugate gradient method for interactive contact
///         force problems, The Visual Computer 26 (2010), doi:10.1007/s00371-010-0502-6
class AcceleratedSweepsResolution final : public Resolution {
  public:
    bool wantsAllThreads(const BatchView& batch, std::span<const Contact> contacts) const override {
        return batch.contacts.size() >= shared_contacts && !needsFrames(batch, contacts);
    }

    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings, const Executor& executor) override {
        const bool framed = needsFrames(batch, contacts);
        if (framed) {
            local_.gather(batch, contacts, bodies);
        } else {
            local_.gatherBodies(batch, contacts, bodies);
        }
        const bool moving = isMoving(batch, contacts, bodies, settings);
        const bool by_need = moving && settings.moving_tolerance > 0;
        const Sweeps sweeps{
            .limit = by_need ? settings.sweep_limit : sweepLimit(batch.contacts.size(), moving, settings),
            .tolerance = by_need ? settings.moving_tolerance : 0,
            .safe_speed = by_need ? safeSpeed(batch, contacts, bodies) : 0,
            .may_leap = !moving && !framed &&
                        local_.dynamic_bodies <= static_cast<std::size_t>(settings.direct_limit) &&
                        isChain(local_, settings.direct_pairs)};
        const bool wide = !framed && !sweeps.may_leap && batch.contacts.size() >= wide_contacts;
        Sweeper& sweeper = *(wide ? static_cast<Sweeper*>(&wide_) : &plain_);
        const SweptBatch swept{local_, batch, contacts, bodies, settings, executor, framed};
        sweeper.begin(swept);
        ResolutionCounts counts;
        counts.global_iterations = sweepUntilSteady(sweeper, swept, sweeps);
        // Only what static friction cannot hold slides. Where both are the same this costs nothing.
        if (hasTwoFrictions(batch, contacts) && sweeper.releaseSliding(swept)) {
            counts.global_iterations += sweepUntilSteady(sweeper, swept, sweeps);
        }
        for (std::size_t i = 0; i < local_.dynamic_bodies; ++i) local_.bodies[i].struck = 1;
        sweeper.finish(swept);
        local_.scatterBodies(bodies);
        return counts;
    }

  private:
    /// How far a batch is swept.
    struct Sweeps {
        std::int64_t limit;  ///< of sweeps
        double tolerance;    ///< part of the change that may be left; 0 = none
        double safe_speed;   ///< with which nothing gets far into another body in a step [m/s]
        bool may_leap;       ///< direct steps are allowed; only with the plain sweeper
    };

    /// @return contacts visited
    std::int64_t sweepUntilSteady(Sweeper& sweeper, const SweptBatch& swept, const Sweeps& sweeps) {
        const ResolutionSettings& settings = swept.settings;
        bool may_leap = sweeps.may_leap;
        bool leapt = false;   // the impulses were changed by a direct step, which the next sweep judges
        double gradient = 0;  // squared change of the last sweep; 0 = there is no direction
        RemainingChange remaining(sweeps.tolerance > 0 ? changeByGravity(swept) : 0);
        std::int64_t sweep = 1;
        for (;; ++sweep) {
            const bool bounds_changed = local_.joints.resolveBounds(local_.bodies, settings.resolution_threshold);
            if (sweep >= sweeps.limit && !leapt) {
                sweeper.sweep(swept);
                break;
            }
            sweeper.note(swept);
            direction_.note(local_, swept.executor);
            sweeper.sweep(swept);
            const SweepChange change = sweeper.change(swept);
            const bool fails = leapt && !(change.squared < worthwhile * gradient);
            if (fails) goBack();
            if (leapt) gradient = 0;
            leapt = false;
            may_leap = may_leap && !fails;
            const bool enough = remaining.isWithin(sweeps.tolerance, std::sqrt(change.squared)) &&
                                change.largest_speed <= sweeps.safe_speed;
            const bool steady = (!(change.largest_speed > settings.sweep_tolerance) || enough) && !bounds_changed;
            if (steady || sweep >= sweeps.limit) break;
            if (fails) continue;
            if (may_leap && sweep >= sweeps_before_leap && leap()) {
                leapt = true;
            } else {
                const bool descends = !bounds_changed && gradient > 0 && change.squared <= gradient;
                if (gradient == 0) {
                    sweeper.restart();
                    direction_.restart(local_);
                }
                const double beta = descends ? change.squared / gradient : 0;
                sweeper.accelerate(beta, swept);
                direction_.accelerate(beta, local_, swept.executor);
            }
            gradient = change.squared;
        }
        return 2 * sweep * static_cast<std::int64_t>(sweeper.size());
    }

    /// The speed with which no body of the batch gets into another one by more than a few times what is allowed.
    static double safeSpeed(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t i : batch.contacts) least = std::min(least, contacts[i].allowed_overlap);
        return safe_multiple * least / bodies.time_step;
    }

    /// What gravity gives the bodies in a step, in the measure of SweepChange.
    static double changeByGravity(const SweptBatch& swept) {
        double mass = 0;
        for (std::size_t i = 0; i < swept.local.dynamic_bodies; ++i) mass += 1 / swept.local.bodies[i].mass_inv;
        return swept.bodies.fall.norm() * std::sqrt(mass);
    }

    /// Batches at rest are swept until they converge, large ones only as far as the budget goes.
    static std::int64_t sweepLimit(std::size_t contacts, bool moving, const ResolutionSettings& settings) {
        if (moving || contacts == 0) return movingSweepLimit(contacts, settings);
        if (settings.visit_limit == 0) return settings.sweep_limit;
        const std::int64_t affordable = settings.visit_limit / (2 * static_cast<std::int64_t>(contacts));
        return std::min(std::max(affordable, settings.moving_sweep_limit), settings.sweep_limit);
    }

    /// Impulses have a shorter way through small batches.
    static std::int64_t movingSweepLimit(std::size_t contacts, const ResolutionSettings& settings) {
        if (contacts >= large_contacts) return settings.moving_sweep_limit;
        const double part = settings.small_sweep_part * static_cast<double>(settings.moving_sweep_limit);
        return std::max(std::int64_t{1}, static_cast<std::int64_t>(std::ceil(part)));
    }

    /// Takes the direct step, as far as the friction cones allow it. @return whether there is one
    bool leap() {
        const std::span<const SweptContact> contacts = plain_.contacts();
        if (!direct_.compute(local_, contacts)) return false;
        kept_.resize(contacts.size());
        for (std::size_t i = 0; i < contacts.size(); ++i) {
            const SweptContact& s = contacts[i];
            kept_[i] = s.impulse;
            const Triple1 wanted = s.impulse + Triple1(direct_.changes()[i]);
            const double normal = s.normal.dot(wanted);
            const Triple1 allowed = normal > 0 ? ontoCone(s, normal, wanted - normal * s.normal) : Triple1();
            plain_.setImpulse(i, allowed, local_);
        }
        return true;
    }

    /// Undoes it.
    void goBack() {
        for (std::size_t i = 0; i < kept_.size(); ++i) plain_.setImpulse(i, kept_[i], local_);
    }

    LocalBatch local_;
    PlainSweeper plain_;
    WideSweeper wide_;
    BodyDirection direction_;
    DirectStep direct_;
    std::vector<Triple1> kept_;  ///< [contacts] impulses before a direct step [N·s]
};

}  // namespace

std::unique_ptr<Resolution> makeAcceleratedSweepsResolution() {
    return std::make_unique<AcceleratedSweepsResolution>();
}

}  // namespace cairn
