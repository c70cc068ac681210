/// @file Four numbers that are worked on at once, and what is needed to write an algorithm once for them and for plain
/// numbers. Every lane is computed as a plain number would be, so that results do not depend on the processor.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "cairn/types.h"

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

/// Four vectors of three numbers. What holds Lanes in memory must say how it is aligned: compilers assume less where
/// they know of no wide registers than where they do.
class alignas(sizeof(Lanes)) Lanes3 {
  public:
    Lanes3() = default;
    [[gnu::always_inline]] Lanes3(const Lanes& x, const Lanes& y, const Lanes& z) : x_(x), y_(y), z_(z) {}

    [[gnu::always_inline]] const Lanes& x() const { return x_; }
    [[gnu::always_inline]] const Lanes& y() const { return y_; }
    [[gnu::always_inline]] const Lanes& z() const { return z_; }

    [[gnu::always_inline]] Lanes dot(const Lanes3& u) const { return x_ * u.x_ + y_ * u.y_ + z_ * u.z_; }
    [[gnu::always_inline]] Lanes squaredNorm() const { return dot(*this); }
    [[gnu::always_inline]] Lanes3 cross(const Lanes3& u) const {
        return {y_ * u.z_ - z_ * u.y_, z_ * u.x_ - x_ * u.z_, x_ * u.y_ - y_ * u.x_};
    }
    [[gnu::always_inline]] Lanes3& operator+=(const Lanes3& u) { return *this = *this + u; }
    [[gnu::always_inline]] Lanes3& operator-=(const Lanes3& u) { return *this = *this - u; }
    [[gnu::always_inline]] friend Lanes3 operator+(const Lanes3& u, const Lanes3& v) {
        return {u.x_ + v.x_, u.y_ + v.y_, u.z_ + v.z_};
    }
    [[gnu::always_inline]] friend Lanes3 operator-(const Lanes3& u, const Lanes3& v) {
        return {u.x_ - v.x_, u.y_ - v.y_, u.z_ - v.z_};
    }
    [[gnu::always_inline]] friend Lanes3 operator*(const Lanes& s, const Lanes3& u) {
        return {s * u.x_, s * u.y_, s * u.z_};
    }

    /// One of the four.
    Vec3 lane(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
    void setLane(std::size_t i, const Vec3& u) {
        x_[i] = u.x();
        y_[i] = u.y();
        z_[i] = u.z();
    }

  private:
    Lanes x_{}, y_{}, z_{};
};

[[gnu::always_inline]] inline Vec3 where(bool condition, const Vec3& yes, const Vec3& no) {
    return condition ? yes : no;
}
[[gnu::always_inline]] inline Lanes3 where(const LaneMask& condition, const Lanes3& yes, const Lanes3& no) {
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
