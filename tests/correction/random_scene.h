/// @file Random worlds of contacts, the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>

#include "correction/contact_scene.h"

namespace cairn::test {

/// Splitmix64: the standard distributions differ between libraries.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31U);
    }
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(next() >> 11U) * 0x1p-53);
    }
    std::size_t below(std::size_t count) { return next() % count; }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    Vec3 direction() {
        for (;;) {
            const Vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
        }
    }

  private:
    std::uint64_t state_;
};

/// Bodies at random places with contacts between random pairs. Normals mostly point from centre to centre, as in a
/// pile, sometimes anywhere; distances are around the threshold; many bodies have no velocity, some sleep.
/// @param largest number of bodies, ≥ 2
inline ContactScene randomScene(std::uint64_t seed, std::size_t largest = 11) {
    Random random(seed);
    ContactScene scene;
    scene.settings.penetration_threshold = random.chance(0.2) ? 1e-9 : 1.74e-3;
    scene.remaining_part = random.uniform(0.1, 0.9);
    const std::size_t bodies = 2 + random.below(largest - 1);
    for (std::size_t i = 0; i < bodies; ++i) {
        const Vec3 at(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
        const BodyIndex body = random.chance(0.15) ? scene.addFixed(at) : scene.addBody(at);
        if (scene.kind[body] == BodyKind::fixed) continue;
        if (random.chance(0.6)) scene.moveBy(body, random.uniform(0, 0.02) * random.direction());
        if (random.chance(0.5)) scene.w[body] = random.uniform(0, 5) * random.direction();
        scene.asleep[body] = random.chance(0.3) ? 1 : 0;
    }
    const std::size_t contacts = 1 + random.below(3 * bodies);
    for (std::size_t i = 0; i < contacts; ++i) {
        const auto x = static_cast<BodyIndex>(random.below(bodies));
        const auto y = static_cast<BodyIndex>(random.below(bodies));
        if (x == y || (scene.kind[x] == BodyKind::fixed && scene.kind[y] == BodyKind::fixed)) continue;
        const Vec3 between = (scene.position[x] - scene.position[y]).normalized();
        const double distance = random.chance(0.5) ? random.uniform(-5e-3, 0) : random.uniform(-2e-3, 1e-3);
        scene.touch(x, y, random.chance(0.8) ? between : random.direction(), distance);
    }
    return scene;
}

}  // namespace cairn::test
