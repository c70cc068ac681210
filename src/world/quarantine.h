/// @file Faults and figures of a step.
#pragma once

#include "world/world_state.h"

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

/// Fixes every body whose state left the finite numbers or the limits, where it is, and notes the fault.
void quarantine(WorldState& world);

/// What contacts overlap by, the same whoever has which of them.
struct Overlaps {
    std::int64_t count = 0;  ///< of contacts that overlap
    ExactSum sum;            ///< [m]
    double largest = 0;      ///< [m]

    double mean() const { return count > 0 ? sum.rounded() / static_cast<double>(count) : 0; }
};

/// Of the contacts here.
Overlaps overlapsOf(const WorldState& world);
/// Fills in the overlaps of the contacts.
void measureOverlaps(WorldState& world);
/// Fills the statistics of the step from the stages' arrays.
void summarize(WorldState& world);

}  // namespace cairn
