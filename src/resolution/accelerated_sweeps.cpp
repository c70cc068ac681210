#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <vector>

#include "resolution/algorithms.h"
#include "resolution/contact_colours.h"
#include "resolution/contact_law.h"
#include "resolution/direct_step.h"
#include "resolution/local_batch.h"
#include "resolution/sweep_direction.h"
#include "resolution/swept_contact.h"

namespace cairn {

namespace {

/// Batches with at least so many contacts are swept by colours, and by all threads. In smaller ones the order of the
/// contacts, from body to body, carries impulses farther in a sweep.
constexpr std::size_t shared_contacts = 512;

/// Fewest pairs of a colour worth a thread of their own.
constexpr std::size_t pair_grain = 24;

/// Fewest contacts or bodies worth a thread of their own in simple loops.
constexpr std::size_t loop_grain = 256;

/// Plain sweeps before the first direct step: they find out which contacts push and stick.
constexpr std::int64_t sweeps_before_leap = 3;

/// A direct step is taken back unless it leaves less than this part of the squared change of a sweep.
constexpr double worthwhile = 0.25;

/// Whether the contacts of a batch need their frames: joints and rolling friction work with those.
bool needsFrames(const BatchView& batch, std::span<const Contact> contacts) {
    return !batch.joints.empty() || std::ranges::any_of(batch.contacts, [&](std::uint32_t i) {
        return contacts[i].rolling_friction > 0 || contacts[i].spinning_friction > 0;
    });
}

/// Sweeps over the contacts, forth and back, with accumulated impulses that begin where the last step ended, and
/// accelerates the sweeps by the nonsmooth nonlinear conjugate gradient method: the change of the impulses by a sweep
/// is taken as the negative gradient. Sweeping back as well as forth keeps the contacts of a body alike, so that
/// resting piles do not creep, and makes a sweep a symmetric preconditioner.
/// @source Silcowitz-Hansen, Niebe, Erleben: A nonsmooth nonlinear conjugate gradient method for interactive contact
///         force problems, The Visual Computer 26 (2010), doi:10.1007/s00371-010-0502-6
class AcceleratedSweepsResolution final : public Resolution {
  public:
    std::size_t sharedFrom() const override { return shared_contacts; }

    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings, const Executor& executor) override {
        begin(batch, contacts, bodies, settings, executor);
        ResolutionCounts counts;
        counts.global_iterations = sweepUntilSteady(settings, executor);
        // Only what static friction cannot hold slides. Where both are the same this costs nothing.
        if (releaseSliding(contacts, batch, settings)) counts.global_iterations += sweepUntilSteady(settings, executor);
        finish(batch, contacts, bodies, executor);
        return counts;
    }

  private:
    /// @return contacts visited
    std::int64_t sweepUntilSteady(const ResolutionSettings& settings, const Executor& executor) {
        const std::int64_t limit = sweepLimit(settings);
        bool may_leap =
            !moving_ && !framed_ && local_.dynamic_bodies <= static_cast<std::size_t>(settings.direct_limit);
        bool leapt = false;   // the impulses were changed by a direct step, which the next sweep judges
        double gradient = 0;  // squared change of the last sweep; 0 = there is no direction
        const SweepDirection::Swept swept{swept_, rolling_, local_, executor};
        std::int64_t sweep = 1;
        for (;; ++sweep) {
            const bool bounds_changed = local_.joints.resolveBounds(local_.bodies, settings.resolution_threshold);
            if (sweep >= limit && !leapt) {
                sweepOnce(executor);
                break;
            }
            direction_.note(swept);
            sweepOnce(executor);
            const SweepChange change = direction_.change(swept);
            const bool fails = leapt && !(change.squared < worthwhile * gradient);
            if (fails) goBack();
            if (leapt) gradient = 0;
            leapt = false;
            may_leap = may_leap && !fails;
            const bool steady = !(change.largest_speed > settings.sweep_tolerance) && !bounds_changed;
            if (steady || sweep >= limit) break;
            if (fails) continue;
            if (may_leap && sweep >= sweeps_before_leap && direct_.compute(local_, swept_)) {
                leap();
                leapt = true;
            } else {
                const bool descends = !bounds_changed && gradient > 0 && change.squared <= gradient;
                if (gradient == 0) direction_.restart(swept);
                direction_.accelerate(descends ? change.squared / gradient : 0, swept);
            }
            gradient = change.squared;
        }
        return 2 * sweep * static_cast<std::int64_t>(swept_.size());
    }

    /// Batches at rest are swept until they converge, large ones only as far as the budget goes.
    std::int64_t sweepLimit(const ResolutionSettings& settings) const {
        if (moving_ || swept_.empty()) return settings.moving_sweep_limit;
        if (settings.visit_limit == 0) return settings.sweep_limit;
        const std::int64_t affordable = settings.visit_limit / (2 * static_cast<std::int64_t>(swept_.size()));
        return std::min(std::max(affordable, settings.moving_sweep_limit), settings.sweep_limit);
    }

    /// Takes the direct step, as far as the friction cones allow it.
    void leap() {
        kept_.resize(swept_.size());
        for (std::size_t i = 0; i < swept_.size(); ++i) {
            const SweptContact& s = swept_[i];
            kept_[i] = s.impulse;
            const Vec3 wanted = s.impulse + direct_.changes()[i];
            const double normal = s.normal.dot(wanted);
            setImpulse(i, normal > 0 ? ontoCone(s, normal, wanted - normal * s.normal) : Vec3(Vec3::Zero()));
        }
    }

    /// Undoes it.
    void goBack() {
        for (std::size_t i = 0; i < swept_.size(); ++i) setImpulse(i, kept_[i]);
    }

    void setImpulse(std::size_t i, const Vec3& impulse) {
        push(swept_[i], impulse - swept_[i].impulse);
        swept_[i].impulse = impulse;
    }

    /// Forth and back.
    void sweepOnce(const Executor& executor) {
        if (framed_) {
            sweep(executor, [this](std::size_t i) { visitFramed(i); });
        } else {
            sweep(executor, [this](std::size_t i) { visit(swept_[i]); });
        }
    }

    template <class Visit>
    void sweep(const Executor& executor, const Visit& visit_place) {
        for (std::size_t c = 0; c < colours_.colours(); ++c) {
            forPairs(c, executor, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) visit_place(i);
            });
        }
        for (std::size_t c = colours_.colours(); c-- > 0;) {
            forPairs(c, executor, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = end; i-- > begin;) visit_place(i);
            });
        }
    }

    /// Calls work(begin, end) for places of a colour, on several threads where that is allowed and worth it.
    template <class Work>
    void forPairs(std::size_t colour, const Executor& executor, const Work& work) {
        const auto places = [&](std::size_t begin, std::size_t end, int) {
            work(colours_.begin(colour, begin), colours_.begin(colour, end));
        };
        if (colours_.isShared(colour)) {
            executor.forBlocks(colours_.pairs(colour), places, pair_grain);
        } else {
            places(0, colours_.pairs(colour), 0);
        }
    }

    void visit(SweptContact& contact) {
        LocalBody& a = local_.bodies[contact.a];
        LocalBody& b = local_.bodies[contact.b];
        const Vec3 impulse = projectedImpulse(contact, relativeVelocity(contact, a, b));
        // False for velocities that are not finite: they would spread.
        const bool usable = impulse.squaredNorm() < std::numeric_limits<double>::infinity();
        if (!usable || !isResolvable(contact)) return;
        push(contact, impulse - contact.impulse);
        contact.impulse = impulse;
    }

    void visitFramed(std::size_t place) {
        SweptContact& contact = swept_[place];
        const ContactFrame& frame = local_.contacts[place];
        const Vec3 velocity = relativeVelocity(contact, local_.bodies[contact.a], local_.bodies[contact.b]);
        if (!isResolvable(contact) || !velocity.allFinite()) return;
        if (frame.rolling != ContactFrame::rolls_freely) {
            visitRolling(contact, frame);
            return;
        }
        const Vec3 impulse = projectedImpulse(contact, velocity);
        local_.pushWorld(frame, impulse - contact.impulse);
        contact.impulse = impulse;
    }

    void visitRolling(SweptContact& contact, const ContactFrame& frame) {
        SweptRolling& turned = rolling_[frame.rolling];
        Vec6 excess = relativeTwist(frame, local_.bodies[frame.a], local_.bodies[frame.b]);
        excess[0] -= contact.target;
        Vec6 present;
        present << frame.basis.transpose() * contact.impulse, turned.impulse;
        const Vec6 next = solveRolling(local_.rolling[frame.rolling], contact.friction, contact.friction, excess,
                                       present, RollingRounds::few);
        const Vec3 impulse = frame.basis * next.head<3>();
        local_.pushWorld(frame, impulse - contact.impulse);
        local_.turn(frame, next.tail<3>() - turned.impulse);
        contact.impulse = impulse;
        turned.impulse = next.tail<3>();
    }

    /// @param impulse on A [N·s]
    void push(const SweptContact& contact, const Vec3& impulse) {
        LocalBody& a = local_.bodies[contact.a];
        LocalBody& b = local_.bodies[contact.b];
        // A fixed body may touch several bodies of a colour: threads may read it, but not write it.
        if (!local_.isFixed(contact.a)) {
            a.v += a.mass_inv * impulse;
            a.w += a.inertia_inv * contact.r_a.cross(impulse);
        }
        if (!local_.isFixed(contact.b)) {
            b.v -= b.mass_inv * impulse;
            b.w -= b.inertia_inv * contact.r_b.cross(impulse);
        }
    }

    /// Gives the contacts that slide their kinetic friction. @return whether any has another one now
    bool releaseSliding(std::span<const Contact> contacts, const BatchView& batch, const ResolutionSettings& settings) {
        if (!has_two_frictions_) return false;
        // What is slower than this only has not converged yet.
        const double sliding = 10 * settings.resolution_threshold;
        bool released = false;
        for (std::size_t i = 0; i < swept_.size(); ++i) {
            SweptContact& s = swept_[i];
            const Contact& contact = contacts[batch.contacts[colours_.order()[i]]];
            if (!(contact.kinetic_friction < contact.static_friction) || !(s.normal.dot(s.impulse) > 0)) continue;
            const Vec3 velocity = relativeVelocity(s, local_.bodies[s.a], local_.bodies[s.b]);
            if ((velocity - s.normal.dot(velocity) * s.normal).squaredNorm() <= sliding * sliding) continue;
            s.friction = contact.kinetic_friction;
            released = true;
        }
        return released;
    }

    void begin(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies,
               const ResolutionSettings& settings, const Executor& executor) {
        framed_ = needsFrames(batch, contacts);
        if (framed_) {
            local_.gather(batch, contacts, bodies);
        } else {
            local_.gatherBodies(batch, contacts, bodies);
        }
        rolling_.assign(framed_ ? local_.rolling.size() : 0, {});
        const std::size_t count = batch.contacts.size();
        if (!framed_ && count >= shared_contacts) {
            colours_.colour(local_.ends, local_.dynamic_bodies);
        } else {
            colours_.keepOrder(count);
        }
        swept_.resize(count);
        moving_ = false;
        has_two_frictions_ = false;
        for (const std::uint32_t i : batch.contacts) {
            has_two_frictions_ = has_two_frictions_ || contacts[i].kinetic_friction < contacts[i].static_friction;
        }
        executor.forBlocks(
            count,
            [&](std::size_t first, std::size_t last, int) {
                for (std::size_t i = first; i < last; ++i) {
                    beginContact(i, contacts[batch.contacts[colours_.order()[i]]], bodies, settings);
                }
            },
            loop_grain);
        warmStart(executor);
    }

    void beginContact(std::size_t place, const Contact& contact, const BodyState& bodies,
                      const ResolutionSettings& settings) {
        SweptContact& s = swept_[place];
        const ContactEnds& ends = local_.ends[colours_.order()[place]];
        s.a = ends.a;
        s.b = ends.b;
        s.normal = contact.normal;
        s.r_a = contact.point - bodies.position[contact.a];
        s.r_b = contact.point - bodies.position[contact.b];
        const LocalBody& a = local_.bodies[s.a];
        const LocalBody& b = local_.bodies[s.b];
        Symmetric3 k;
        if (framed_ && local_.joints.holds(local_.contacts[place])) {
            const ContactFrame& frame = local_.contacts[place];
            k = Symmetric3::from(frame.basis * local_.collisionMatrixOf(frame).toMatrix() * frame.basis.transpose());
        } else {
            addCollisionMatrix(a, s.r_a, k);
            addCollisionMatrix(b, s.r_b, k);
        }
        setCollisionMatrix(s, k);
        s.friction = contact.static_friction;
        const double closing = s.normal.dot(relativeVelocity(s, a, b));
        if (closing < -settings.restitution_threshold) moving_.store(true, std::memory_order_relaxed);
        s.target = ContactLaw::separatingSpeed(settings, contact, closing);
        s.impulse = contact.last_impulse;
        if (!(s.normal.dot(s.impulse) > 0) || !isResolvable(s)) s.impulse.setZero();
    }

    void warmStart(const Executor& executor) {
        for (std::size_t c = 0; c < colours_.colours(); ++c) {
            forPairs(c, executor, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    if (framed_) {
                        local_.pushWorld(local_.contacts[i], swept_[i].impulse);
                    } else {
                        push(swept_[i], swept_[i].impulse);
                    }
                }
            });
        }
    }

    void finish(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                const Executor& executor) {
        if (framed_) settleFrames(batch, contacts);
        for (std::size_t i = 0; i < local_.dynamic_bodies; ++i) local_.bodies[i].struck = 1;
        local_.scatterBodies(bodies);
        executor.forBlocks(
            swept_.size(),
            [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t i = begin; i < end; ++i) {
                    contacts[batch.contacts[colours_.order()[i]]].impulse += swept_[i].impulse;
                }
            },
            loop_grain);
    }

    /// Finds the impulses of the joints, and writes those of the rolling contacts.
    void settleFrames(const BatchView& batch, std::span<Contact> contacts) {
        for (std::size_t i = 0; i < swept_.size(); ++i) {
            ContactFrame& frame = local_.contacts[i];
            frame.impulse = swept_[i].impulse;
            if (frame.rolling == ContactFrame::rolls_freely) continue;
            RollingContact& rolling = local_.rolling[frame.rolling];
            rolling.impulse_W = frame.basis * rolling_[frame.rolling].impulse;
            contacts[batch.contacts[i]].angular_impulse += rolling.impulse_W;
        }
        local_.joints.settle(local_.contacts, local_.rolling, local_.bodies);
        local_.joints.scatter();
    }

    LocalBatch local_;
    ContactColours colours_;
    DirectStep direct_;
    SweepDirection direction_;
    bool framed_ = false;                ///< local_ has frames, and the contacts are in the batch's order
    std::atomic<bool> moving_ = false;   ///< some contact closes faster than one at rest does
    bool has_two_frictions_ = false;     ///< kinetic friction is less than static friction somewhere
    std::vector<SweptContact> swept_;    ///< [contacts] in colour order
    std::vector<SweptRolling> rolling_;  ///< as LocalBatch::rolling
    std::vector<Vec3> kept_;             ///< [contacts] impulses before a direct step [N·s]
};

}  // namespace

std::unique_ptr<Resolution> makeAcceleratedSweepsResolution() {
    return std::make_unique<AcceleratedSweepsResolution>();
}

}  // namespace cairn
