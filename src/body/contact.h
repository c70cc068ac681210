/// @file The contact: the only thing the response knows of geometry.
#pragma once

#include <cstdint>

#include "body/body_storage.h"

namespace cairn {

/// Two bodies touching (or about to) in one point. Body a always has the smaller slot index. What passes over all
/// contacts ask comes first, in one line of the processor's cache.
struct alignas(64) Contact {
    BodyIndex a = 0;
    BodyIndex b = 0;
    double distance = 0;         ///< along the normal [m]; negative = overlap
    double allowed_overlap = 0;  ///< that the correction leaves alone [m], ≥ 0
    double allowed_closing = 0;  ///< closing speed at which it does not touch before the next detection [m/s], ≥ 0
    double restitution = 0;
    Vec3 normal = Vec3::UnitX();  ///< n̂_BA_W: unit, from B to A
    Vec3 point = Vec3::Zero();    ///< [m, W]
    /// From the point to where A is met, and from where B is met to there: across the normal, half of the way by which
    /// the two pass each other before they meet [m, W]. Zero where they are met in one place.
    Vec3 slide = Vec3::Zero();
    double static_friction = 0;
    double kinetic_friction = 0;
    double rolling_friction = 0;       ///< [m]
    double spinning_friction = 0;      ///< [m]
    Vec3 last_impulse = Vec3::Zero();  ///< that A received here in the last step [N·s, W]; zero for a new contact
    /// What A received here when both bodies were resolved last [N·s, W]; zero if that never was.
    Vec3 reference_impulse = Vec3::Zero();
    Vec3 impulse = Vec3::Zero();          ///< sum of what A received in this step [N·s, W]; B received the opposite
    Vec3 angular_impulse = Vec3::Zero();  ///< of rolling and spinning friction, likewise [N·m·s, W]
    /// What of both A received in the parts of a divided step before this one; while a part lasts, the two above are
    /// its own.
    Vec3 earlier_impulse = Vec3::Zero(), earlier_angular_impulse = Vec3::Zero();

    // With RestitutionSpeed::touching only, where a is the acceleration by which the forces close the contact.
    double gap = 0;     ///< distance when it was detected, before the correction [m]
    double forced = 0;  ///< what the forces changed of the normal velocity in this step [m/s]; < 0 = they close it
    double fall = 0;    ///< what is to be added to the squared closing speed to have that at the touching [m²/s²]
    double climb = 0;   ///< what the way from touching to the present distance takes of it again [m²/s²]

    /// The place of one of its two bodies that is met [m, W].
    Vec3 pointOn(BodyIndex body) const { return body == a ? Vec3(point + slide) : Vec3(point - slide); }
    /// Whether the bodies overlap by more than the correction leaves alone (thr_pen). @source thesis §2
    bool isTooDeep() const { return distance < -allowed_overlap; }
    /// Whether the bodies are apart and only may touch before the next detection.
    bool isForeseen() const { return allowed_closing > 0; }
};

/// Calls visit(member) for what of a contact outlasts a step: what World::contacts() shows and the next contacts
/// inherit. Snapshots and other ranks get it in this order.
template <class AnyContact, class Visit>
void forLastingMembers(AnyContact& contact, const Visit& visit) {
    visit(contact.a);
    visit(contact.b);
    visit(contact.point);
    visit(contact.normal);
    visit(contact.distance);
    visit(contact.reference_impulse);
    visit(contact.impulse);
    visit(contact.angular_impulse);
}

}  // namespace cairn
