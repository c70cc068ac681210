/// @file Three numbers, each for itself.
#pragma once

#include "cairn/types.h"

namespace cairn {

/// A vector of three numbers of any kind: doubles, or several at once (lanes.h). What holds vectors of lanes in memory
/// must say how it is aligned: compilers assume less where they know of no wide registers than where they do.
///
/// Of doubles it serves chains of short calculations where each waits for the last. Eigen works on the first two
/// components of its vectors together and on the third alone, and what was written one by one a moment ago can be read
/// as a pair only once it has reached the cache.
template <class Number>
class alignas(sizeof(Number)) Triple {
  public:
    // Always inlined: these functions are compiled for several kinds of processors, which pass lanes in different ways.

    [[gnu::always_inline]] Triple() = default;
    [[gnu::always_inline]] Triple(const Number& x, const Number& y, const Number& z) : x_(x), y_(y), z_(z) {}
    [[gnu::always_inline]] explicit Triple(const Vec3& u) : x_(u.x()), y_(u.y()), z_(u.z()) {}

    [[gnu::always_inline]] const Number& x() const { return x_; }
    [[gnu::always_inline]] const Number& y() const { return y_; }
    [[gnu::always_inline]] const Number& z() const { return z_; }
    [[gnu::always_inline]] Number& x() { return x_; }
    [[gnu::always_inline]] Number& y() { return y_; }
    [[gnu::always_inline]] Number& z() { return z_; }

    [[gnu::always_inline]] Number dot(const Triple& u) const { return x_ * u.x_ + y_ * u.y_ + z_ * u.z_; }
    [[gnu::always_inline]] Number squaredNorm() const { return dot(*this); }
    [[gnu::always_inline]] Triple cross(const Triple& u) const {
        return {y_ * u.z_ - z_ * u.y_, z_ * u.x_ - x_ * u.z_, x_ * u.y_ - y_ * u.x_};
    }
    [[gnu::always_inline]] Triple& operator+=(const Triple& u) { return *this = *this + u; }
    [[gnu::always_inline]] Triple& operator-=(const Triple& u) { return *this = *this - u; }
    [[gnu::always_inline]] friend Triple operator+(const Triple& u, const Triple& v) {
        return {u.x_ + v.x_, u.y_ + v.y_, u.z_ + v.z_};
    }
    [[gnu::always_inline]] friend Triple operator-(const Triple& u, const Triple& v) {
        return {u.x_ - v.x_, u.y_ - v.y_, u.z_ - v.z_};
    }
    [[gnu::always_inline]] friend Triple operator*(const Number& s, const Triple& u) {
        return {s * u.x_, s * u.y_, s * u.z_};
    }

  private:
    Number x_{}, y_{}, z_{};
};

using Triple1 = Triple<double>;

inline Vec3 toVec3(const Triple1& u) {
    return {u.x(), u.y(), u.z()};
}

/// mᵀ·u
inline Triple1 transposedProduct(const Mat3& m, const Triple1& u) {
    const auto row = [&](Eigen::Index i) { return m(0, i) * u.x() + m(1, i) * u.y() + m(2, i) * u.z(); };
    return {row(0), row(1), row(2)};
}

/// m·u, bit for bit as Eigen's with a Vec3, which adds up the last row in another order.
inline Triple1 product(const Mat3& m, const Triple1& u) {
    const auto row = [&](Eigen::Index i) { return m(i, 0) * u.x() + m(i, 1) * u.y() + m(i, 2) * u.z(); };
    return {row(0), row(1), m(2, 0) * u.x() + (m(2, 1) * u.y() + m(2, 2) * u.z())};
}

}  // namespace cairn
