/// @file How many time steps a second has, by the sizes of the bodies.
#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include "cairn/shape.h"
#include "world/world_state.h"

namespace cairn {

/// The middle one of the three extents that a shape has along the axes of its frame [m].
double middleExtent(const Shape& shape);

/// The power of two that the number of time steps for bodies of 0.12 m under 10 m/s² is multiplied by, by the median of
/// the extents of bodies that come one after the other.
class StepExponents {
  public:
    /// @param gravity magnitude [m/s²]; 0 counts as 10
    explicit StepExponents(double gravity) : gravity_(gravity) {}
    /// @param extent of a body that moves [m]
    void add(double extent);
    /// Of evenly many the smaller one in the middle counts. @return none before the first body
    std::optional<int> median() const;

  private:
    double gravity_;
    std::map<int, std::size_t> counts_;  ///< of bodies, by what each asks for
    std::size_t count_ = 0;
};

/// Settings with a number of time steps that is known; the speed thresholds stay the same multiples of what a body
/// falls within one. Settings whose number does not follow the sizes stay as they are.
Settings withKnownSteps(const Settings& settings, int exponent);

/// Asks the bodies that move how many time steps they need, if there are any. @pre all bodies are here
std::optional<int> stepExponentOf(const WorldState& world);

/// Makes the number of time steps known when the world takes its first step with bodies that move.
void settleSteps(WorldState& world);

}  // namespace cairn
