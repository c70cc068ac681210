/// @file The contact law with accumulated impulses, as the accelerated sweeps apply it to one contact at a time, or to
/// four that share no body.
#pragma once

#include <cmath>

#include "math/lanes.h"
#include "resolution/contact_colours.h"
#include "resolution/contact_frame.h"

namespace cairn {

/// All that a sweep reads and writes of a contact, in world coordinates, side by side.
/// @tparam NumberType of one contact a plain number, of four Lanes
template <class NumberType>
struct alignas(sizeof(NumberType)) BasicPgsContact {
    using Number = NumberType;
    using Vector = Triple<Number>;
    using Symmetric = BasicSymmetric3<Number>;

    Vector impulse;            ///< accumulated, on A [N·s]; always in the friction cone after a visit
    Vector normal;             ///< from B to A
    Vector r_a;                ///< from the centre of mass of A to the contact [m]
    Vector r_b;                ///< from the centre of mass of B to the contact [m]
    Symmetric k_inv;           ///< K⁻¹ [kg]; 0 if no impulse can change the contact's velocity
    Number target{};           ///< normal velocity that the contact must at least have [m/s]
    Number friction{};         ///< coefficient that holds at present: static, once it slides kinetic
    Symmetric k;               ///< K [1/kg]
    Number normal_mass{};      ///< 1 / (nᵀ·K·n) [kg]
    Number tangential_mass{};  ///< 1 / largest eigenvalue of K's tangential part [kg]

    /// What sweeps accumulate.
    using Accumulated = Vector;
    [[gnu::always_inline]] const Accumulated& accumulated() const { return impulse; }
    [[gnu::always_inline]] void add(const Accumulated& step) { impulse += step; }
};

/// One contact: four cache lines, of which a contact that sticks needs three.
struct alignas(64) PgsContact : ContactEnds, BasicPgsContact<double> {};

/// Four contacts.
using WideContact = BasicPgsContact<Lanes>;

/// What a visit reads and writes of a body, or of the four of four contacts.
template <class Number>
struct PgsBody {
    Triple<Number> v;  ///< [m/s, W]
    Triple<Number> w;  ///< [rad/s, W]
    Number mass_inv{};
    BasicSymmetric3<Number> inertia_inv;
};

/// Rounds of slidingSteps() in every visit of a sliding contact. The sweeps converge with any number; a few save
/// sweeps.
constexpr int sliding_rounds = 2;

/// The same of a body that no impulse moves.
template <class Number>
struct PgsFixedBody {
    Triple<Number> v;  ///< [m/s, W]
    Triple<Number> w;  ///< [rad/s, W]
};

inline PgsFixedBody<double> readFixed(const LocalBody& body) {
    return {Triple1(body.v), Triple1(body.w)};
}
inline PgsBody<double> read(const LocalBody& body) {
    return {Triple1(body.v), Triple1(body.w), body.mass_inv, body.inertia_inv};
}
inline void write(const PgsBody<double>& pgs, LocalBody& body) {
    body.v = toVec3(pgs.v);
    body.w = toVec3(pgs.w);
}

/// Adds one body's part −R·I⁻¹·R + m⁻¹·1 of K. @source thesis (3.4.11a)
template <class Number>
[[gnu::always_inline]] inline void addCollisionMatrix(const Number& mass_inv, const BasicSymmetric3<Number>& i,
                                                      const Triple<Number>& r, BasicSymmetric3<Number>& k) {
    using Vector = Triple<Number>;
    // Rows of [r]×·I⁻¹, then the columns that are needed of its product with [r]×ᵀ.
    const Vector x(r.y() * i.xz - r.z() * i.xy, r.y() * i.yz - r.z() * i.yy, r.y() * i.zz - r.z() * i.yz);
    const Vector y(r.z() * i.xx - r.x() * i.xz, r.z() * i.xy - r.x() * i.yz, r.z() * i.xz - r.x() * i.zz);
    const Vector z(r.x() * i.xy - r.y() * i.xx, r.x() * i.yy - r.y() * i.xy, r.x() * i.yz - r.y() * i.xz);
    k.xx += mass_inv + r.y() * x.z() - r.z() * x.y();
    k.xy += r.z() * x.x() - r.x() * x.z();
    k.xz += r.x() * x.y() - r.y() * x.x();
    k.yy += mass_inv + r.z() * y.x() - r.x() * y.z();
    k.yz += r.x() * y.y() - r.y() * y.x();
    k.zz += mass_inv + r.x() * z.y() - r.y() * z.x();
}

/// What follows from a matrix that turns what acts along a normal and across it into motion.
template <class Number>
struct BasicResponse {
    BasicSymmetric3<Number> inverse;
    Number normal_mass;      ///< 1 / (nᵀ·K·n)
    Number tangential_mass;  ///< 1 / largest eigenvalue of K's tangential part
};

/// As far as K can be inverted.
template <class Number>
[[gnu::always_inline]] inline BasicResponse<Number> responseOf(const BasicSymmetric3<Number>& k,
                                                               const Triple<Number>& n) {
    const Number k_nn = n.dot(k * n);
    // Of the tangential part of K: its trace, and its determinant as the cofactor of k_nn.
    const Number mean = (k.xx + k.yy + k.zz - k_nn) / 2;
    const Triple<Number> y_cross_z(k.yy * k.zz - k.yz * k.yz, k.xz * k.yz - k.xy * k.zz, k.xy * k.yz - k.xz * k.yy);
    const BasicSymmetric3<Number> cofactors{y_cross_z.x(),
                                            y_cross_z.y(),
                                            y_cross_z.z(),
                                            k.xx * k.zz - k.xz * k.xz,
                                            k.xy * k.xz - k.xx * k.yz,
                                            k.xx * k.yy - k.xy * k.xy};
    const Number difference = mean * mean - n.dot(cofactors * n);
    const Number half = squareRoot(where(difference > 0, difference, Number{}));
    return {inverse(k), 1 / k_nn, 1 / (mean + half)};
}

/// Stores K and what follows from it, as far as K can be inverted. @param k [1/kg, W]
template <class Contact>
[[gnu::always_inline]] inline void setInvertible(Contact& contact, const typename Contact::Symmetric& k) {
    const BasicResponse<typename Contact::Number> response = responseOf(k, contact.normal);
    contact.k = k;
    contact.k_inv = response.inverse;
    contact.normal_mass = response.normal_mass;
    contact.tangential_mass = response.tangential_mass;
}

/// Where K cannot be inverted (masses beyond what doubles can divide) the contact keeps its normal part only, and where
/// not even that exists it cannot be resolved. @pre setInvertible(contact, …)
inline void mendSingular(BasicPgsContact<double>& contact) {
    const Vec3 n = toVec3(contact.normal);
    if (isFinite(contact.k_inv) && n.dot(contact.k_inv * n) > 0 && std::isfinite(contact.tangential_mass)) return;
    const double k_nn = 1 / contact.normal_mass;
    const bool usable = std::isfinite(contact.normal_mass) && contact.normal_mass > 0;
    contact.tangential_mass = 0;
    contact.normal_mass = usable ? contact.normal_mass : 0;
    contact.k = usable ? Symmetric3::from(k_nn * n * n.transpose()) : Symmetric3{};
    contact.k_inv = Symmetric3::from(contact.normal_mass * n * n.transpose());
}

inline bool isResolvable(const BasicPgsContact<double>& contact) {
    return contact.normal_mass > 0;
}

/// ϑA − ϑB [m/s, W]. @source thesis (3.4.1), (3.4.2)
template <class Contact, class A, class B>
[[gnu::always_inline]] inline typename Contact::Vector relativeVelocity(const Contact& contact, const A& a,
                                                                        const B& b) {
    return (a.v + a.w.cross(contact.r_a)) - (b.v + b.w.cross(contact.r_b));
}

template <class Number>
[[gnu::always_inline]] inline void receive(const Triple<Number>& impulse, const Triple<Number>& r,
                                           PgsBody<Number>& body) {
    body.v += body.mass_inv * impulse;
    body.w += body.inertia_inv * r.cross(impulse);
}
template <class Number>
[[gnu::always_inline]] inline void give(const Triple<Number>& impulse, const Triple<Number>& r, PgsBody<Number>& body) {
    body.v -= body.mass_inv * impulse;
    body.w -= body.inertia_inv * r.cross(impulse);
}
template <class Number>
[[gnu::always_inline]] inline void receive(const Triple<Number>&, const Triple<Number>&, const PgsFixedBody<Number>&) {}
template <class Number>
[[gnu::always_inline]] inline void give(const Triple<Number>&, const Triple<Number>&, const PgsFixedBody<Number>&) {}

/// @param impulse on A [N·s]
template <class Contact, class A, class B>
[[gnu::always_inline]] inline void push(const Contact& contact, const typename Contact::Vector& impulse, A& a, B& b) {
    receive(impulse, contact.r_a, a);
    give(impulse, contact.r_b, b);
}

/// Whether a contact that pushes slides. @param threshold of the resolution [m/s]
inline bool slides(const BasicPgsContact<double>& contact, const LocalBody& a, const LocalBody& b, double threshold) {
    if (!(contact.normal.dot(contact.impulse) > 0)) return false;
    // What is slower than this only has not converged yet.
    const double sliding = 10 * threshold;
    const Triple1 velocity = relativeVelocity(contact, read(a), read(b));
    return (velocity - contact.normal.dot(velocity) * contact.normal).squaredNorm() > sliding * sliding;
}

/// The impulse moved into the friction cone, along the tangent. @param normal_part of the impulse wanted [N·s]
template <class Contact>
[[gnu::always_inline]] inline typename Contact::Vector ontoCone(const Contact& contact,
                                                                const typename Contact::Number& normal_part,
                                                                const typename Contact::Vector& tangential) {
    using Number = typename Contact::Number;
    const Number limit = contact.friction * normal_part;
    const Number squared = tangential.squaredNorm();
    const Number scale = where(squared > limit * limit, limit / squareRoot(squared), Number{} + 1);
    return normal_part * contact.normal + scale * tangential;
}

/// The accumulated impulse of a contact that slides: in turns the normal part gives the target velocity and the
/// tangential part is moved against the sliding velocity and put back onto the friction cone. What stays the same under
/// this is Coulomb's law: friction exactly against the sliding. The direction of the impulse that would stop the
/// sliding at once, which the law of a single impact takes, is another one wherever the normal and tangential
/// directions are coupled, and lets a sliding box feel too little friction. A contact that separates by itself gets no
/// impulse.
/// @param velocity ϑA − ϑB less the target, with the present impulse [m/s]
template <class Contact>
[[gnu::always_inline]] inline typename Contact::Vector slidingSteps(const Contact& contact,
                                                                    const typename Contact::Vector& velocity) {
    using Number = typename Contact::Number;
    using Vector = typename Contact::Vector;
    const Vector& n = contact.normal;
    Vector j = contact.impulse;
    Vector c = velocity;
    for (int round = 0; round < sliding_rounds; ++round) {
        const Number j_n = n.dot(j);
        const Number wanted = j_n - n.dot(c) * contact.normal_mass;
        const Number normal = where(wanted > 0, wanted, Number{});
        const Vector push = (normal - j_n) * n;
        c += contact.k * push;
        const Vector tangential = j - j_n * n - contact.tangential_mass * (c - n.dot(c) * n);
        const Vector next = where(normal > 0, ontoCone(contact, normal, tangential), Vector(Number{} * n));
        if (round + 1 < sliding_rounds) c += contact.k * (next - j - push);
        j = next;
    }
    return j;
}

/// The accumulated impulse along the normal that gives the contact its target velocity.
/// @param velocity as in slidingSteps()
template <class Contact>
[[gnu::always_inline]] inline typename Contact::Vector normalImpulse(const Contact& contact,
                                                                     const typename Contact::Vector& velocity) {
    using Number = typename Contact::Number;
    const Number wanted = contact.normal.dot(contact.impulse) - contact.normal.dot(velocity) * contact.normal_mass;
    return where(wanted > 0, wanted, Number{}) * contact.normal;
}

/// The accumulated impulse that gives the contact its target velocity and stops its sliding, within the friction cone.
/// @param velocity ϑA − ϑB with the present impulse [m/s]
template <class Contact>
[[gnu::always_inline]] inline typename Contact::Vector projectedImpulse(const Contact& contact,
                                                                        const typename Contact::Vector& velocity) {
    using Number = typename Contact::Number;
    using Vector = typename Contact::Vector;
    const Vector excess = velocity - contact.target * contact.normal;
    const auto frictionless = contact.friction == 0;
    if (holdsInAll(frictionless)) return normalImpulse(contact, excess);
    const Vector stick = contact.impulse - contact.k_inv * excess;
    const Number normal = contact.normal.dot(stick);
    const Number tangential = (stick - normal * contact.normal).squaredNorm();
    const Number cone = contact.friction * normal;
    const decltype(normal > 0) sticks = (cone > 0) & (tangential <= cone * cone);
    if (holdsInAll(sticks)) return stick;
    const Vector slides = where(frictionless, normalImpulse(contact, excess), slidingSteps(contact, excess));
    return where(sticks, stick, slides);
}

}  // namespace cairn
