/// @file What a world takes: how many bodies, and what the members of their descriptions may be.
#pragma once

#include <cstddef>
#include <string_view>

namespace cairn {

/// Bodies faster than this are treated like non-finite ones [m/s, and rad/s]: their next position would lose all
/// precision.
inline constexpr double speed_limit = 1e9;
/// Bodies farther than this from the origin are treated like non-finite ones [m].
inline constexpr double distance_limit = 1e12;
/// Masses of bodies [kg]: energies and impulses within these limits stay far from overflow and underflow.
inline constexpr double smallest_mass = 1e-30;
inline constexpr double largest_mass = 1e30;

inline bool isUsableMass(double mass) {
    return mass >= smallest_mass && mass <= largest_mass;
}

/// Largest magnitude of a gravity factor.
inline constexpr double gravity_factor_limit = 1e3;
/// Highest rate at which velocities may decay [1/s].
inline constexpr double damping_limit = 1e6;

/// Most bodies of a world: at about 4 kB each, beyond the memory of most machines; their numbers have 32 bits.
inline constexpr std::size_t most_bodies = 100'000'000;

/// @param bodies that there are @throws InputError if there may not be one more
void requireRoom(std::size_t bodies);
/// @throws InputError beyond the limit
void requireGravityFactor(double factor);
/// @param what "linear" or "angular", for the message @throws InputError below 0 or beyond the limit
void requireDamping(double rate, std::string_view what);

}  // namespace cairn
