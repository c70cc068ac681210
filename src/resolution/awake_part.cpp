#include "resolution/awake_part.h"

#include <algorithm>
#include <vector>

#include "resolution/batch_motion.h"

namespace cairn {

namespace {

/// What the contacts of a sleeping body push more than when it was awake last.
struct Disturbance {
    Vec3 linear = Vec3::Zero();   ///< [N·s]
    Vec3 angular = Vec3::Zero();  ///< about the centre of mass [N·m·s]
    double squared_reach = 0;     ///< of the farthest contact from the centre of mass [m²]
    bool seen = false;
};

class AwakePart final : public Resolution {
  public:
    AwakePart(std::unique_ptr<Resolution> resolution, Sleepers sleepers)
        : resolution_(std::move(resolution)), sleepers_(sleepers) {}

    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings, const Executor& executor) override {
        const auto sleepers = static_cast<std::size_t>(
            std::ranges::count_if(batch.bodies, [&](BodyIndex i) { return sleeps(bodies, i); }));
        const bool all = sleepers == batch.bodies.size();
        const bool some = sleepers > 0 && sleepers_ == Sleepers::remain && settings.wake_speed > 0;
        if ((all || some) && batch.joints.empty() && hasStillSupports(batch, contacts, bodies)) {
            if (!all) return resolvePart(batch, contacts, bodies, settings, executor);
            forEachContact(batch, contacts, executor, [](Contact& c) { c.impulse += c.last_impulse; });
            return {};
        }
        const ResolutionCounts counts = resolution_->resolve(batch, contacts, bodies, settings, executor);
        // Only who lets sleepers remain compares with it.
        if (sleepers_ == Sleepers::wake) return counts;
        forEachContact(batch, contacts, executor, [](Contact& c) { c.reference_impulse = c.impulse; });
        return counts;
    }

    std::size_t sharedFrom() const override { return resolution_->sharedFrom(); }

  private:
    static bool sleeps(const BodyState& bodies, BodyIndex i) { return bodies.asleep[i] != 0 && isAtRest(bodies, i); }

    template <class Work>
    static void forEachContact(const BatchView& batch, std::span<Contact> contacts, const Executor& executor,
                               const Work& work) {
        executor.forBlocks(batch.contacts.size(), [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) work(contacts[batch.contacts[i]]);
        });
    }

    ResolutionCounts resolvePart(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                                 const ResolutionSettings& settings, const Executor& executor) {
        if (held_.size() < bodies.size()) {
            held_.resize(bodies.size(), 0);
            disturbances_.resize(bodies.size());
        }
        std::size_t held = 0;
        for (const BodyIndex i : batch.bodies) {
            held_[i] = sleeps(bodies, i) ? 1 : 0;
            held += held_[i];
        }
        if (!isWorthwhile(held, batch)) wakeAll(batch, bodies);
        ResolutionCounts counts;
        for (int reach = 1;; reach *= 4) {
            select(batch, contacts, bodies);
            const BatchView part{part_bodies_, part_contacts_, {}};
            const ResolutionCounts round = resolution_->resolve(part, contacts, bodies, settings, executor);
            counts.global_iterations += round.global_iterations;
            findDisturbed(contacts, bodies, settings.wake_speed);
            if (disturbed_.empty()) break;
            goBack(contacts, bodies);
            wakeAround(batch, contacts, bodies, reach);
            const auto still_held = std::ranges::count_if(batch.bodies, [&](BodyIndex i) { return held_[i] != 0; });
            if (!isWorthwhile(static_cast<std::size_t>(still_held), batch)) wakeAll(batch, bodies);
        }
        forEachContact(batch, contacts, executor, [&](Contact& contact) {
            const bool a = isFree(bodies, contact.a);
            const bool b = isFree(bodies, contact.b);
            if (!a && !b) contact.impulse += contact.last_impulse;
            if ((a || isNotHeld(contact.a)) && (b || isNotHeld(contact.b))) contact.reference_impulse = contact.impulse;
        });
        for (const BodyIndex i : batch.bodies) held_[i] = 0;
        return counts;
    }

    /// A resolution of most of a batch saves less than it may waste.
    static bool isWorthwhile(std::size_t held, const BatchView& batch) { return 2 * held > batch.bodies.size(); }

    void wakeAll(const BatchView& batch, const BodyState& bodies) {
        for (const BodyIndex i : batch.bodies) {
            if (held_[i] != 0) free(bodies, i);
        }
    }

    bool isNotHeld(BodyIndex i) const { return held_[i] == 0; }
    bool isFree(const BodyState& bodies, BodyIndex i) const { return held_[i] == 0 && !bodies.isFixed(i); }

    /// Finds the bodies that are not held with their contacts, and notes their velocities.
    void select(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
        part_bodies_.clear();
        part_contacts_.clear();
        for (const BodyIndex i : batch.bodies) {
            if (held_[i] == 0) part_bodies_.push_back(i);
        }
        noteMotion(part_bodies_, bodies, before_);
        for (const std::uint32_t i : batch.contacts) {
            if (isFree(bodies, contacts[i].a) || isFree(bodies, contacts[i].b)) part_contacts_.push_back(i);
        }
    }

    void findDisturbed(std::span<const Contact> contacts, const BodyState& bodies, double wake_speed) {
        disturbed_.clear();
        seen_.clear();
        for (const std::uint32_t i : part_contacts_) {
            const Contact& contact = contacts[i];
            const Vec3 difference = contact.impulse - contact.reference_impulse;
            if (held_[contact.a] != 0) disturb(contact.a, difference, contact.point - bodies.position[contact.a]);
            if (held_[contact.b] != 0) disturb(contact.b, -difference, contact.point - bodies.position[contact.b]);
        }
        for (const BodyIndex i : seen_) {
            Disturbance& d = disturbances_[i];
            const Vec3 v = bodies.mass_inv[i] * d.linear;
            const Vec3 w = bodies.inertiaInv_W[i] * d.angular;
            // As the motion that falling asleep is about; what is not a number disturbs, too.
            const double motion = 2 * (v.squaredNorm() + w.squaredNorm() * d.squared_reach);
            if (!(motion <= wake_speed * wake_speed)) disturbed_.push_back(i);
            d = {};
        }
    }

    void disturb(BodyIndex i, const Vec3& impulse, const Vec3& r) {
        Disturbance& d = disturbances_[i];
        if (!d.seen) seen_.push_back(i);
        d.seen = true;
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

    /// Wakes the disturbed bodies and all that so many contacts lead to from there.
    void wakeAround(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies, int reach) {
        for (const BodyIndex i : disturbed_) free(bodies, i);
        for (int step = 0; step < reach; ++step) {
            disturbed_.clear();
            for (const std::uint32_t i : batch.contacts) {
                const auto [a, b] = std::pair(contacts[i].a, contacts[i].b);
                if (held_[a] != 0 && isWokenHere(bodies, b)) disturbed_.push_back(a);
                if (held_[b] != 0 && isWokenHere(bodies, a)) disturbed_.push_back(b);
            }
            for (const BodyIndex i : disturbed_) free(bodies, i);
        }
    }

    /// Whether the resolution woke it, in this step.
    bool isWokenHere(const BodyState& bodies, BodyIndex i) const {
        return isFree(bodies, i) && bodies.woken[i] == WakeReason::struck;
    }

    void free(const BodyState& bodies, BodyIndex i) {
        held_[i] = 0;
        bodies.wake(i, WakeReason::struck);
        bodies.v[i] = bodies.fall;
    }

    std::unique_ptr<Resolution> resolution_;
    Sleepers sleepers_;
    std::vector<std::uint8_t> held_;            ///< [slots] 1 = sleeps and is held still; 0 outside of resolve()
    std::vector<Disturbance> disturbances_;     ///< [slots] none outside of findDisturbed()
    std::vector<BodyIndex> part_bodies_;        ///< ascending
    std::vector<std::uint32_t> part_contacts_;  ///< ascending
    std::vector<BodyMotion> before_;            ///< [part_bodies_]
    std::vector<BodyIndex> seen_;               ///< held bodies with a contact of the part
    std::vector<BodyIndex> disturbed_;
};

}  // namespace

std::unique_ptr<Resolution> makeAwakePart(std::unique_ptr<Resolution> resolution, Sleepers sleepers) {
    return std::make_unique<AwakePart>(std::move(resolution), sleepers);
}

}  // namespace cairn
