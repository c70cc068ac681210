/// @file One contact in its own coordinates: basis, collision matrix and velocity. @source thesis §3.3 and §3.4
/// Contact coordinates are (normal, first tangent, second tangent); vectors without a frame in the name are in W.
#pragma once

#include <cstdint>

#include "body/contact.h"
#include "resolution/symmetric3.h"

namespace cairn {

/// Copy of what the resolution needs of one body, so that a batch lies densely in memory. Two cache lines.
struct alignas(64) LocalBody {
    Vec3 v;                         ///< [m/s, W]
    Vec3 w;                         ///< [rad/s, W]
    Symmetric3 inertia_inv;         ///< [1/(kg·m²), W]; 0 = infinite
    double mass_inv = 0;            ///< [1/kg]; 0 = infinite
    BodyIndex slot = 0;             ///< index in BodyState
    std::uint8_t struck = 0;        ///< 1 = a contact of it was processed
    std::int32_t shock_stage = -1;  ///< subset of the shock propagation; −1 = none
};

/// What stays constant of a contact while its batch is resolved, and the sum of its impulses. Four cache lines.
struct alignas(64) ContactFrame {
    Mat3 basis;                            ///< B = [x y z], contact to world (3.3.4)
    Vec3 r_a;                              ///< from the centre of mass of A to the contact [m, W]
    Vec3 r_b;                              ///< from the centre of mass of B to the contact [m, W]
    Symmetric3 k_inv;                      ///< K⁻¹ in contact coordinates [kg]
    Vec3 k_row;                            ///< first row of K in contact coordinates [1/kg]
    Vec3 impulse;                          ///< sum of the impulses on A [N·s, W]
    double restitution = 0;                ///< e
    double static_friction = 0;            ///< µs
    double kinetic_friction = 0;           ///< µk
    std::uint32_t a = 0;                   ///< index of A's LocalBody
    std::uint32_t b = 0;                   ///< index of B's LocalBody
    std::uint32_t rolling = rolls_freely;  ///< index of its RollingContact
    bool is_blocked = false;               ///< joints block all motion here in some direction

    static constexpr std::uint32_t rolls_freely = UINT32_MAX;
};

/// Orthonormal basis whose first column is the normal. @source thesis (3.3.1)–(3.3.4)
inline Mat3 contactBasis(const Vec3& normal) {
    // The thesis asks for n2 = 0 in the first case; below 1e-50 the square of the second case's y would underflow.
    constexpr double negligible = 1e-100;
    const double yz_squared = normal.y() * normal.y() + normal.z() * normal.z();
    const Vec3 y = normal.z() == 0 || yz_squared < negligible ? Vec3(normal.y(), -normal.x(), 0)
                                                              : Vec3(0, normal.z(), -normal.y());
    Mat3 basis;
    basis.col(0) = normal;
    basis.col(1) = y.normalized();
    basis.col(2) = normal.cross(basis.col(1));
    return basis;
}

/// Adds one body's part of K = Bᵀ (m⁻¹·1 − R·I⁻¹·R) B. Since R is skew-symmetric, −eₖᵀ·R·I⁻¹·R·eₗ equals
/// (r × eₖ)·I⁻¹·(r × eₗ), which needs no 3×3 products. @source thesis (3.4.11a), (3.4.12c)
inline void addCollisionMatrix(const LocalBody& body, const Vec3& r, const Mat3& basis, Symmetric3& k) {
    const Vec3 x = r.cross(basis.col(0));
    const Vec3 y = r.cross(basis.col(1));
    const Vec3 z = r.cross(basis.col(2));
    const Vec3 ix = body.inertia_inv * x;
    const Vec3 iy = body.inertia_inv * y;
    const Vec3 iz = body.inertia_inv * z;
    k.xx += body.mass_inv + x.dot(ix);
    k.xy += x.dot(iy);
    k.xz += x.dot(iz);
    k.yy += body.mass_inv + y.dot(iy);
    k.yz += y.dot(iz);
    k.zz += body.mass_inv + z.dot(iz);
}

/// The collision matrix in contact coordinates [1/kg].
inline Symmetric3 collisionMatrix(const ContactFrame& frame, const LocalBody& a, const LocalBody& b) {
    Symmetric3 k;
    addCollisionMatrix(a, frame.r_a, frame.basis, k);
    addCollisionMatrix(b, frame.r_b, frame.basis, k);
    return k;
}

/// Stores the first row of K and its inverse. @param k in contact coordinates [1/kg]. Where K cannot be inverted
/// (masses beyond what doubles can divide) the contact keeps its normal part only, and where not even that exists it
/// cannot be resolved: both parts become 0.
inline void setCollisionMatrix(ContactFrame& frame, const Symmetric3& k) {
    frame.is_blocked = false;
    frame.k_row = Vec3(k.xx, k.xy, k.xz);
    frame.k_inv = inverse(k);
    if (isFinite(frame.k_inv) && frame.k_inv.xx > 0) return;
    const double normal_part = 1 / k.xx;
    const bool usable = std::isfinite(normal_part) && normal_part > 0;
    frame.k_row = usable ? Vec3(k.xx, 0, 0) : Vec3(Vec3::Zero());
    frame.k_inv = Symmetric3{};
    frame.k_inv.xx = usable ? normal_part : 0;
}

/// False if no impulse can change the contact's velocity (both bodies have infinite mass).
inline bool isResolvable(const ContactFrame& frame) {
    return frame.k_inv.xx > 0;
}

/// ϑA − ϑB: velocity of A relative to B at the contact [m/s, contact coordinates]. @source thesis (3.4.1), (3.4.2)
inline Vec3 relativeVelocity(const ContactFrame& frame, const LocalBody& a, const LocalBody& b) {
    const Triple1 at_a = Triple1(a.v) + Triple1(a.w).cross(Triple1(frame.r_a));
    const Triple1 at_b = Triple1(b.v) + Triple1(b.w).cross(Triple1(frame.r_b));
    return toVec3(transposedProduct(frame.basis, at_a - at_b));
}

}  // namespace cairn
