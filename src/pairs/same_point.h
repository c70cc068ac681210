/// @file When two contact points of a pair of bodies are the same one.
#pragma once

#include "cairn/types.h"

namespace cairn {

/// Two points are the same one if this part of the smaller body or less is between them when they are found at one
/// moment: parts of a compound that meet in a face share its corners …
inline constexpr double same_at_once = 1e-3;
/// … and if they are the nearest ones within this part, when a step is between them.
inline constexpr double same_after_a_step = 0.1;
/// Where one is found at the end of a step and the other at its beginning, points within this part keep apart the same
/// places, if their normals differ by as many radians or less.
inline constexpr double same_at_end = 0.05;

/// What the normals of two points of a pair add to the squared distance between them [m²]: 2.6° count as much as a
/// thousandth of the smaller body. @param size largest radius of the smaller body [m]
inline double squaredTurn(const Vec3& normal, const Vec3& other, double size) {
    constexpr double turning = same_at_once / 0.045;
    return turning * turning * size * size * (normal - other).squaredNorm();
}

/// Whether two points of a pair that are found at one moment are the same one.
/// @param one, other with point [m, W] and normal @param size largest radius of the smaller body [m]
template <class One, class Other>
bool isSameAtOnce(const One& one, const Other& other, double size) {
    const double apart = (one.point - other.point).squaredNorm() + squaredTurn(one.normal, other.normal, size);
    return apart <= same_at_once * same_at_once * size * size;
}

}  // namespace cairn
