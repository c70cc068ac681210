/// @file Contacts and bodies in lanes: how they get there, and what impulses change.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "resolution/lane_groups.h"
#include "resolution/pgs_contact.h"
#include "resolution/rolling_contact.h"

namespace cairn {

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

/// Some numbers of a body or a contact, from one on. @param first in doubles
template <class Object>
[[gnu::always_inline]] inline Lanes rowOf(const Object& object, std::size_t first) {
    Lanes row;
    __builtin_memcpy(&row, reinterpret_cast<const char*>(&object) + first * sizeof(double), sizeof row);
    return row;
}

/// One of each lane.
template <class Object>
using OfLanes = std::array<Object*, lane_count>;

template <class Body>
[[gnu::always_inline]] inline PgsBody<Lanes> loadBodies(const OfLanes<Body>& bodies) {
    Lanes row[3][lane_count];
    for (std::size_t part = 0; part < 3; ++part) {
        for (std::size_t lane = 0; lane < lane_count; ++lane) row[part][lane] = rowOf(*bodies[lane], 4 * part);
        transpose(row[part][0], row[part][1], row[part][2], row[part][3]);
    }
    const Lanes mass_inv{bodies[0]->mass_inv, bodies[1]->mass_inv, bodies[2]->mass_inv, bodies[3]->mass_inv};
    return {{row[0][0], row[0][1], row[0][2]},
            {row[0][3], row[1][0], row[1][1]},
            mass_inv,
            {row[1][2], row[1][3], row[2][0], row[2][1], row[2][2], row[2][3]}};
}

[[gnu::always_inline]] inline PgsBody<Lanes> load(const std::vector<LocalBody>& bodies, const BodyIndices& i) {
    return loadBodies(OfLanes<const LocalBody>{&bodies[i[0]], &bodies[i[1]], &bodies[i[2]], &bodies[i[3]]});
}

/// Writes the velocities of a body to each lane for which is(lane).
template <class Is>
[[gnu::always_inline]] inline void store(const PgsBody<Lanes>& body, const OfLanes<LocalBody>& bodies, const Is& is) {
    Lanes row[lane_count] = {body.v.x(), body.v.y(), body.v.z(), body.w.x()};
    transpose(row[0], row[1], row[2], row[3]);
    const Lanes even = __builtin_shufflevector(body.w.y(), body.w.z(), 0, 4, 2, 6);
    const Lanes odd = __builtin_shufflevector(body.w.y(), body.w.z(), 1, 5, 3, 7);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        if (!is(lane)) continue;
        char* const to = reinterpret_cast<char*>(bodies[lane]);
        const double rest[] = {lane % 2 == 0 ? even[lane] : odd[lane - 1], lane % 2 == 0 ? even[lane + 1] : odd[lane]};
        __builtin_memcpy(to, &row[lane], sizeof(Lanes));
        __builtin_memcpy(to + sizeof(Lanes), rest, sizeof rest);
    }
}

/// Only to lanes with the bit: others may stand for a body that another thread is at work on.
[[gnu::always_inline]] inline void store(const PgsBody<Lanes>& body, const BodyIndices& i,
                                         const std::array<std::uint8_t, lane_count>& moves, int bit,
                                         std::vector<LocalBody>& bodies) {
    const OfLanes<LocalBody> to{&bodies[i[0]], &bodies[i[1]], &bodies[i[2]], &bodies[i[3]]};
    store(
        body, to, [&](std::size_t lane) __attribute__((always_inline)) { return (moves[lane] & bit) != 0; });
}

// Likewise all of a contact, of which the impulse is the first.
constexpr std::size_t contact_rows = 7;
static_assert(offsetof(BasicPgsContact<double>, impulse) == 0 &&
              sizeof(BasicPgsContact<double>) == contact_rows * sizeof(Lanes) &&
              sizeof(BasicPgsContact<Lanes>) == contact_rows * sizeof(Lanes) * lane_count);

/// The contact of each lane.
[[gnu::always_inline]] inline BasicPgsContact<Lanes> loadContacts(const OfLanes<BasicPgsContact<double>>& contacts) {
    Lanes row[contact_rows][lane_count];
    for (std::size_t part = 0; part < contact_rows; ++part) {
        for (std::size_t lane = 0; lane < lane_count; ++lane) row[part][lane] = rowOf(*contacts[lane], 4 * part);
        transpose(row[part][0], row[part][1], row[part][2], row[part][3]);
    }
    BasicPgsContact<Lanes> wide;
    __builtin_memcpy(static_cast<void*>(&wide), row, sizeof wide);
    return wide;
}

/// Writes all of each lane but of those that have none (null).
[[gnu::always_inline]] inline void storeContacts(const BasicPgsContact<Lanes>& wide,
                                                 const OfLanes<BasicPgsContact<double>>& contacts) {
    Lanes row[contact_rows][lane_count];
    __builtin_memcpy(row, &wide, sizeof wide);
    for (std::size_t part = 0; part < contact_rows; ++part) {
        transpose(row[part][0], row[part][1], row[part][2], row[part][3]);
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
            if (contacts[lane] == nullptr) continue;
            char* const to = reinterpret_cast<char*>(contacts[lane]) + part * sizeof(Lanes);
            __builtin_memcpy(to, &row[part][lane], sizeof(Lanes));
        }
    }
}

/// Writes the impulse of each lane.
[[gnu::always_inline]] inline void storeImpulse(const BasicPgsContact<Lanes>& wide,
                                                const OfLanes<BasicPgsContact<double>>& contacts) {
    // With the number behind it, which stays.
    Lanes row[lane_count] = {wide.impulse.x(), wide.impulse.y(), wide.impulse.z(), wide.normal.x()};
    transpose(row[0], row[1], row[2], row[3]);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        __builtin_memcpy(static_cast<void*>(contacts[lane]), &row[lane], sizeof(Lanes));
    }
}

/// What a difference of impulses changes.
template <class Number>
struct BasicChange {
    Number squared;        ///< weighted by the normal part of K; not finite where there is none
    Number squared_speed;  ///< of the velocity there
};
template <class Number>
[[gnu::always_inline]] inline BasicChange<Number> changeBy(const BasicPgsContact<Number>& contact,
                                                           const Triple<Number>& difference) {
    return {difference.squaredNorm() / contact.normal_mass, (contact.k * difference).squaredNorm()};
}
template <class Number>
[[gnu::always_inline]] inline BasicChange<Number> changeBy(const BasicRollingContact<Number>& contact,
                                                           const BasicWrench<Number>& difference) {
    const BasicPgsContact<Number>& plain = contact;
    const BasicChange<Number> by_impulse = changeBy(plain, difference.impulse);
    const Number squared = difference.turning.squaredNorm() / contact.spin_inertia;
    const Number speed = contact.squared_lever * (contact.turn_k * difference.turning).squaredNorm();
    const auto turns = contact.spin_inertia > 0;
    return {by_impulse.squared + where(turns, squared, Number{}),
            where(speed > by_impulse.squared_speed, speed, by_impulse.squared_speed)};
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
