/// @file A symmetric 3×3 matrix in six numbers: a third less memory than Mat3, which is what the resolution waits for.
#pragma once

#include <cmath>

#include "math/triple.h"

namespace cairn {

/// Rows (xx xy xz), (xy yy yz), (xz yz zz).
template <class Number>
struct BasicSymmetric3 {
    Number xx{}, xy{}, xz{}, yy{}, yz{}, zz{};

    /// Takes the upper triangle. @pre m is symmetric up to rounding
    static BasicSymmetric3 from(const Mat3& m) { return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)}; }

    [[gnu::always_inline]] Triple<Number> operator*(const Triple<Number>& u) const { return times(u); }
    Vec3 operator*(const Vec3& u) const { return times(u); }

    Mat3 toMatrix() const {
        Mat3 m;
        m << xx, xy, xz, xy, yy, yz, xz, yz, zz;
        return m;
    }

  private:
    template <class Vector>
    [[gnu::always_inline]] Vector times(const Vector& u) const {
        return {xx * u.x() + xy * u.y() + xz * u.z(), xy * u.x() + yy * u.y() + yz * u.z(),
                xz * u.x() + yz * u.y() + zz * u.z()};
    }
};

using Symmetric3 = BasicSymmetric3<double>;

/// The inverse by cofactors. @return not finite if m is singular
template <class Number>
[[gnu::always_inline]] inline BasicSymmetric3<Number> inverse(const BasicSymmetric3<Number>& m) {
    const Number cxx = m.yy * m.zz - m.yz * m.yz;
    const Number cxy = m.xz * m.yz - m.xy * m.zz;
    const Number cxz = m.xy * m.yz - m.xz * m.yy;
    const Number s = 1 / (m.xx * cxx + m.xy * cxy + m.xz * cxz);
    return {s * cxx,
            s * cxy,
            s * cxz,
            s * (m.xx * m.zz - m.xz * m.xz),
            s * (m.xy * m.xz - m.xx * m.yz),
            s * (m.xx * m.yy - m.xy * m.xy)};
}

inline bool isFinite(const Symmetric3& m) {
    return std::isfinite(m.xx + m.xy + m.xz + m.yy + m.yz + m.zz);  // one bad term spoils the sum
}

}  // namespace cairn
