/// @file A batch gathered into dense arrays: bodies and contacts get local indices, ascending as in the batch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "resolution/batch_joints.h"
#include "resolution/contact_colours.h"
#include "resolution/contact_frame.h"
#include "resolution/resolution.h"
#include "resolution/rolling.h"

namespace cairn {

/// Works on copies: masses may be changed here (shock propagation) without touching those of the world.
class LocalBatch {
  public:
    std::vector<LocalBody> bodies;        ///< the batch's dynamic bodies, then the fixed bodies they touch
    std::vector<ContactFrame> contacts;   ///< in the batch's order
    std::vector<RollingContact> rolling;  ///< of the contacts that resist rolling or spinning
    std::size_t dynamic_bodies = 0;       ///< bodies[i] is dynamic for i below this
    BatchJoints joints;                   ///< hold at any time: impulses at contacts go through them
    std::vector<ContactEnds> ends;        ///< [contacts] their bodies

    /// Initialises bodies and contacts (lines 2–4 of Algorithm 9). Keeps its memory between calls.
    void gather(const BatchView& batch, std::span<const Contact> all_contacts, const BodyState& state);
    /// The same without frames of the contacts: bodies, joints and ends.
    void gatherBodies(const BatchView& batch, std::span<const Contact> all_contacts, const BodyState& state);
    /// Writes back velocities and impulses, and wakes the bodies that were struck (wake condition 3 of thesis §3.2).
    void scatter(const BatchView& batch, std::span<Contact> all_contacts, const BodyState& state) const;
    /// The same for velocities and waking alone.
    void scatterBodies(const BodyState& state) const;

    bool isFixed(std::uint32_t body) const { return body >= dynamic_bodies; }
    Vec3 velocityOf(const ContactFrame& c) const { return relativeVelocity(c, bodies[c.a], bodies[c.b]); }
    /// With the joints holding [1/kg, contact coordinates].
    Symmetric3 collisionMatrixOf(const ContactFrame& c) {
        return joints.holds(c) ? joints.collisionMatrix(c, bodies) : collisionMatrix(c, bodies[c.a], bodies[c.b]);
    }
    void updateCollisionMatrixOf(ContactFrame& c) {
        setCollisionMatrix(c, collisionMatrixOf(c));
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
    void updateRolling(const ContactFrame& c);
    std::uint32_t localIndex(BodyIndex slot, const BodyState& state);

    std::vector<std::uint32_t> local_of_slot_;  ///< [slots] of the world; `none` outside of gather()
};

}  // namespace cairn
