/// @file What the members of a body's description may be.
#pragma once

#include <string_view>

namespace cairn {

/// Largest magnitude of a gravity factor.
inline constexpr double gravity_factor_limit = 1e3;
/// Highest rate at which velocities may decay [1/s].
inline constexpr double damping_limit = 1e6;

/// @throws InputError beyond the limit
void requireGravityFactor(double factor);
/// @param what "linear" or "angular", for the message @throws InputError below 0 or beyond the limit
void requireDamping(double rate, std::string_view what);

}  // namespace cairn
