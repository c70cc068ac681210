/// @file Random numbers that are the same everywhere.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace cairn::validation {

/// splitmix64, by Vigna.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    /// In [0, 1).
    double uniform() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
    }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// Normal with variance 1 (Box and Muller).
    double normal() {
        const double radius = std::sqrt(-2 * std::log(1 - uniform()));
        return radius * std::cos(2 * std::numbers::pi * uniform());
    }

  private:
    std::uint64_t state_;
};

}  // namespace cairn::validation
