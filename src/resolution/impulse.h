/// @file The impulse that resolves one contact. @source thesis §3.4, §3.5, Algorithms 8 and 11
#pragma once

#include <cmath>

#include "resolution/contact_frame.h"

namespace cairn {

/// The impulse without friction: stops (or reverses) the normal velocity. @source thesis Algorithm 7, normal part
inline Vec3 frictionlessImpulse(const ContactFrame& frame, double target_normal) {
    return {target_normal / frame.k_row[0], 0, 0};
}

/// The impulse of a sliding contact. @param stick the impulse that would stop the sliding [N·s, contact coordinates]
/// @param target_normal wanted change of the normal velocity [m/s], > 0 @source thesis (3.5.5)–(3.5.8)
///
/// The denominator K0 + β(K1·j1 + K2·j2) is positive for µk ≤ µs: with c·|jt| := K1·j1 + K2·j2, stick fulfils
/// K0·j0 + c·|jt| = target0 > 0. If j0 ≤ 0, then c > 0. If j0 > 0, then c < 0 and |jt| > µs·j0 give K0 > µs·|c|. Should
/// rounding or a µk > µs break this (as in Painlevé's paradox), the impulse would pull; it is given without friction.
inline Vec3 slidingImpulse(const ContactFrame& frame, const Vec3& stick, double target_normal) {
    const double beta = frame.kinetic_friction / std::sqrt(stick[1] * stick[1] + stick[2] * stick[2]);
    const double denominator = frame.k_row[0] + beta * (frame.k_row[1] * stick[1] + frame.k_row[2] * stick[2]);
    const bool pushes = denominator > 0;  // false for a NaN, too
    if (!pushes) return frictionlessImpulse(frame, target_normal);
    const double normal = target_normal / denominator;
    const double lambda = beta * normal;
    return {normal, lambda * stick[1], lambda * stick[2]};
}

/// The impulse that stops a contact which joints keep from moving in some directions, and then parts it. The velocities
/// of a bounce without sliding are none that such a contact can have; asked for at once, they would be answered with
/// impulses of any size in the blocked directions.
/// @param velocity and e as for newtonImpulse()
inline Vec3 blockedImpulse(const ContactFrame& frame, const Vec3& velocity, double e) {
    Vec3 j = frame.k_inv * -velocity;
    j[0] -= e * velocity[0] / frame.k_row[0];
    return j;
}

/// The impulse on A that resolves a closing contact [N·s, contact coordinates]; B gets the opposite.
/// @param velocity ϑA − ϑB [m/s, contact coordinates], velocity[0] < 0 @param e restitution @source thesis Algorithm 8
inline Vec3 newtonImpulse(const ContactFrame& frame, const Vec3& velocity, double e) {
    const Vec3 target(-(1 + e) * velocity[0], -velocity[1], -velocity[2]);
    const Vec3 j = frame.is_blocked ? blockedImpulse(frame, velocity, e) : Vec3(frame.k_inv * target);
    // The thesis's cone test (3.5.4) ignores the sign of j0. A j0 that pulls, possible when a fast sliding contact is
    // strongly coupled, counts as sliding here, whose impulse always pushes.
    const double cone = frame.static_friction * j[0];
    if (j[0] > 0 && j[1] * j[1] + j[2] * j[2] <= cone * cone) return j;
    return slidingImpulse(frame, j, target[0]);
}

/// The same with the contact's restitution. @param restitution_threshold closing speed below which e = 0 [m/s]
/// @source thesis Algorithm 8 with Algorithm 11
inline Vec3 contactImpulse(const ContactFrame& frame, const Vec3& velocity, double restitution_threshold) {
    return newtonImpulse(frame, velocity, velocity[0] > -restitution_threshold ? 0 : frame.restitution);
}

/// How an impulse changes one body's velocities.
struct VelocityChange {
    Vec3 v;  ///< [m/s, W]
    Vec3 w;  ///< [rad/s, W]
};

/// @param r from the centre of mass to the contact [m, W] @param impulse on this body [N·s, W] @source thesis (3.4.4)
inline VelocityChange velocityChange(const LocalBody& body, const Vec3& r, const Vec3& impulse) {
    const Triple1 j(impulse);
    return {toVec3(body.mass_inv * j), toVec3(body.inertia_inv * Triple1(r).cross(j))};
}

inline void apply(const VelocityChange& change, LocalBody& body) {
    body.v = toVec3(Triple1(body.v) + Triple1(change.v));
    body.w = toVec3(Triple1(body.w) + Triple1(change.w));
    body.struck = 1;
}

/// How an angular impulse changes it. @param impulse [N·m·s, W]
inline VelocityChange angularChange(const LocalBody& body, const Vec3& impulse) {
    return {Vec3::Zero(), body.inertia_inv * impulse};
}

/// Changes of both bodies by one resolution.
struct ContactChange {
    VelocityChange a, b;
};

/// Applies an impulse to both bodies and adds it to the contact's sum. @param j on A [N·s, contact coordinates]
inline ContactChange applyImpulse(ContactFrame& frame, const Vec3& j, LocalBody& a, LocalBody& b) {
    const Triple1 pushed = product(frame.basis, Triple1(j));
    frame.impulse = toVec3(Triple1(frame.impulse) + pushed);
    const Vec3 impulse = toVec3(pushed);
    const ContactChange change{velocityChange(a, frame.r_a, impulse), velocityChange(b, frame.r_b, -impulse)};
    apply(change.a, a);
    apply(change.b, b);
    return change;
}

}  // namespace cairn
