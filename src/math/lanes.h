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

/// Four vectors of three numbers.
using Lanes3 = Triple<Lanes>;

/// One of the four.
inline Vec3 laneOf(const Lanes3& u, std::size_t lane) {
    return {u.x()[lane], u.y()[lane], u.z()[lane]};
}
inline void setLane(Lanes3& u, std::size_t lane, const Vec3& value) {
    u.x()[lane] = value.x();
    u.y()[lane] = value.y();
    u.z()[lane] = value.z();
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

/// Runs work compiled for the vectors that this processor has. @param work a callable that is always inlined
template <class Work>
void runOnLanes(const Work& work) {
    if (hasAvx2()) {
        runWithAvx2(work);
    } else {
        work();
    }
}

}  // namespace cairn
