/// @file Contacts that resist rolling and spinning, as the accelerated sweeps visit them: an angular impulse beside the
/// usual one.
#pragma once

#include "resolution/pgs_contact.h"

namespace cairn {

/// An impulse and an angular impulse, on A.
template <class Number>
struct BasicWrench {
    Triple<Number> impulse;  ///< [N·s, W]
    Triple<Number> turning;  ///< [N·m·s, W]

    [[gnu::always_inline]] friend BasicWrench operator+(const BasicWrench& x, const BasicWrench& y) {
        return {x.impulse + y.impulse, x.turning + y.turning};
    }
    [[gnu::always_inline]] friend BasicWrench operator-(const BasicWrench& x, const BasicWrench& y) {
        return {x.impulse - y.impulse, x.turning - y.turning};
    }
    [[gnu::always_inline]] friend BasicWrench operator*(const Number& s, const BasicWrench& x) {
        return {s * x.impulse, s * x.turning};
    }
};

/// What an angular impulse at a contact changes of the velocity there: rows of a 3×3 matrix.
template <class Number>
struct BasicCoupling {
    Triple<Number> x, y, z;

    [[gnu::always_inline]] Triple<Number> operator*(const Triple<Number>& u) const {
        return {x.dot(u), y.dot(u), z.dot(u)};
    }
    /// The transposed matrix: what an impulse changes of the angular velocity.
    [[gnu::always_inline]] Triple<Number> transposed(const Triple<Number>& u) const {
        return u.x() * x + u.y() * y + u.z() * z;
    }
};

/// In world coordinates.
template <class NumberType>
struct alignas(sizeof(NumberType)) BasicRollingContact : BasicPgsContact<NumberType> {
    using Number = NumberType;
    using Vector = Triple<Number>;
    using Symmetric = BasicSymmetric3<Number>;

    Vector turning;     ///< accumulated angular impulse, on A [N·m·s]
    Number rolling{};   ///< its part across the normal is at most this times the normal impulse [m]
    Number spinning{};  ///< that along the normal likewise [m]
    Symmetric turn_k;   ///< K_t: what an angular impulse changes of the angular velocity of A against B [1/(kg·m²)]
    Symmetric inertia;  ///< K_t⁻¹ [kg·m²]
    Number spin_inertia{};    ///< 1 / (nᵀ·K_t·n) [kg·m²]
    Number roll_inertia{};    ///< 1 / largest eigenvalue of K_t's tangential part [kg·m²]
    BasicCoupling<Number> c;  ///< C: what it changes of the velocity [1/(kg·m)]
    Symmetric locked_mass;    ///< (K − C·K_t⁻¹·Cᵀ)⁻¹, of bodies that may not turn against each other [kg]
    Number squared_lever{};   ///< at most so far, squared, is the contact from the centre of mass of who turns [m²]

    using Accumulated = BasicWrench<Number>;
    [[gnu::always_inline]] Accumulated accumulated() const { return {this->impulse, turning}; }
    [[gnu::always_inline]] void add(const Accumulated& step) {
        this->impulse += step.impulse;
        turning += step.turning;
    }
};

/// Four contacts.
using WideRollingContact = BasicRollingContact<Lanes>;

/// Stores K_t and C, and what follows from them as far as they can be inverted. @pre K is known
template <class Number>
[[gnu::always_inline]] inline void setTurning(BasicRollingContact<Number>& contact,
                                              const BasicSymmetric3<Number>& turn_k, const BasicCoupling<Number>& c) {
    const BasicResponse<Number> response = responseOf(turn_k, contact.normal);
    contact.turn_k = turn_k;
    contact.inertia = response.inverse;
    contact.spin_inertia = response.normal_mass;
    contact.roll_inertia = response.tangential_mass;
    contact.c = c;
    const Triple<Number> x = response.inverse * c.x;
    const Triple<Number> y = response.inverse * c.y;
    const Triple<Number> z = response.inverse * c.z;
    const BasicSymmetric3<Number>& k = contact.k;
    contact.locked_mass = inverse(BasicSymmetric3<Number>{k.xx - c.x.dot(x), k.xy - c.x.dot(y), k.xz - c.x.dot(z),
                                                          k.yy - c.y.dot(y), k.yz - c.y.dot(z), k.zz - c.z.dot(z)});
}

/// Adds one body's part of C, −[r]×·I⁻¹.
template <class Number>
[[gnu::always_inline]] inline void addCoupling(const BasicSymmetric3<Number>& i, const Triple<Number>& r,
                                               BasicCoupling<Number>& c) {
    const Triple<Number> x(i.xx, i.xy, i.xz);
    const Triple<Number> y(i.xy, i.yy, i.yz);
    const Triple<Number> z(i.xz, i.yz, i.zz);
    c.x += r.z() * y - r.y() * z;
    c.y += r.x() * z - r.z() * x;
    c.z += r.y() * x - r.x() * y;
}

/// What the contact would need to neither close, slide, spin nor roll. @param excess velocity with the present impulses
/// less the target [m/s] @param turn angular velocity of A against B [rad/s] @return not finite where there is none
template <class Number>
[[gnu::always_inline]] inline BasicWrench<Number> rigidWrench(const BasicRollingContact<Number>& contact,
                                                              const Triple<Number>& excess,
                                                              const Triple<Number>& turn) {
    // The angular part is eliminated first.
    const Triple<Number> stop = contact.inertia * turn;
    const Triple<Number> change = contact.locked_mass * (excess - contact.c * stop);
    return {contact.impulse - change, contact.turning - stop + contact.inertia * contact.c.transposed(change)};
}

/// Holds where friction and the bounds of the torques allow a wrench.
template <class Number>
[[gnu::always_inline]] inline auto isWithin(const BasicRollingContact<Number>& contact,
                                            const BasicWrench<Number>& wrench) {
    const Number normal = contact.normal.dot(wrench.impulse);
    const Number spin = contact.normal.dot(wrench.turning);
    const Number slide = (wrench.impulse - normal * contact.normal).squaredNorm();
    const Number roll = (wrench.turning - spin * contact.normal).squaredNorm();
    const Number most_slide = contact.friction * normal;
    const Number most_spin = contact.spinning * normal;
    const Number most_roll = contact.rolling * normal;
    return (normal > 0) & (slide <= most_slide * most_slide) & (spin * spin <= most_spin * most_spin) &
           (roll <= most_roll * most_roll);
}

/// As much along the normal as may act against spinning. @pre the impulse is that which holds
template <class Number>
[[gnu::always_inline]] inline Number withinSpinning(const BasicRollingContact<Number>& contact, const Number& along) {
    const Number most = contact.spinning * contact.normal.dot(contact.impulse);
    return where(along > most, most, where(along < -most, -most, along));
}

/// As much across the normal as may act against rolling. @pre the impulse is that which holds
template <class Number>
[[gnu::always_inline]] inline Triple<Number> withinRolling(const BasicRollingContact<Number>& contact,
                                                           const Triple<Number>& across) {
    const Number most = contact.rolling * contact.normal.dot(contact.impulse);
    const Number squared = across.squaredNorm();
    return where(squared > most * most, most / squareRoot(squared), Number{} + 1) * across;
}

/// The accumulated angular impulse, or as much of it as may act. @pre the impulse is that which holds
template <class Number>
[[gnu::always_inline]] inline Triple<Number> boundedTurning(const BasicRollingContact<Number>& contact) {
    const Triple<Number>& n = contact.normal;
    const Number along = n.dot(contact.turning);
    return withinSpinning(contact, along) * n + withinRolling(contact, Triple<Number>(contact.turning - along * n));
}

/// The accumulated angular impulse against spinning and rolling, each within its bound: in turns as slidingSteps(), so
/// that what stays the same acts exactly against the motion. @param turn angular velocity of A against B [rad/s]
/// @pre the impulse is that which holds
template <class Number>
[[gnu::always_inline]] inline Triple<Number> turningSteps(const BasicRollingContact<Number>& contact,
                                                          const Triple<Number>& turn) {
    using Vector = Triple<Number>;
    const Vector& n = contact.normal;
    Vector t = contact.turning;
    Vector w = turn;
    for (int round = 0; round < sliding_rounds; ++round) {
        const Number t_n = n.dot(t);
        const Number spin = withinSpinning(contact, Number(t_n - n.dot(w) * contact.spin_inertia));
        const Vector push = (spin - t_n) * n;
        w += contact.turn_k * push;
        const Vector across = t - t_n * n - contact.roll_inertia * (w - n.dot(w) * n);
        const Vector next = spin * n + withinRolling(contact, across);
        if (round + 1 < sliding_rounds) w += contact.turn_k * (next - t - push);
        t = next;
    }
    return t;
}

}  // namespace cairn
