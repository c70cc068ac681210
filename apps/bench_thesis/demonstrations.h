/// @file The experiments of §5.6: catapults, cradles and a spinning ball.
#pragma once

#include "experiment.h"

namespace cairn::thesis {

/// Throws the load of a built-in catapult. Value: "height_m" and "distance_m" of the farthest box per simulation step,
/// "peak_m", "range_m" (how far the farthest box comes to lie from its start), "boxes", "lost".
Experiment catapult(const std::string& scene);

/// A built-in cradle, k of n balls against the others. Value: "velocity_error" (largest difference to the exact
/// outcome, that the last k balls have the velocity of the first), "momentum_error", "energy_error" (both relative).
Experiment cradle(int balls, int moving);

/// A cradle between two elastic walls, which sends the moving balls back and forth for ever. Value: "time_s" and
/// "energy_error" (relative), sampled over the run, "moving" (balls that move, in the last sample), "steps".
Experiment endlessCradle(int balls, int moving, std::int64_t time_steps);

/// How a ball spins.
enum class SpinAxis { horizontal, vertical };
/// A ball that spins in the lowest layer of a pile of balls. Value: "spin" per simulation step [rad/s], "rest_step"
/// (from which on it is asleep, or null), "lost".
Experiment spinningBall(SpinAxis axis);

}  // namespace cairn::thesis
