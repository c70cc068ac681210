/// @file Bounds to feed the broad phase with, and a generator of random numbers that is the same everywhere.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "broad_phase/broad_phase.h"

namespace cairn::broad_phase_tests {

/// splitmix64.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
    }
    double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    Vec3 inBox(double half) {
        const double x = uniform(-half, half);
        const double y = uniform(-half, half);
        const double z = uniform(-half, half);
        return {x, y, z};
    }
    std::size_t below(std::size_t limit) { return static_cast<std::size_t>(bits() % limit); }

  private:
    std::uint64_t state_;
};

/// Owns what a BroadPhaseInput looks at.
struct Bodies {
    std::vector<BodyKind> kind;
    std::vector<Bounds> bounds;
    std::vector<std::uint8_t> still;  ///< empty = none is

    void add(const Bounds& b, BodyKind k = BodyKind::dynamic) {
        kind.push_back(k);
        bounds.push_back(b);
    }
    void add(const Vec3& centre, const Vec3& half, BodyKind k = BodyKind::dynamic) {
        add(Bounds{centre - half, centre + half}, k);
    }
    void shuffle(Random& random) {
        for (std::size_t i = kind.size(); i > 1; --i) {
            const std::size_t j = random.below(i);
            std::swap(kind[i - 1], kind[j]);
            std::swap(bounds[i - 1], bounds[j]);
        }
    }
    BroadPhaseInput input() const { return {kind, bounds, still}; }
    std::size_t size() const { return kind.size(); }
};

/// Equal cubes on a jittered lattice, each overlapping some of its neighbours.
inline Bodies densePile(Random& random, int edge, const Vec3& origin = Vec3::Zero()) {
    Bodies bodies;
    for (int z = 0; z < edge; ++z) {
        for (int y = 0; y < edge; ++y) {
            for (int x = 0; x < edge; ++x) {
                bodies.add(origin + Vec3(x, y, z) + random.inBox(0.1), Vec3::Constant(0.5));
            }
        }
    }
    return bodies;
}

/// Boxes of all sizes between `smallest` and 1000 times that, packed so that most overlap something.
inline Bodies allSizes(Random& random, std::size_t count, double smallest, const Vec3& origin) {
    Bodies bodies;
    for (std::size_t i = 0; i < count; ++i) {
        const double size = random.logUniform(smallest, 1000 * smallest);
        const Vec3 half(size * random.uniform(0.1, 1), size * random.uniform(0.1, 1), size * random.uniform(0.1, 1));
        const BodyKind kind = random.below(8) == 0 ? BodyKind::fixed : BodyKind::dynamic;
        bodies.add(origin + random.inBox(1500 * smallest), half, kind);
    }
    return bodies;
}

}  // namespace cairn::broad_phase_tests
