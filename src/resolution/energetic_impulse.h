/// @file Restitution that never gives energy: Stronge's energetic coefficient with Coulomb friction along the impact.
#pragma once

#include "resolution/contact_frame.h"

namespace cairn {

/// The impulse on A of an impact: the normal impulse grows from zero, friction acts against the sliding of every
/// moment, which may turn, stop or reverse meanwhile; compression ends when the contact no longer closes, restitution
/// when the normal impulse has given back e² of the work that compression took. Newton's coefficient fixes the
/// separating speed instead, and with friction can give a skew impact more energy than it had.
/// @param velocity ϑA − ϑB [m/s, contact coordinates], velocity[0] < 0 @param restitution e, 0 to 1
/// @return [N·s, contact coordinates] @source Stronge, Rigid body collisions with friction, Proc. R. Soc. A 431 (1990),
///         doi:10.1098/rspa.1990.0125; Routh's graphical method for the path
Vec3 energeticImpulse(const ContactFrame& frame, const Vec3& velocity, double restitution);

/// What an impulse changes of the kinetic energy [J]. @param k [1/kg] @param velocity before it [m/s]
inline double energyChange(const Symmetric3& k, const Vec3& velocity, const Vec3& impulse) {
    return impulse.dot(velocity + 0.5 * (k * impulse));
}

}  // namespace cairn
