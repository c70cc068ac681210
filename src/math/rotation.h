/// @file Small rotation helpers over Eigen.
#pragma once

#include "cairn/types.h"

namespace cairn {

/// The matrix S with S·v = r × v. @source thesis (3.4.9a)
inline Mat3 skew(const Vec3& r) {
    Mat3 s;
    s << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    return s;
}

/// The unit quaternion of a rotation vector. @param rotation axis times angle [rad]
inline Quat fromRotationVector(const Vec3& rotation) {
    const double angle = rotation.norm();
    if (angle < 1e-8) {
        return Quat(1, 0.5 * rotation.x(), 0.5 * rotation.y(), 0.5 * rotation.z()).normalized();
    }
    return Quat(Eigen::AngleAxisd(angle, rotation / angle));
}

/// The shorter one of the two rotation vectors of a unit quaternion [rad].
inline Vec3 toRotationVector(const Quat& rotation) {
    const Eigen::AngleAxisd turn(rotation);
    return turn.angle() * turn.axis();
}

/// World inverse inertia from the principal one. @param inertiaInv_B diagonal [1/(kg·m²), B] @param R_WB B to W
inline Mat3 toWorldInertia(const Vec3& inertiaInv_B, const Quat& R_WB) {
    const Mat3 r = R_WB.toRotationMatrix();
    return r * inertiaInv_B.asDiagonal() * r.transpose();
}

}  // namespace cairn
