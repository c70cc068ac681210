/// Bodies and contacts made by hand, without shapes, detection or batch generation.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "activity/selection.h"
#include "resolution/algorithms.h"
#include "resolution/contact_colours.h"
#include "resolution/resolution.h"

namespace cairn::test {

/// A small random generator (splitmix64): the same numbers everywhere.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double uniform(double low, double high) {
        state_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        z ^= z >> 31;
        return low + (high - low) * static_cast<double>(z >> 11) * 0x1.0p-53;
    }
    Vec3 vector(double size) {
        const double x = uniform(-size, size), y = uniform(-size, size), z = uniform(-size, size);
        return {x, y, z};
    }

  private:
    std::uint64_t state_;
};

/// Pairs of random bodies with one to four contacts each, ascending. @param moving bodies below this move
inline std::vector<ContactEnds> randomEnds(std::uint64_t seed, std::uint32_t bodies, std::size_t pairs) {
    Random random(seed);
    std::set<std::pair<std::uint32_t, std::uint32_t>> chosen;
    while (chosen.size() < pairs) {
        const auto a = static_cast<std::uint32_t>(random.uniform(0, bodies));
        const auto b = static_cast<std::uint32_t>(random.uniform(0, bodies));
        if (a != b) chosen.emplace(std::min(a, b), std::max(a, b));
    }
    std::vector<ContactEnds> ends;
    for (const auto& [a, b] : chosen) {
        const int contacts = 1 + static_cast<int>(random.uniform(0, 4));
        for (int i = 0; i < contacts; ++i) ends.push_back({a, b});
    }
    return ends;
}

struct Friction {
    double static_coefficient = 0;
    double kinetic_coefficient = 0;
};

/// One batch: all bodies and contacts that were added.
class Pile : public BodyStorage {
  public:
    std::vector<Contact> contacts;
    Vec3 gravity = Vec3::Zero();  ///< whose work in the step the velocities have already [m/s²]
    double wake_speed = 8.33e-3;  ///< SelectionInput::wake_speed [m/s]

    BodyIndex add(const Vec3& at, double m, const Mat3& inertia) {
        const BodyIndex i = addFixed(at);
        kind[i] = BodyKind::dynamic;
        mass_inv[i] = 1 / m;
        inertiaInv_W[i] = inertia.inverse();
        return i;
    }
    BodyIndex addSphere(const Vec3& at, double m = 1, double radius = 0.5) {
        return add(at, m, 0.4 * m * radius * radius * Mat3::Identity());
    }
    BodyIndex addBox(const Vec3& at, double m, const Vec3& size) {
        const Vec3 s = size.cwiseAbs2();
        const Vec3 moments = m / 12 * Vec3(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
        return add(at, m, moments.asDiagonal());
    }
    BodyIndex addFixed(const Vec3& at = Vec3::Zero()) {
        const BodyIndex i = allocate(BodyKind::fixed);
        position[i] = at;
        return i;
    }
    /// @param normal from b to a
    Contact& touch(BodyIndex a, BodyIndex b, const Vec3& point, const Vec3& normal, double restitution = 0,
                   Friction friction = {}) {
        Contact c;
        c.a = a;
        c.b = b;
        c.point = point;
        c.normal = normal;
        c.restitution = restitution;
        c.static_friction = friction.static_coefficient;
        c.kinetic_friction = friction.kinetic_coefficient;
        c.allowed_overlap = 1e-3;
        contacts.push_back(c);
        return contacts.back();
    }
    ResolutionCounts resolve(const ResolutionSettings& settings) {
        return resolve(*makeResolution(settings.resolution), settings);
    }
    ResolutionCounts resolve(Resolution& resolution, const ResolutionSettings& settings,
                             const Executor& executor = Executor{}) {
        std::vector<BodyIndex> bodies;
        for (BodyIndex i = 0; i < kind.size(); ++i) {
            if (kind[i] == BodyKind::dynamic) bodies.push_back(i);
        }
        std::vector<std::uint32_t> indices(contacts.size());
        std::iota(indices.begin(), indices.end(), 0U);
        const BatchView batch{bodies, indices, {}};
        BodyState all = state();
        all.time_step = 1.0 / 240;
        all.damped_fall = gravity / 240;
        const bool parts = settings.resolution == ResolutionKind::accelerated_sweeps;
        Selection selection;
        selection.begin({{&batch, 1},
                         contacts,
                         all,
                         parts ? Selecting::awake_parts : Selecting::awake_batches,
                         wake_speed,
                         executor});
        all.held = selection.held();
        ResolutionCounts counts;
        do {
            counts.add(resolution.resolve({selection.chosen(), contacts, all, settings, executor}));
        } while (selection.widen());
        selection.finish();
        return counts;
    }

    /// δ of a contact, straight from its definition. @source thesis (3.4.2)
    double delta(const Contact& c) const {
        const Vec3 a = v[c.a] + w[c.a].cross(c.point - position[c.a]);
        const Vec3 b = v[c.b] + w[c.b].cross(c.point - position[c.b]);
        return c.normal.dot(a - b);
    }
    double smallestDelta() const {
        double smallest = 0;
        for (const Contact& c : contacts) smallest = std::min(smallest, delta(c));
        return smallest;
    }
    Vec3 momentum() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < kind.size(); ++i) {
            if (kind[i] == BodyKind::dynamic) sum += v[i] / mass_inv[i];
        }
        return sum;
    }
    Vec3 angularMomentum() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < kind.size(); ++i) {
            if (kind[i] != BodyKind::dynamic) continue;
            sum += position[i].cross(Vec3(v[i] / mass_inv[i])) + inertiaInv_W[i].inverse() * w[i];
        }
        return sum;
    }
    double energy() const {
        double sum = 0;
        for (std::size_t i = 0; i < kind.size(); ++i) {
            if (kind[i] != BodyKind::dynamic) continue;
            sum += 0.5 * v[i].squaredNorm() / mass_inv[i] + 0.5 * w[i].dot(inertiaInv_W[i].inverse() * w[i]);
        }
        return sum;
    }
};

/// Resolves a pile by the thesis's algorithm with other constants.
inline ResolutionCounts resolveWith(const QueueConstants& constants, Pile& pile, const ResolutionSettings& settings) {
    return pile.resolve(*makePerBatch([&] { return makeImpulseQueueResolution(constants); }), settings);
}

/// Settings that resolve everything to the end by the global algorithm.
inline ResolutionSettings exactSettings() {
    ResolutionSettings settings;
    settings.resolution_threshold = 1e-9;
    settings.restitution_threshold = 1e-3;
    settings.resolution = ResolutionKind::impulse_queue;
    settings.iterations = 0;
    settings.shock_propagation = false;
    return settings;
}

inline Mat3 randomInertia(Random& random, double mass) {
    const Vec3 moments(random.uniform(0.3, 0.6), random.uniform(0.3, 0.6), random.uniform(0.3, 0.6));
    const Mat3 r = Quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))
                       .normalized()
                       .toRotationMatrix();
    return mass * (r * moments.asDiagonal() * r.transpose());
}

/// Bodies of random mass and inertia at random places, falling towards each other, with contacts between neighbours.
/// @param fixed bodies among them @param contact supplies restitution and friction
inline Pile randomPile(std::uint64_t seed, std::size_t bodies, std::size_t contacts, std::size_t fixed = 0,
                       double restitution = 0.25, Friction friction = {0.4, 0.3}) {
    Random random(seed);
    Pile pile;
    for (std::size_t i = 0; i < bodies; ++i) {
        const Vec3 at = random.vector(std::cbrt(static_cast<double>(bodies)));
        if (i < fixed) {
            pile.addFixed(at);
            continue;
        }
        const double mass = random.uniform(0.5, 3);
        const BodyIndex body = pile.add(at, mass, randomInertia(random, mass));
        pile.v[body] = -0.3 * at + random.vector(0.2);
        pile.w[body] = random.vector(0.5);
    }
    while (pile.contacts.size() < contacts) {
        const auto pick = [&] { return static_cast<BodyIndex>(random.uniform(0, static_cast<double>(bodies))); };
        const BodyIndex first = pick(), second = pick();
        const BodyIndex a = std::min(first, second), b = std::max(first, second);
        if (a == b || b < fixed) continue;
        const Vec3 normal = (pile.position[a] - pile.position[b]).normalized();
        const Vec3 point = 0.5 * (pile.position[a] + pile.position[b]) + random.vector(0.1);
        pile.touch(a, b, point, normal, restitution, friction);
    }
    std::sort(pile.contacts.begin(), pile.contacts.end(),
              [](const Contact& x, const Contact& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
    return pile;
}

/// @param rounding what may differ, as a part
inline bool isSame(const Vec3& x, const Vec3& y, double rounding) {
    return (x - y).norm() <= rounding * y.norm() || (x.hasNaN() && y.hasNaN());
}

/// Resolves hundreds of pairs as one batch, and each alone. @param add as add(pile, number, random)
/// @param rounding as of isSame()
template <class Add>
void expectAsEachAlone(const Add& add, const ResolutionSettings& settings, double rounding) {
    constexpr std::size_t pairs = 400;
    Pile all;
    all.addFixed();
    Random random(11);
    for (std::size_t number = 0; number < pairs; ++number) add(all, number, random);
    ASSERT_GT(all.contacts.size(), 512U);
    all.resolve(settings);

    random = Random(11);
    std::size_t next = 1;
    std::size_t next_contact = 0;
    for (std::size_t number = 0; number < pairs; ++number) {
        Pile alone;
        alone.addFixed();
        add(alone, number, random);
        alone.resolve(settings);
        for (std::size_t i = 1; i < alone.v.size(); ++i, ++next) {
            EXPECT_TRUE(isSame(all.v[next], alone.v[i], rounding)) << number;
            EXPECT_TRUE(isSame(all.w[next], alone.w[i], rounding)) << number;
        }
        for (const Contact& contact : alone.contacts) {
            const Contact& same = all.contacts[next_contact++];
            EXPECT_TRUE(isSame(same.impulse, contact.impulse, rounding)) << number;
            EXPECT_TRUE(isSame(same.angular_impulse, contact.angular_impulse, rounding)) << number;
        }
    }
}

}  // namespace cairn::test
