/// @file A batch gathered into dense arrays: bodies and contacts get local indices, ascending as in the batch.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "batches/batch_motion.h"
#include "resolution/batch_joints.h"
#include "resolution/contact_colours.h"
#include "resolution/contact_frame.h"
#include "resolution/resolution.h"
#include "resolution/rolling.h"

namespace cairn {

/// What the normal velocity of a contact depends on.
struct NormalArms {
    Vec3 normal;  ///< from B to A [W]
    Vec3 r_a;     ///< from the centre of mass of A to the contact [m, W]
    Vec3 r_b;     ///< likewise of B
};

/// What of a batch was resolved by some time.
struct ResolvedSoFar {
    std::vector<BodyMotion> motion;     ///< [dynamic bodies]
    std::vector<Vec3> impulse;          ///< [contacts] [N·s, W]
    std::vector<Vec3> angular_impulse;  ///< [contacts that resist rolling] [N·m·s, W]
    std::vector<double> joint_impulse;  ///< [rows of the joints]
};

/// Works on copies: masses may be changed here (shock propagation) without touching those of the world.
class LocalBatch {
  public:
    std::vector<LocalBody> bodies;        ///< the batch's dynamic bodies, then copies of others that they touch
    std::vector<ContactFrame> contacts;   ///< in the batch's order; those that are prepared
    std::vector<RollingContact> rolling;  ///< of the contacts that resist rolling or spinning
    std::size_t dynamic_bodies = 0;       ///< bodies[i] is dynamic for i below this
    BatchJoints joints;                   ///< hold at any time: impulses at contacts go through them
    std::vector<ContactEnds> ends;        ///< [contacts] their bodies

    /// Initialises bodies and contacts (lines 2–4 of Algorithm 9). Keeps its memory between calls.
    void gather(const BatchView& batch, std::span<const Contact> all_contacts, const BodyState& state);
    /// The same with no contact prepared: most of a resting batch are never resolved. All that is passed must outlive
    /// the calls of prepare() and armsOf().
    void gatherUnprepared(const BatchView& batch, std::span<const Contact> all_contacts, const BodyState& state);
    /// Builds the frame of a contact, or its collision matrix anew, if it has none.
    void prepare(std::uint32_t contact) {
        if (preparation_[contact] != Preparation::complete) build(contact);
    }
    /// To be called where a mass has changed.
    void forgetCollisionMatrixOf(std::uint32_t contact) {
        preparation_[contact] = std::min(preparation_[contact], Preparation::frame);
    }
    NormalArms armsOf(std::uint32_t contact) const {
        const Contact& source = source_[source_contacts_[contact]];
        return {source.normal, source.pointOn(source.a) - source_position_[source.a],
                source.pointOn(source.b) - source_position_[source.b]};
    }
    /// ϑA0 − ϑB0, the first component of velocityOf() [m/s].
    double normalVelocityOf(std::uint32_t contact) const {
        const NormalArms arms = armsOf(contact);
        const LocalBody& a = bodies[ends[contact].a];
        const LocalBody& b = bodies[ends[contact].b];
        return arms.normal.dot((a.v + a.w.cross(arms.r_a)) - (b.v + b.w.cross(arms.r_b)));
    }
    /// The same without frames of the contacts: bodies, joints and ends.
    void gatherBodies(const BatchView& batch, std::span<const Contact> all_contacts, const BodyState& state);
    /// Writes back velocities and impulses, and wakes the bodies that were struck (wake condition 3 of thesis §3.2).
    /// Contacts that are not prepared have no impulse.
    void scatter(const BatchView& batch, std::span<Contact> all_contacts, const BodyState& state) const;
    /// The same for velocities and waking alone.
    void scatterBodies(const BodyState& state) const;

    /// @param resolved out; keeps its memory
    void save(ResolvedSoFar& resolved) const;
    /// Takes what was resolved since back to a part: velocities and impulses.
    void keepPartSince(const ResolvedSoFar& resolved, double part);

    bool isFixed(std::uint32_t body) const { return body >= dynamic_bodies; }
    Vec3 velocityOf(const ContactFrame& c) const { return relativeVelocity(c, bodies[c.a], bodies[c.b]); }
    void updateCollisionMatrixOf(ContactFrame& c) {
        if (joints.holds(c)) {
            joints.setCollisionMatrixOf(c, bodies);
        } else {
            setCollisionMatrix(c, collisionMatrix(c, bodies[c.a], bodies[c.b]));
        }
        if (c.rolling != ContactFrame::rolls_freely) updateRolling(c);
    }
    /// Applies an impulse, on A, at a contact to its bodies and all that joints tie to them.
    /// @param impulse [N·s, contact coordinates]
    void push(const ContactFrame& c, const Vec3& impulse) { pushWorld(c, c.basis * impulse); }
    /// @param impulse [N·s, W]
    void pushWorld(const ContactFrame& c, const Vec3& impulse);
    /// Likewise an angular impulse, on A. @param impulse [N·m·s, contact coordinates] @pre the contact resists rolling
    void turn(const ContactFrame& c, const Vec3& impulse);

  private:
    /// What there is of a contact's frame.
    enum class Preparation : std::uint8_t { none, frame, complete };

    bool isMember(BodyIndex slot, const BodyState& state) const {
        return state.place[slot] < dynamic_bodies && bodies[state.place[slot]].slot == slot;
    }
    void build(std::uint32_t contact);
    void buildFrame(std::uint32_t contact);
    void updateRolling(const ContactFrame& c);
    std::uint32_t localEnd(const Contact& contact, BodyIndex slot, const BodyState& state);

    std::span<const std::uint32_t> source_contacts_;  ///< [contacts] index in source_
    std::span<const Contact> source_;
    std::span<const Vec3> source_position_;  ///< [slots] [m, W]
    std::vector<Preparation> preparation_;   ///< [contacts]
};

}  // namespace cairn
