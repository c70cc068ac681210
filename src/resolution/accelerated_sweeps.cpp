#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "resolution/algorithms.h"
#include "resolution/contact_colours.h"
#include "resolution/contact_law.h"
#include "resolution/direct_step.h"
#include "resolution/impulse.h"
#include "resolution/local_batch.h"
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

/// Contacts whose changes are added up together: fixed, so that sums do not depend on the number of threads.
constexpr std::size_t sum_block = 256;

/// The angular impulse of a contact that resists rolling; contact coordinates.
struct SweptRolling {
    Vec3 impulse = Vec3::Zero();    ///< accumulated, on A [N·m·s]
    Vec3 direction = Vec3::Zero();  ///< last direction of the conjugate gradients [N·m·s]
    Vec3 before = Vec3::Zero();     ///< at the beginning of the sweep [N·m·s]
};

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
        if (isAtSleep(batch, contacts, bodies)) {
            for (const std::uint32_t i : batch.contacts) contacts[i].impulse += contacts[i].last_impulse;
            return {};
        }
        begin(batch, contacts, bodies, settings, executor);
        ResolutionCounts counts;
        counts.global_iterations = sweepUntilSteady(settings, executor);
        // Only what static friction cannot hold slides. Where both are the same this costs nothing.
        if (releaseSliding(contacts, batch, settings)) counts.global_iterations += sweepUntilSteady(settings, executor);
        finish(batch, contacts, bodies, executor);
        return counts;
    }

  private:
    /// How much a sweep changed.
    struct Change {
        double squared = 0;        ///< of the impulses, weighted by the normal part of K: twice an energy [J]
        double largest_speed = 0;  ///< largest change of a contact's velocity by its own impulse [m/s]
    };

    /// Whether nothing of the batch moves or may move: its contacts go on with the impulses that they had.
    static bool isAtSleep(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
        if (!batch.joints.empty()) return false;
        const auto rests = [&](BodyIndex i) { return bodies.v[i].isZero(0) && bodies.w[i].isZero(0); };
        const auto sleeps = [&](BodyIndex i) { return bodies.asleep[i] != 0 && rests(i); };
        if (!std::ranges::all_of(batch.bodies, sleeps)) return false;
        return std::ranges::all_of(batch.contacts, [&](std::uint32_t i) {
            const Contact& contact = contacts[i];
            return (!bodies.isFixed(contact.a) || rests(contact.a)) && (!bodies.isFixed(contact.b) || rests(contact.b));
        });
    }

    /// @return contacts visited
    std::int64_t sweepUntilSteady(const ResolutionSettings& settings, const Executor& executor) {
        const std::int64_t limit = moving_ ? settings.moving_sweep_limit : settings.sweep_limit;
        bool may_leap =
            !moving_ && !framed_ && local_.dynamic_bodies <= static_cast<std::size_t>(settings.direct_limit);
        bool leapt = false;   // the impulses were changed by a direct step, which the next sweep judges
        double gradient = 0;  // squared change of the last sweep; 0 = there is no direction
        std::int64_t sweep = 1;
        for (;; ++sweep) {
            const bool bounds_changed = local_.joints.resolveBounds(local_.bodies, settings.resolution_threshold);
            if (sweep >= limit && !leapt) {
                sweepOnce(executor);
                break;
            }
            noteBefore(executor);
            sweepOnce(executor);
            const Change change = changeOfSweep(executor);
            const bool fails = leapt && !(change.squared < gradient);
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
                accelerate(descends ? change.squared / gradient : 0, gradient == 0, executor);
            }
            gradient = change.squared;
        }
        return 2 * sweep * static_cast<std::int64_t>(swept_.size());
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
        a.v += a.mass_inv * impulse;
        a.w += a.inertia_inv * contact.r_a.cross(impulse);
        b.v -= b.mass_inv * impulse;
        b.w -= b.inertia_inv * contact.r_b.cross(impulse);
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

    void noteBefore(const Executor& executor) {
        impulses_before_.resize(swept_.size());
        bodies_before_.resize(local_.dynamic_bodies);
        for (SweptRolling& s : rolling_) s.before = s.impulse;
        executor.forBlocks(
            swept_.size(),
            [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t i = begin; i < end; ++i) impulses_before_[i] = swept_[i].impulse;
            },
            loop_grain);
        executor.forBlocks(
            bodies_before_.size(),
            [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t i = begin; i < end; ++i) bodies_before_[i] = {local_.bodies[i].v, local_.bodies[i].w};
            },
            loop_grain);
    }

    Change changeOfSweep(const Executor& executor) {
        sums_.resize((swept_.size() + sum_block - 1) / sum_block);
        executor.forBlocks(
            sums_.size(),
            [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t block = begin; block < end; ++block) sums_[block] = changeOfBlock(block);
            },
            1);
        Change change;
        for (const Change& part : sums_) {
            change.squared += part.squared;
            change.largest_speed = std::max(change.largest_speed, part.largest_speed);
        }
        if (!rolling_.empty()) addRolling(change);
        return change;
    }

    void addRolling(Change& change) const {
        for (const ContactFrame& frame : local_.contacts) {
            if (frame.rolling == ContactFrame::rolls_freely) continue;
            const Mat6& k = local_.rolling[frame.rolling].k;
            const Vec3 difference = rolling_[frame.rolling].impulse - rolling_[frame.rolling].before;
            change.squared += k(3, 3) * difference.squaredNorm();
            change.largest_speed = std::max(change.largest_speed, (k.topRightCorner<3, 3>() * difference).norm());
        }
    }

    Change changeOfBlock(std::size_t block) const {
        Change change;
        const std::size_t end = std::min(swept_.size(), (block + 1) * sum_block);
        for (std::size_t i = block * sum_block; i < end; ++i) {
            const SweptContact& s = swept_[i];
            if (!isResolvable(s)) continue;
            const Vec3 difference = s.impulse - impulses_before_[i];
            change.squared += difference.squaredNorm() / s.normal_mass;
            change.largest_speed = std::max(change.largest_speed, (s.k * difference).norm());
        }
        return change;
    }

    /// Adds β times the last direction to impulses and velocities; the new direction is the sweep's change plus that.
    /// @param first there is no last direction
    void accelerate(double beta, bool first, const Executor& executor) {
        if (first) {
            direction_.assign(swept_.size(), Vec3::Zero());
            for (SweptRolling& s : rolling_) s.direction.setZero();
            body_direction_.assign(local_.dynamic_bodies, {Vec3::Zero(), Vec3::Zero()});
        }
        executor.forBlocks(
            swept_.size(),
            [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t i = begin; i < end; ++i) {
                    const Vec3 change = swept_[i].impulse - impulses_before_[i];
                    const Vec3 step = beta * direction_[i];
                    swept_[i].impulse += step;
                    direction_[i] = change + step;
                }
            },
            loop_grain);
        for (SweptRolling& s : rolling_) {
            const Vec3 change = s.impulse - s.before;
            const Vec3 step = beta * s.direction;
            s.impulse += step;
            s.direction = change + step;
        }
        executor.forBlocks(
            bodies_before_.size(),
            [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t i = begin; i < end; ++i) {
                    LocalBody& body = local_.bodies[i];
                    const Twist change{body.v - bodies_before_[i].v, body.w - bodies_before_[i].w};
                    const Twist step{beta * body_direction_[i].v, beta * body_direction_[i].w};
                    body.v += step.v;
                    body.w += step.w;
                    body_direction_[i] = {change.v + step.v, change.w + step.w};
                }
            },
            loop_grain);
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
    bool framed_ = false;                ///< local_ has frames, and the contacts are in the batch's order
    std::atomic<bool> moving_ = false;   ///< some contact closes faster than one at rest does
    bool has_two_frictions_ = false;     ///< kinetic friction is less than static friction somewhere
    std::vector<SweptContact> swept_;    ///< [contacts] in colour order
    std::vector<SweptRolling> rolling_;  ///< as LocalBatch::rolling
    std::vector<Vec3> kept_;             ///< [contacts] impulses before a direct step [N·s]
    std::vector<Vec3> impulses_before_;  ///< [contacts] at the beginning of the sweep [N·s]
    std::vector<Vec3> direction_;        ///< [contacts] last direction of the conjugate gradients [N·s]
    std::vector<Twist> bodies_before_;   ///< [dynamic bodies] at the beginning of the sweep
    std::vector<Twist> body_direction_;  ///< [dynamic bodies] last direction
    std::vector<Change> sums_;           ///< [blocks]
};

}  // namespace

std::unique_ptr<Resolution> makeAcceleratedSweepsResolution() {
    return std::make_unique<AcceleratedSweepsResolution>();
}

}  // namespace cairn
