/// @file Arithmetic of Vec3 component by component, for chains of short calculations where each waits for the last.
/// Eigen works on the first two components together and on the third alone. What was written one by one a moment ago
/// can be read as a pair only once it has reached the cache, and a chain that changes between both waits every time.
#pragma once

#include "cairn/types.h"

namespace cairn::by_component {

inline Vec3 sum(const Vec3& x, const Vec3& y) {
    return {x.x() + y.x(), x.y() + y.y(), x.z() + y.z()};
}

inline Vec3 difference(const Vec3& x, const Vec3& y) {
    return {x.x() - y.x(), x.y() - y.y(), x.z() - y.z()};
}

inline Vec3 product(double s, const Vec3& x) {
    return {s * x.x(), s * x.y(), s * x.z()};
}

inline Vec3 negative(const Vec3& x) {
    return {-x.x(), -x.y(), -x.z()};
}

inline Vec3 cross(const Vec3& x, const Vec3& y) {
    return {x.y() * y.z() - x.z() * y.y(), x.z() * y.x() - x.x() * y.z(), x.x() * y.y() - x.y() * y.x()};
}

/// mᵀ·x
inline Vec3 transposedProduct(const Mat3& m, const Vec3& x) {
    const auto row = [&](Eigen::Index i) { return m(0, i) * x.x() + m(1, i) * x.y() + m(2, i) * x.z(); };
    return {row(0), row(1), row(2)};
}

/// m·x, bit for bit as Eigen's, which adds up the last row in another order.
inline Vec3 product(const Mat3& m, const Vec3& x) {
    const auto row = [&](Eigen::Index i) { return m(i, 0) * x.x() + m(i, 1) * x.y() + m(i, 2) * x.z(); };
    return {row(0), row(1), m(2, 0) * x.x() + (m(2, 1) * x.y() + m(2, 2) * x.z())};
}

inline void add(const Vec3& x, Vec3& to) {
    to.x() += x.x();
    to.y() += x.y();
    to.z() += x.z();
}

}  // namespace cairn::by_component
