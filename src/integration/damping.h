/// @file Velocities that decay by themselves.
#pragma once

#include "body/body_storage.h"
#include "parallel/executor.h"

namespace cairn {

/// Lets the velocities of awake dynamic bodies decay by their dampings: v(t) = v·exp(−c·t), so that no rate is too high
/// for a time step. @param time_step [s]
void dampVelocities(BodyStorage& bodies, double time_step, const Executor& executor);

}  // namespace cairn
