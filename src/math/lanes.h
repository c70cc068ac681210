/// @file Four numbers that are worked on at once, and what is needed to write an algorithm once for them and for plain
/// numbers. Every lane is computed as a plain number would be, so that results do not depend on the processor.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "math/triple.h"

namespace cairn {

inline constexpr std::size_t lane_count = 4;

using Lanes = double __attribute__((vector_size(8 * lane_count)));
/// What comparisons of Lanes give: all bits of a lane set where they hold.
using LaneMask = std::int64_t __attribute__((vector_size(8 * lane_count)));

// Always inlined: these functions are compiled for several kinds of processors, which pass Lanes in different ways.

/// The first where the condition holds, the second elsewhere. Both are computed.
[[gnu::always_inline]] inline double where(bool condition, double yes, double no) {
    return condition ? yes : no;
}
[[gnu::always_inline]] inline Lanes where(const LaneMask& condition, const Lanes& yes, const Lanes& no) {
    return condition ? yes : no;
}

[[gnu::always_inline]] inline bool holdsInAll(bool condition) {
    return condition;
}
[[gnu::always_inline]] inline bool holdsInAll(const LaneMask& condition) {
    return (condition[0] & condition[1] & condition[2] & condition[3]) != 0;
}

[[gnu::always_inline]] inline double squareRoot(double x) {
    return std::sqrt(x);
}
[[gnu::always_inline]] inline Lanes squareRoot(const Lanes& x) {
    return Lanes{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
}

/// How many numbers a Number is.
template <class Number>
inline constexpr std::size_t lanes_in = sizeof(Number) / sizeof(double);

/// One of them.
[[gnu::always_inline]] inline double laneOf(double x, std::size_t) {
    return x;
}
[[gnu::always_inline]] inline double laneOf(const Lanes& x, std::size_t lane) {
    return x[lane];
}
[[gnu::always_inline]] inline void setLane(double& x, std::size_t, double value) {
    x = value;
}
[[gnu::always_inline]] inline void setLane(Lanes& x, std::size_t lane, double value) {
    x[lane] = value;
}

/// value(lane) of each lane.
template <class Number, class Value>
[[gnu::always_inline]] inline Number collect(const Value& value) {
    if constexpr (lanes_in<Number> == 1) {
        return value(0);
    } else {
        return Number{value(0), value(1), value(2), value(3)};
    }
}

/// Holds in the lanes where a number is not zero.
[[gnu::always_inline]] inline bool isNonzero(double x) {
    return x != 0;
}
[[gnu::always_inline]] inline LaneMask isNonzero(const Lanes& x) {
    return x != Lanes{};
}

/// Vectors of three numbers.
template <class Number>
inline Vec3 laneOf(const Triple<Number>& u, std::size_t lane) {
    return {laneOf(u.x(), lane), laneOf(u.y(), lane), laneOf(u.z(), lane)};
}
template <class Number>
inline void setLane(Triple<Number>& u, std::size_t lane, const Vec3& value) {
    setLane(u.x(), lane, value.x());
    setLane(u.y(), lane, value.y());
    setLane(u.z(), lane, value.z());
}

template <class Mask, class Number>
[[gnu::always_inline]] inline Triple<Number> where(const Mask& condition, const Triple<Number>& yes,
                                                   const Triple<Number>& no) {
    return {where(condition, yes.x(), no.x()), where(condition, yes.y(), no.y()), where(condition, yes.z(), no.z())};
}

#if defined(__x86_64__)
template <class Work>
[[gnu::target("avx2")]] void runWithAvx2(const Work& work) {
    work();
}
inline bool hasAvx2() {
    return __builtin_cpu_supports("avx2") != 0;
}
#else
template <class Work>
void runWithAvx2(const Work& work) {
    work();
}
inline bool hasAvx2() {
    return false;
}
#endif

/// Runs work on Numbers, compiled for the vectors that this processor has. @param work a callable that is always
/// inlined
template <class Number, class Work>
void runOnLanes(const Work& work) {
    if (lanes_in < Number >> 1 && hasAvx2()) {
        runWithAvx2(work);
    } else {
        work();
    }
}

}  // namespace cairn
