#include "resolution/awake_part.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "resolution/batch_motion.h"

namespace cairn {

namespace {

/// What the contacts of a sleeping body push more than when it was awake last.
struct Disturbance {
    BodyIndex body;
    Vec3 linear = Vec3::Zero();   ///< [N·s]
    Vec3 angular = Vec3::Zero();  ///< about the centre of mass [N·m·s]
    double squared_reach = 0;     ///< of the farthest contact from the centre of mass [m²]
};

/// What a batch that is resolved in part does with a body.
enum class Part : std::uint8_t {
    free,  ///< resolves it
    held,  ///< holds it still
    along  ///< resolves it along with others, but leaves it as it was unless that pushes it
};

/// A body that is resolved along, and what it was.
struct Along {
    BodyIndex body;
    std::uint8_t asleep;
    WakeReason woken;
    double squared_reach = 0;  ///< of the farthest contact from the centre of mass [m²]
};

/// Stands for no index.
constexpr std::uint32_t none = UINT32_MAX;

class AwakePart final : public Resolution {
  public:
    AwakePart(std::unique_ptr<Resolution> resolution, Sleepers sleepers)
        : resolution_(std::move(resolution)), sleepers_(sleepers) {}

    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings, const Executor& executor) override {
        const auto sleeping = static_cast<std::size_t>(
            std::ranges::count_if(batch.bodies, [&](BodyIndex i) { return sleeps(bodies, i); }));
        const bool all = sleeping == batch.bodies.size();
        const bool some = sleepers_ == Sleepers::remain && sleeping > 0 && settings.wake_speed > 0;
        if ((all || some) && hasStillSupports(batch, contacts, bodies) && hasStillAnchors(batch, bodies)) {
            if (!all) return resolvePart(batch, contacts, bodies, settings, executor);
            for (const BodyIndex i : batch.bodies) hold(bodies, i);
            forEachContact(batch, contacts, executor, [](Contact& c) { c.impulse += c.last_impulse; });
            return {};
        }
        const ResolutionCounts counts = resolution_->resolve(batch, contacts, bodies, settings, executor);
        // Only who lets sleepers remain compares with it.
        if (sleepers_ == Sleepers::wake) return counts;
        forEachContact(batch, contacts, executor, [](Contact& c) { c.reference_impulse = c.impulse; });
        return counts;
    }

    bool wantsAllThreads(const BatchView& batch, std::span<const Contact> contacts) const override {
        return resolution_->wantsAllThreads(batch, contacts);
    }

  private:
    static bool sleeps(const BodyState& bodies, BodyIndex i) { return bodies.asleep[i] != 0 && isAtRest(bodies, i); }

    /// Whether no fixed body that moves is at the other end of a joint.
    static bool hasStillAnchors(const BatchView& batch, const BodyState& bodies) {
        const auto holds = [&](BodyIndex i) { return i == Joint::world || !bodies.isFixed(i) || isAtRest(bodies, i); };
        return std::ranges::all_of(batch.joints, [&](const JointBlock& j) { return holds(j.a) && holds(j.b); });
    }

    /// Takes away what gravity gave to a body that sleeps.
    static void hold(const BodyState& bodies, BodyIndex i) {
        bodies.v[i].setZero();
        bodies.w[i].setZero();
    }

    template <class Work>
    static void forEachContact(const BatchView& batch, std::span<Contact> contacts, const Executor& executor,
                               const Work& work) {
        executor.forBlocks(batch.contacts.size(), [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) work(contacts[batch.contacts[i]]);
        });
    }

    ResolutionCounts resolvePart(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                                 const ResolutionSettings& settings, const Executor& executor) {
        if (part_.size() < bodies.size()) {
            part_.resize(bodies.size(), Part::free);
            index_of_.resize(bodies.size(), none);
        }
        for (const BodyIndex i : batch.bodies) {
            if (!sleeps(bodies, i)) continue;
            part_[i] = Part::held;
            hold(bodies, i);
        }
        takeTiedAlong(batch, bodies);
        takeAllAlongUnlessWorthwhile(batch, bodies);
        ResolutionCounts counts;
        for (int reach = 1;; reach *= 4) {
            select(batch, contacts, bodies);
            const BatchView part{part_bodies_, part_contacts_, part_joints_};
            const ResolutionCounts round = resolution_->resolve(part, contacts, bodies, settings, executor);
            counts.global_iterations += round.global_iterations;
            findDisturbed(contacts, bodies, settings);
            if (disturbed_.empty()) break;
            goBack(contacts, bodies);
            takeAroundAlong(batch, contacts, bodies, reach);
            takeTiedAlong(batch, bodies);
            takeAllAlongUnlessWorthwhile(batch, bodies);
        }
        for (std::size_t n = 0; n < part_joints_.size(); ++n) batch.joints[joint_of_part_[n]] = part_joints_[n];
        wakePushed(batch, contacts, bodies, settings);
        forEachContact(batch, contacts, executor, [&](Contact& contact) {
            const bool a = isFree(bodies, contact.a);
            const bool b = isFree(bodies, contact.b);
            if (!a && !b) contact.impulse += contact.last_impulse;
            if (!isHeld(contact.a) && !isHeld(contact.b)) contact.reference_impulse = contact.impulse;
        });
        for (const BodyIndex i : batch.bodies) part_[i] = Part::free;
        return counts;
    }

    /// Unless most of a batch is held, resolving a part saves less than it may waste.
    void takeAllAlongUnlessWorthwhile(const BatchView& batch, const BodyState& bodies) {
        const auto held = std::ranges::count_if(batch.bodies, [&](BodyIndex i) { return isHeld(i); });
        if (4 * static_cast<std::size_t>(held) > 3 * batch.bodies.size()) return;
        for (const BodyIndex i : batch.bodies) {
            if (isHeld(i)) takeAlong(bodies, i);
        }
    }

    bool isHeld(BodyIndex i) const { return part_[i] == Part::held; }
    bool isFree(const BodyState& bodies, BodyIndex i) const { return !isHeld(i) && !bodies.isFixed(i); }

    /// Bodies that joints tie together are held together or not at all.
    void takeTiedAlong(const BatchView& batch, const BodyState& bodies) {
        spreadOverJoints(
            batch, [&](BodyIndex i) { return isFree(bodies, i); }, [&](BodyIndex i) { return isHeld(i); },
            [&](BodyIndex i) { takeAlong(bodies, i); });
    }

    /// Calls take(body) for those of some bodies that joints tie to certain others, until there is none left.
    template <class IsOther, class IsSome, class Take>
    static void spreadOverJoints(const BatchView& batch, const IsOther& is_other, const IsSome& is_some,
                                 const Take& take) {
        for (bool changed = true; changed;) {
            changed = false;
            for (const JointBlock& joint : batch.joints) {
                if (joint.a == Joint::world || joint.b == Joint::world) continue;
                for (const auto& [end, other] : {std::pair(joint.a, joint.b), std::pair(joint.b, joint.a)}) {
                    if (!is_other(end) || !is_some(other)) continue;
                    take(other);
                    changed = true;
                }
            }
        }
    }

    /// Finds the bodies that are not held with their contacts and joints, and notes their velocities.
    void select(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
        part_bodies_.clear();
        part_contacts_.clear();
        for (const BodyIndex i : batch.bodies) {
            if (!isHeld(i)) part_bodies_.push_back(i);
        }
        noteMotion(part_bodies_, bodies, before_);
        for (const std::uint32_t i : batch.contacts) {
            if (isFree(bodies, contacts[i].a) || isFree(bodies, contacts[i].b)) part_contacts_.push_back(i);
        }
        part_joints_.clear();
        joint_of_part_.clear();
        for (std::uint32_t j = 0; j < batch.joints.size(); ++j) {
            const JointBlock& joint = batch.joints[j];
            if (isHeld(joint.a) || (joint.b != Joint::world && isHeld(joint.b))) continue;
            part_joints_.push_back(joint);
            joint_of_part_.push_back(j);
        }
    }

    void findDisturbed(std::span<const Contact> contacts, const BodyState& bodies, const ResolutionSettings& settings) {
        disturbed_.clear();
        disturbances_.clear();
        for (const std::uint32_t i : part_contacts_) {
            const Contact& contact = contacts[i];
            const Vec3 difference = contact.impulse - contact.reference_impulse;
            if (isHeld(contact.a)) disturb(contact.a, difference, contact.point - bodies.position[contact.a]);
            if (isHeld(contact.b)) disturb(contact.b, -difference, contact.point - bodies.position[contact.b]);
        }
        for (const Disturbance& d : disturbances_) {
            const BodyIndex i = d.body;
            const Vec3 v = bodies.mass_inv[i] * d.linear;
            const Vec3 w = bodies.inertiaInv_W[i] * d.angular;
            if (isPush(v, w, d.squared_reach, settings.wake_speed)) disturbed_.push_back(i);
            index_of_[i] = none;
        }
    }

    /// Whether what a body would move by is beyond its limit, as the motion that falling asleep is about. What is not a
    /// number is, too.
    static bool isPush(const Vec3& v, const Vec3& w, double squared_reach, double limit) {
        return !(2 * (v.squaredNorm() + w.squaredNorm() * squared_reach) <= limit * limit);
    }

    void disturb(BodyIndex i, const Vec3& impulse, const Vec3& r) {
        if (index_of_[i] == none) {
            index_of_[i] = static_cast<std::uint32_t>(disturbances_.size());
            disturbances_.push_back({.body = i});
        }
        Disturbance& d = disturbances_[index_of_[i]];
        d.linear += impulse;
        d.angular += r.cross(impulse);
        d.squared_reach = std::max(d.squared_reach, r.squaredNorm());
    }

    /// Undoes the resolution of the part.
    void goBack(std::span<Contact> contacts, const BodyState& bodies) const {
        for (std::size_t n = 0; n < part_bodies_.size(); ++n) {
            bodies.v[part_bodies_[n]] = before_[n].v;
            bodies.w[part_bodies_[n]] = before_[n].w;
        }
        for (const std::uint32_t i : part_contacts_) {
            contacts[i].impulse.setZero();
            contacts[i].angular_impulse.setZero();
        }
    }

    /// Takes the disturbed bodies along and all that so many contacts lead to from there.
    void takeAroundAlong(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies,
                         int reach) {
        for (const BodyIndex i : disturbed_) takeAlong(bodies, i);
        for (int step = 0; step < reach; ++step) {
            disturbed_.clear();
            for (const std::uint32_t i : batch.contacts) {
                const auto [a, b] = std::pair(contacts[i].a, contacts[i].b);
                if (isHeld(a) && part_[b] == Part::along) disturbed_.push_back(a);
                if (isHeld(b) && part_[a] == Part::along) disturbed_.push_back(b);
            }
            for (const BodyIndex i : disturbed_) takeAlong(bodies, i);
        }
    }

    void takeAlong(const BodyState& bodies, BodyIndex i) {
        if (!isHeld(i)) return;
        along_.push_back({i, bodies.asleep[i], bodies.woken[i]});
        part_[i] = Part::along;
        bodies.v[i] = bodies.gravityFactor(i) * bodies.fall;
    }

    /// Wakes who was resolved along and pushed, with those tied to it, and leaves the others as they were.
    void wakePushed(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies,
                    const ResolutionSettings& settings) {
        if (along_.empty()) return;
        for (std::uint32_t n = 0; n < along_.size(); ++n) index_of_[along_[n].body] = n;
        for (const std::uint32_t c : part_contacts_) {
            for (const BodyIndex i : {contacts[c].a, contacts[c].b}) {
                if (part_[i] != Part::along) continue;
                double& squared_reach = along_[index_of_[i]].squared_reach;
                squared_reach = std::max(squared_reach, (contacts[c].point - bodies.position[i]).squaredNorm());
            }
        }
        const auto wake = [&](BodyIndex i) {
            part_[i] = Part::free;
            bodies.wake(i, WakeReason::struck);
        };
        for (const Along& before : along_) {
            const BodyIndex i = before.body;
            index_of_[i] = none;
            bodies.asleep[i] = before.asleep;
            bodies.woken[i] = before.woken;
            if (isPush(bodies.v[i], bodies.w[i], before.squared_reach, settings.wake_speed)) wake(i);
        }
        spreadOverJoints(
            batch, [&](BodyIndex i) { return part_[i] == Part::free && !bodies.isFixed(i); },
            [&](BodyIndex i) { return part_[i] == Part::along; }, wake);
        for (const Along& before : along_) {
            if (part_[before.body] == Part::along) hold(bodies, before.body);
        }
        along_.clear();
    }

    std::unique_ptr<Resolution> resolution_;
    Sleepers sleepers_;
    std::vector<Part> part_;                    ///< [slots] free outside of resolve()
    std::vector<Disturbance> disturbances_;     ///< of held bodies with a contact of the part
    std::vector<Along> along_;                  ///< empty outside of resolvePart()
    std::vector<std::uint32_t> index_of_;       ///< [slots] in disturbances_ or along_; none outside of who uses it
    std::vector<BodyIndex> part_bodies_;        ///< ascending
    std::vector<std::uint32_t> part_contacts_;  ///< ascending
    std::vector<JointBlock> part_joints_;       ///< copies, so that what is undone leaves nothing behind
    std::vector<std::uint32_t> joint_of_part_;  ///< [part_joints_] index in the batch
    std::vector<BodyMotion> before_;            ///< [part_bodies_]
    std::vector<BodyIndex> disturbed_;
};

}  // namespace

std::unique_ptr<Resolution> makeAwakePart(std::unique_ptr<Resolution> resolution, Sleepers sleepers) {
    return std::make_unique<AwakePart>(std::move(resolution), sleepers);
}

}  // namespace cairn
