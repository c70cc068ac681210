/// @file Contacts that resist rolling and spinning: angular impulses beside the usual one. A Vec6 is an impulse, a
/// velocity or a change of it at a contact: linear (normal, tangents), then angular (about the normal, about the
/// tangents), in contact coordinates.
#pragma once

#include "math/six.h"
#include "resolution/contact_frame.h"

namespace cairn {

inline bool resistsRolling(const Contact& contact) {
    return contact.rolling_friction > 0 || contact.spinning_friction > 0;
}

/// What a contact that resists rolling has beside its frame.
struct RollingContact {
    double rolling = 0;             ///< [m]: torque against rolling is at most this times the normal force
    double spinning = 0;            ///< [m]: torque about the normal likewise
    Mat6 k = Mat6::Identity();      ///< [1/kg, 1/(kg·m), 1/(kg·m²)]
    double slide_mass = 0;          ///< least effective mass of the tangential part [kg]
    double roll_mass = 0;           ///< and least effective inertia of rolling [kg·m²]
    double lever = 1;               ///< turns times it compare with ways: a power of two, about ten radii [1]
    Vec3 impulse_W = Vec3::Zero();  ///< sum of the angular impulses on A [N·m·s, W]

    /// Sets k and what follows from it.
    void setMatrix(const Mat6& matrix);
};

/// K of linear and angular impulses together, without joints.
Mat6 wrenchMatrix(const ContactFrame& frame, const LocalBody& a, const LocalBody& b);

/// Velocity of A relative to B at the contact, linear [m/s] and angular [rad/s].
inline Vec6 relativeTwist(const ContactFrame& frame, const LocalBody& a, const LocalBody& b) {
    Vec6 twist;
    twist << relativeVelocity(frame, a, b), frame.basis.transpose() * (a.w - b.w);
    return twist;
}

/// The accumulated impulse of a contact that neither closes, slides, spins nor rolls, as far as the friction cone and
/// the bounds of the torques allow. @param excess velocity with the present impulse, less what the contact shall have
/// @param present accumulated impulse so far @param friction that holds while sliding
Vec6 solveRolling(const RollingContact& contact, double static_friction, double sliding_friction, const Vec6& excess,
                  const Vec6& present);

/// The angular impulse that acts beside a linear one that is known. @param twist after it
Vec3 rollingImpulse(const RollingContact& contact, double normal_impulse, const Vec3& angular_velocity);

}  // namespace cairn
