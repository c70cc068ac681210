/// @file Where the bodies of a joint stand relative to each other, and how that changes.
#pragma once

#include <array>

#include "joints/joint.h"

namespace cairn {

/// One component of the relative motion of A and B: rate = linear·(vA − vB) + angular_a·ωA + angular_b·ωB. An impulse λ
/// along it gives A linear·λ and angular_a·λ, and B −linear·λ and angular_b·λ.
struct JointRow {
    Vec3 linear = Vec3::Zero();
    Vec3 angular_a = Vec3::Zero();  ///< about the centre of mass of A
    Vec3 angular_b = Vec3::Zero();  ///< about the centre of mass of B
};

/// Position and rate of a free component of a joint.
struct JointMotion {
    double position;  ///< [rad or m]
    JointRow row;     ///< whose rate changes it
};

/// A joint seen in W.
struct JointPlacement {
    Quat orientation_a, orientation_b;
    Vec3 arm_a, arm_b;  ///< from the centres of mass to the anchors
    Vec3 apart;         ///< anchor of A − anchor of B
    Vec3 axis_a, axis_b;
    Vec3 side_1, side_2;  ///< across axis_b, turning with B: rows of one step and the next mean the same
};

/// @param a, b poses of the bodies' centres of mass and principal axes in W; b is the identity for the world
JointPlacement placementOf(const Joint& joint, const Pose& a, const Pose& b);

/// Any unit vector across a unit vector, the same one for the same vector.
Vec3 anyAcross(const Vec3& axis);

/// The velocity of A's anchor relative to the point of B where it is, along a direction that turns with B.
inline JointRow linearRow(const JointPlacement& at, const Vec3& direction) {
    return {direction, at.arm_a.cross(direction), -(at.arm_b + at.apart).cross(direction)};
}

inline JointRow angularRow(const Vec3& direction) {
    return {Vec3::Zero(), direction, -direction};
}

/// How A turned from its rest relative to B, in B's frame.
inline Quat turnInB(const Joint& joint, const JointPlacement& at) {
    return at.orientation_b.conjugate() * at.orientation_a * joint.rest.conjugate();
}

/// Of the angles that are the same the one nearest to another.
double nearestTurn(double angle, double to);

/// Along the line between the anchors; where they meet every direction will do.
JointMotion lengthOf(const JointPlacement& at);
/// About axis_b, counted on from where the axis was last.
JointMotion angleOf(const Joint& joint, const JointPlacement& at, const FreeAxis& axis);
/// Along axis_b.
JointMotion displacementOf(const JointPlacement& at);

/// The twist about axis_b that is left of the rotation when its swing is taken off, within ±π; where A points against B
/// there is none.
JointMotion twistOf(const Joint& joint, const JointPlacement& at);
/// The angle between the axes of A and B, 0 to π.
JointMotion swingOf(const JointPlacement& at);

/// Position and row for each JointAlong in the joint's frame.
using SixMotions = std::array<JointMotion, 6>;

/// Displacements, and the rotation as three turns after each other, about an axis of B, a middle one and an axis of A.
/// With two free ones the middle one is the one that is kept, so that free ones may turn on and on; of three free ones
/// turn_y is the middle one, which must stay within ±π/2.
SixMotions cardanMotions(const Joint& joint, const JointPlacement& at);

/// Displacements, and the rotation vector of the turn from the rest.
SixMotions vectorMotions(const Joint& joint, const JointPlacement& at);

}  // namespace cairn
