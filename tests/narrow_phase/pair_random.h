/// @file Random poses and shapes for the tests of the narrow phase, the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "cairn/shape.h"

namespace cairn::testing {

/// splitmix64.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31U);
    }
    double uniform(double lower, double upper) {
        return lower + (upper - lower) * static_cast<double>(bits() >> 11U) * 0x1p-53;
    }
    int below(int count) { return static_cast<int>(bits() % static_cast<std::uint64_t>(count)); }
    Vec3 vector(double extent) {
        const double x = uniform(-extent, extent);
        const double y = uniform(-extent, extent);
        return {x, y, uniform(-extent, extent)};
    }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = vector(1);
            if (v.squaredNorm() > 0.01 && v.squaredNorm() < 1) return v.normalized();
        }
    }
    Quat orientation() {
        for (;;) {
            const Vec3 v = vector(1);
            const Quat q(uniform(-1, 1), v.x(), v.y(), v.z());
            if (q.squaredNorm() > 0.01 && q.squaredNorm() < 1) return q.normalized();
        }
    }
    /// One of the orientations that make edges and faces parallel, exactly or nearly.
    Quat alignedOrientation() {
        constexpr double angles[] = {0, 0.25, 0.5, 0.75, 1};
        Quat q = Quat::Identity();
        for (int axis = 0; axis < 3; ++axis) {
            q = q * Quat(Eigen::AngleAxisd(angles[below(5)] * std::numbers::pi, Vec3::Unit(axis)));
        }
        return q.normalized();
    }
    /// Turns a little, by 1e-1 to 1e-14 rad.
    Quat nearly(const Quat& q) {
        const double angle = std::pow(10.0, -1 - below(14));
        return (Quat(Eigen::AngleAxisd(angle, direction())) * q).normalized();
    }
    /// Any finite shape.
    Shape solid(double size) {
        if (below(4) != 0) return shape(size);
        return Cylinder{length(0.5 * size), length(size)};
    }
    /// A sphere, box or capsule whose lengths are up to `size` and not less than a tenth of it.
    Shape shape(double size) {
        switch (below(3)) {
            case 0:
                return Sphere{length(0.5 * size)};
            case 1:
                return box(size);
            default:
                return Capsule{length(0.3 * size), length(size)};
        }
    }
    Box box(double size) {
        const double x = length(size);
        const double y = length(size);
        return Box{{x, y, length(size)}};
    }
    double length(double size) { return uniform(0.1 * size, size); }

  private:
    std::uint64_t state_;
};

}  // namespace cairn::testing
