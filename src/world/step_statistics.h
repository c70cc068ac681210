/// @file The figures of a step.
#pragma once

#include "world/world_state.h"

namespace cairn {

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
