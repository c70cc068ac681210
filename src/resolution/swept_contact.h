/// @file The contact law with accumulated impulses, as the accelerated sweeps apply it to one contact at a time.
#pragma once

#include <algorithm>
#include <cmath>

#include "body/contact.h"
#include "resolution/contact_frame.h"

namespace cairn {

/// All that a sweep reads and writes of a contact, in world coordinates, side by side: four cache lines, of which a
/// contact that sticks needs three.
struct alignas(64) SweptContact {
    Vec3 impulse;                ///< accumulated, on A [N·s]; always in the friction cone after a visit
    Vec3 normal;                 ///< from B to A
    Vec3 r_a;                    ///< from the centre of mass of A to the contact [m]
    Vec3 r_b;                    ///< from the centre of mass of B to the contact [m]
    Symmetric3 k_inv;            ///< K⁻¹ [kg]; 0 if no impulse can change the contact's velocity
    double target = 0;           ///< normal velocity that the contact must at least have [m/s]
    double friction = 0;         ///< coefficient that holds at present: static, once it slides kinetic
    std::uint32_t a = 0;         ///< index of A's LocalBody
    std::uint32_t b = 0;         ///< index of B's LocalBody
    Symmetric3 k;                ///< K [1/kg]
    double normal_mass = 0;      ///< 1 / (nᵀ·K·n) [kg]
    double tangential_mass = 0;  ///< 1 / largest eigenvalue of K's tangential part [kg]
};

/// Rounds of slidingSteps() in every visit of a sliding contact. The sweeps converge with any number; a few save
/// sweeps.
constexpr int sliding_rounds = 2;

/// Adds one body's part −R·I⁻¹·R + m⁻¹·1 of K. @source thesis (3.4.11a)
inline void addCollisionMatrix(const LocalBody& body, const Vec3& r, Symmetric3& k) {
    const Symmetric3& i = body.inertia_inv;
    // Rows of [r]×·I⁻¹, then the columns that are needed of its product with [r]×ᵀ.
    const Vec3 x(r.y() * i.xz - r.z() * i.xy, r.y() * i.yz - r.z() * i.yy, r.y() * i.zz - r.z() * i.yz);
    const Vec3 y(r.z() * i.xx - r.x() * i.xz, r.z() * i.xy - r.x() * i.yz, r.z() * i.xz - r.x() * i.zz);
    const Vec3 z(r.x() * i.xy - r.y() * i.xx, r.x() * i.yy - r.y() * i.xy, r.x() * i.yz - r.y() * i.xz);
    k.xx += body.mass_inv + r.y() * x.z() - r.z() * x.y();
    k.xy += r.z() * x.x() - r.x() * x.z();
    k.xz += r.x() * x.y() - r.y() * x.x();
    k.yy += body.mass_inv + r.z() * y.x() - r.x() * y.z();
    k.yz += r.x() * y.y() - r.y() * y.x();
    k.zz += body.mass_inv + r.x() * z.y() - r.y() * z.x();
}

/// Stores K and what follows from it. Where K cannot be inverted (masses beyond what doubles can divide) the contact
/// keeps its normal part only, and where not even that exists it cannot be resolved. @param k [1/kg, W]
inline void setCollisionMatrix(SweptContact& contact, const Symmetric3& k) {
    const Vec3& n = contact.normal;
    const Vec3 k_n = k * n;
    const double k_nn = n.dot(k_n);
    contact.k = k;
    contact.k_inv = inverse(k);
    contact.normal_mass = 1 / k_nn;
    // Of the tangential part of K: its trace, and its determinant as the cofactor of k_nn.
    const double mean = (k.xx + k.yy + k.zz - k_nn) / 2;
    const Vec3 y_cross_z(k.yy * k.zz - k.yz * k.yz, k.xz * k.yz - k.xy * k.zz, k.xy * k.yz - k.xz * k.yy);
    const Symmetric3 cofactors{y_cross_z.x(),
                               y_cross_z.y(),
                               y_cross_z.z(),
                               k.xx * k.zz - k.xz * k.xz,
                               k.xy * k.xz - k.xx * k.yz,
                               k.xx * k.yy - k.xy * k.xy};
    const double half = std::sqrt(std::max(0.0, mean * mean - n.dot(cofactors * n)));
    contact.tangential_mass = 1 / (mean + half);
    if (isFinite(contact.k_inv) && n.dot(contact.k_inv * n) > 0 && std::isfinite(contact.tangential_mass)) return;
    const bool usable = std::isfinite(contact.normal_mass) && contact.normal_mass > 0;
    contact.tangential_mass = 0;
    contact.normal_mass = usable ? contact.normal_mass : 0;
    contact.k = usable ? Symmetric3::from(k_nn * n * n.transpose()) : Symmetric3{};
    contact.k_inv = Symmetric3::from(contact.normal_mass * n * n.transpose());
}

inline bool isResolvable(const SweptContact& contact) {
    return contact.normal_mass > 0;
}

/// ϑA − ϑB [m/s, W]. @source thesis (3.4.1), (3.4.2)
inline Vec3 relativeVelocity(const SweptContact& contact, const LocalBody& a, const LocalBody& b) {
    return (a.v + a.w.cross(contact.r_a)) - (b.v + b.w.cross(contact.r_b));
}

/// The impulse moved into the friction cone, along the tangent. @param normal_part of the impulse wanted [N·s]
inline Vec3 ontoCone(const SweptContact& contact, double normal_part, const Vec3& tangential) {
    const double limit = contact.friction * normal_part;
    const double squared = tangential.squaredNorm();
    const double scale = squared > limit * limit ? limit / std::sqrt(squared) : 1;
    return normal_part * contact.normal + scale * tangential;
}

/// The accumulated impulse of a contact that slides: in turns the normal part gives the target velocity and the
/// tangential part is moved against the sliding velocity and put back onto the friction cone. What stays the same under
/// this is Coulomb's law: friction exactly against the sliding. The direction of the impulse that would stop the
/// sliding at once, which the law of a single impact takes, is another one wherever the normal and tangential
/// directions are coupled, and lets a sliding box feel too little friction.
/// @param velocity ϑA − ϑB less the target, with the present impulse [m/s]
inline Vec3 slidingSteps(const SweptContact& contact, const Vec3& velocity) {
    const Vec3& n = contact.normal;
    Vec3 j = contact.impulse;
    Vec3 c = velocity;
    for (int round = 0; round < sliding_rounds; ++round) {
        const double j_n = n.dot(j);
        const double normal = std::max(0.0, j_n - n.dot(c) * contact.normal_mass);
        if (!(normal > 0) && !(j_n > 0)) return Vec3::Zero();  // it separates by itself
        const Vec3 push = (normal - j_n) * n;
        c += contact.k * push;
        const Vec3 tangential = j - j_n * n - contact.tangential_mass * (c - n.dot(c) * n);
        const Vec3 next = ontoCone(contact, normal, tangential);
        if (round + 1 < sliding_rounds) c += contact.k * (next - j - push);
        j = next;
    }
    return j;
}

/// The accumulated impulse that gives the contact its target velocity and stops its sliding, within the friction cone.
/// @param velocity ϑA − ϑB with the present impulse [m/s]
inline Vec3 projectedImpulse(const SweptContact& contact, const Vec3& velocity) {
    const Vec3 excess = velocity - contact.target * contact.normal;
    const Vec3 stick = contact.impulse - contact.k_inv * excess;
    const double normal = contact.normal.dot(stick);
    const double tangential = (stick - normal * contact.normal).squaredNorm();
    const double cone = contact.friction * normal;
    if (normal > 0 && tangential <= cone * cone) return stick;
    return slidingSteps(contact, excess);
}

}  // namespace cairn
