/// The resolution of a batch as the thesis writes it down, slow and independent of the engine: every δ is computed from
/// its definition before every iteration, K by matrix products, no queue.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "batch_fixture.h"

namespace cairn::test {

inline Mat3 crossMatrix(const Vec3& r) {
    Mat3 m;
    m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    return m;
}

/// (3.3.1)–(3.3.4)
inline Mat3 basisOf(const Vec3& n) {
    const Vec3 y = (n.z() == 0 ? Vec3(n.y(), -n.x(), 0) : Vec3(0, n.z(), -n.y())).normalized();
    Mat3 basis;
    basis << n, y, n.cross(y);
    return basis;
}

/// (3.4.11a)
inline Mat3 worldCollisionMatrix(const Pile& pile, const Contact& c) {
    const auto part = [&](BodyIndex i) {
        const Mat3 r = crossMatrix(c.point - pile.position[i]);
        return Mat3(pile.mass_inv[i] * Mat3::Identity() - r * pile.inertiaInv_W[i] * r);
    };
    return part(c.a) + part(c.b);
}

/// Algorithm 8 with Algorithm 11.
inline void resolveByTheBook(Pile& pile, const Contact& c, const ResolutionSettings& settings) {
    const Mat3 basis = basisOf(c.normal);
    const Mat3 k = basis.transpose() * worldCollisionMatrix(pile, c) * basis;
    const Vec3 r_a = c.point - pile.position[c.a], r_b = c.point - pile.position[c.b];
    const Vec3 theta_a = basis.transpose() * (pile.v[c.a] + pile.w[c.a].cross(r_a));
    const Vec3 theta_b = basis.transpose() * (pile.v[c.b] + pile.w[c.b].cross(r_b));
    const double closing = theta_a[0] - theta_b[0];
    const double e = closing > -settings.restitution_threshold ? 0 : c.restitution;
    const Vec3 target(-(1 + e) * closing, theta_b[1] - theta_a[1], theta_b[2] - theta_a[2]);
    Vec3 j = k.inverse() * target;
    const double alpha = j[1] * j[1] + j[2] * j[2];
    if (alpha > c.static_friction * c.static_friction * j[0] * j[0]) {
        const double beta = c.kinetic_friction / std::sqrt(alpha);
        j[0] = target[0] / (k(0, 0) + beta * (k(0, 1) * j[1] + k(0, 2) * j[2]));
        const double lambda = beta * j[0];
        j[1] *= lambda;
        j[2] *= lambda;
    }
    const Vec3 impulse = basis * j;
    pile.v[c.a] += pile.mass_inv[c.a] * impulse;
    pile.w[c.a] += pile.inertiaInv_W[c.a] * r_a.cross(impulse);
    pile.v[c.b] -= pile.mass_inv[c.b] * impulse;
    pile.w[c.b] -= pile.inertiaInv_W[c.b] * r_b.cross(impulse);
}

/// Algorithm 9. @return iterations
inline std::int64_t resolveBatchByTheBook(Pile& pile, const ResolutionSettings& settings, std::int64_t limit) {
    for (std::int64_t iteration = 0; iteration < limit; ++iteration) {
        const Contact* fastest = nullptr;
        double smallest = -settings.resolution_threshold;
        for (const Contact& c : pile.contacts) {
            if (pile.delta(c) < smallest) {
                smallest = pile.delta(c);
                fastest = &c;
            }
        }
        if (fastest == nullptr) return iteration;
        resolveByTheBook(pile, *fastest, settings);
    }
    return limit;
}

}  // namespace cairn::test
