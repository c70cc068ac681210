/// @file Numbers from the bytes that the fuzzer gives.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "cairn/settings.h"
#include "cairn/shape.h"

namespace cairn::fuzz {

/// Ends the program where the fuzzer must notice.
inline void require(bool fulfilled) {
    if (!fulfilled) std::abort();
}

/// Settings may allow a step any number of iterations, and some batches take millions; one thread and a few do here.
inline void boundWork(Settings& settings) {
    constexpr double most = 100;
    double& iterations = settings.resolution.iterations;
    iterations = iterations == 0 ? most : std::min(iterations, most);
    settings.parallel.threads = 1;
}

/// What the numbers are like: those of a usual scene, or anything.
enum class Range : std::uint8_t { usual, any };

/// Takes numbers off the front; zeros once the bytes are used up.
class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

    void setRange(Range range) { range_ = range; }
    Range range() const { return range_; }

    bool empty() const { return left_.empty(); }
    template <class T>
    T take() {
        std::array<std::uint8_t, sizeof(T)> raw{};
        const std::size_t count = left_.size() < sizeof(T) ? left_.size() : sizeof(T);
        std::memcpy(raw.data(), left_.data(), count);
        left_ = left_.subspan(count);
        T value;
        std::memcpy(&value, raw.data(), sizeof(T));
        return value;
    }
    /// A whole number within [0, count).
    std::uint32_t below(std::uint32_t count) { return take<std::uint16_t>() % count; }
    /// Any double at all, with infinities and NaN.
    double any() { return take<double>(); }
    /// A number within ±limit.
    double within(double limit) { return limit * static_cast<double>(take<std::int32_t>()) / 2147483648.0; }
    /// Mostly a usual number, sometimes any where any is wanted.
    double number(double limit) {
        if (range_ == Range::usual) return within(limit);
        return take<std::uint8_t>() < 8 ? any() : within(limit);
    }
    Vec3 vector(double limit) {
        const double x = number(limit);
        const double y = number(limit);
        return {x, y, number(limit)};
    }

  private:
    std::span<const std::uint8_t> left_;
    Range range_ = Range::any;
};

/// A length from a micrometre to a kilometre, or usual ones from 0.1 to 1 m.
inline double length(Bytes& in) {
    static constexpr std::array<double, 6> scales = {1e-5, 1e-3, 0.1, 1, 30, 1000};
    if (in.range() == Range::usual) return 0.1 + 0.9 * std::abs(in.within(1));
    return scales[in.below(scales.size())] * (0.1 + 0.9 * std::abs(in.within(1)));
}

/// A hull of up to 11 points, often on a grid so that faces have many corners. @throws InputError if they are flat
inline ConvexHull hull(Bytes& in) {
    const double scale = length(in);
    const bool grid = in.below(2) == 0;
    std::vector<Vec3> points(4 + in.below(8));
    for (Vec3& point : points) {
        for (double& x : point) x = grid ? static_cast<double>(in.below(3)) - 1 : in.within(1);
        point *= scale;
    }
    return ConvexHull(std::move(points));
}

/// A shape without parts. @throws InputError if it is not allowed
inline Shape shape(Bytes& in) {
    switch (in.below(6)) {
        case 0:
            return Sphere{length(in)};
        case 1: {
            const double x = length(in);
            const double y = in.below(2) == 0 ? x : length(in);
            return Box{Vec3(x, y, in.below(2) == 0 ? x : length(in))};
        }
        case 2: {
            const double radius = length(in);
            return Capsule{radius, length(in)};
        }
        case 3: {
            const double radius = length(in);
            return Cylinder{radius, length(in)};
        }
        case 4:
            return hull(in);
        default:
            return HalfSpace{Vec3(in.within(1), in.within(1), 1.5 + in.within(1)), in.within(2)};
    }
}

/// A rotation, often one that makes edges and faces parallel.
inline Quat rotation(Bytes& in) {
    static constexpr double half = 0.70710678118654752;
    switch (in.below(4)) {
        case 0:
            return Quat::Identity();
        case 1:
            return Quat(half, half, 0, 0);
        case 2:
            return Quat(1, in.within(1e-7), in.within(1e-7), in.within(1e-7)).normalized();
        default: {
            const Quat q(in.within(1), in.within(1), in.within(1), in.within(1));
            return q.norm() > 1e-3 ? q.normalized() : Quat::Identity();
        }
    }
}

/// Any shape, also of parts. @throws InputError if it is not allowed
inline Shape anyShape(Bytes& in) {
    if (in.below(6) != 0) return shape(in);
    Compound compound;
    for (std::uint32_t left = 1 + in.below(3); left > 0; --left) {
        const Shape part = shape(in);
        compound.parts.push_back({part, {Vec3(in.within(1), in.within(1), in.within(1)), rotation(in)}, {}, {}});
    }
    return compound;
}

}  // namespace cairn::fuzz
