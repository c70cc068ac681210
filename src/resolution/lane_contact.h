/// @file Contacts and bodies in lanes: how they get there, and what a visit does to them.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "resolution/pgs_contact.h"

namespace cairn {

template <std::size_t lanes>
using BodyIndices = std::array<std::uint32_t, lanes>;

// What visits need of a body stands side by side, so that it can be read and written as vectors.
static_assert(offsetof(LocalBody, v) == 0 && offsetof(LocalBody, w) == 3 * sizeof(double) &&
              offsetof(LocalBody, inertia_inv) == 6 * sizeof(double) && sizeof(Symmetric3) == 6 * sizeof(double));

/// Makes columns of rows.
[[gnu::always_inline]] inline void transpose(Lanes& r0, Lanes& r1, Lanes& r2, Lanes& r3) {
    const Lanes even_01 = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);
    const Lanes odd_01 = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);
    const Lanes even_23 = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
    const Lanes odd_23 = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
    r0 = __builtin_shufflevector(even_01, even_23, 0, 1, 4, 5);
    r1 = __builtin_shufflevector(odd_01, odd_23, 0, 1, 4, 5);
    r2 = __builtin_shufflevector(even_01, even_23, 2, 3, 6, 7);
    r3 = __builtin_shufflevector(odd_01, odd_23, 2, 3, 6, 7);
}

/// Some numbers of a body, from one on. @param first in doubles
[[gnu::always_inline]] inline Lanes rowOf(const LocalBody& body, std::size_t first) {
    Lanes row;
    __builtin_memcpy(&row, reinterpret_cast<const char*>(&body) + first * sizeof(double), sizeof row);
    return row;
}

/// @tparam Number of the lanes, one index each
template <class Number>
[[gnu::always_inline]] inline PgsBody<Number> load(const std::vector<LocalBody>& bodies,
                                                   const BodyIndices<lanes_in<Number>>& i);

template <>
[[gnu::always_inline]] inline PgsBody<double> load<double>(const std::vector<LocalBody>& bodies,
                                                           const BodyIndices<1>& i) {
    return read(bodies[i[0]]);
}

template <>
[[gnu::always_inline]] inline PgsBody<Lanes> load<Lanes>(const std::vector<LocalBody>& bodies,
                                                         const BodyIndices<lane_count>& i) {
    Lanes row[3][lane_count];
    for (std::size_t part = 0; part < 3; ++part) {
        for (std::size_t lane = 0; lane < lane_count; ++lane) row[part][lane] = rowOf(bodies[i[lane]], 4 * part);
        transpose(row[part][0], row[part][1], row[part][2], row[part][3]);
    }
    const Lanes mass_inv{bodies[i[0]].mass_inv, bodies[i[1]].mass_inv, bodies[i[2]].mass_inv, bodies[i[3]].mass_inv};
    return {{row[0][0], row[0][1], row[0][2]},
            {row[0][3], row[1][0], row[1][1]},
            mass_inv,
            {row[1][2], row[1][3], row[2][0], row[2][1], row[2][2], row[2][3]}};
}

// Bodies are stored only in lanes with the bit: others may stand for one that another thread is at work on.

[[gnu::always_inline]] inline void store(const PgsBody<double>& body, const BodyIndices<1>& i,
                                         const std::array<std::uint8_t, 1>& moves, int bit,
                                         std::vector<LocalBody>& bodies) {
    if ((moves[0] & bit) != 0) write(body, bodies[i[0]]);
}

[[gnu::always_inline]] inline void store(const PgsBody<Lanes>& body, const BodyIndices<lane_count>& i,
                                         const std::array<std::uint8_t, lane_count>& moves, int bit,
                                         std::vector<LocalBody>& bodies) {
    Lanes row[lane_count] = {body.v.x(), body.v.y(), body.v.z(), body.w.x()};
    transpose(row[0], row[1], row[2], row[3]);
    const Lanes even = __builtin_shufflevector(body.w.y(), body.w.z(), 0, 4, 2, 6);
    const Lanes odd = __builtin_shufflevector(body.w.y(), body.w.z(), 1, 5, 3, 7);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        if ((moves[lane] & bit) == 0) continue;
        char* const to = reinterpret_cast<char*>(&bodies[i[lane]]);
        const double rest[] = {lane % 2 == 0 ? even[lane] : odd[lane - 1], lane % 2 == 0 ? even[lane + 1] : odd[lane]};
        __builtin_memcpy(to, &row[lane], sizeof(Lanes));
        __builtin_memcpy(to + sizeof(Lanes), rest, sizeof rest);
    }
}

template <class Number>
[[gnu::always_inline]] inline void visit(BasicPgsContact<Number>& contact, PgsBody<Number>& a, PgsBody<Number>& b) {
    const Triple<Number> impulse = projectedImpulse(contact, relativeVelocity(contact, a, b));
    // False for velocities that are not finite: they would spread.
    const auto usable = (impulse.squaredNorm() < std::numeric_limits<double>::infinity()) & (contact.normal_mass > 0);
    const Triple<Number> next = where(usable, impulse, contact.impulse);
    push(contact, next - contact.impulse, a, b);
    contact.impulse = next;
}

/// Whether setInvertible() was able to invert K, in all lanes.
template <class Number>
[[gnu::always_inline]] inline bool isRegular(const BasicPgsContact<Number>& contact) {
    const auto& k = contact.k_inv;
    const Number sum = k.xx + k.xy + k.xz + k.yy + k.yz + k.zz + contact.tangential_mass;
    const Number normal_part = contact.normal.dot(k * contact.normal);
    return holdsInAll((sum - sum == 0) & (normal_part > 0));
}

template <class Number>
void setLane(BasicSymmetric3<Number>& m, std::size_t lane, const Symmetric3& value) {
    setLane(m.xx, lane, value.xx);
    setLane(m.xy, lane, value.xy);
    setLane(m.xz, lane, value.xz);
    setLane(m.yy, lane, value.yy);
    setLane(m.yz, lane, value.yz);
    setLane(m.zz, lane, value.zz);
}

template <class Number>
Symmetric3 laneOf(const BasicSymmetric3<Number>& m, std::size_t lane) {
    return {laneOf(m.xx, lane), laneOf(m.xy, lane), laneOf(m.xz, lane),
            laneOf(m.yy, lane), laneOf(m.yz, lane), laneOf(m.zz, lane)};
}

template <class Number>
PgsContact laneOf(const BasicPgsContact<Number>& wide, std::size_t lane) {
    PgsContact contact;
    contact.impulse = Triple1(laneOf(wide.impulse, lane));
    contact.normal = Triple1(laneOf(wide.normal, lane));
    contact.r_a = Triple1(laneOf(wide.r_a, lane));
    contact.r_b = Triple1(laneOf(wide.r_b, lane));
    contact.k_inv = laneOf(wide.k_inv, lane);
    contact.target = laneOf(wide.target, lane);
    contact.friction = laneOf(wide.friction, lane);
    contact.k = laneOf(wide.k, lane);
    contact.normal_mass = laneOf(wide.normal_mass, lane);
    contact.tangential_mass = laneOf(wide.tangential_mass, lane);
    return contact;
}

/// What follows from K alone.
template <class Number>
void setMasses(BasicPgsContact<Number>& wide, std::size_t lane, const PgsContact& contact) {
    setLane(wide.k_inv, lane, contact.k_inv);
    setLane(wide.k, lane, contact.k);
    setLane(wide.normal_mass, lane, contact.normal_mass);
    setLane(wide.tangential_mass, lane, contact.tangential_mass);
}

}  // namespace cairn
