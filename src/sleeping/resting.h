/// @file Bodies that have come to rest while they are awake: the resolution holds them still, like sleeping ones, until
/// something happens to them. Sleep needs a motion that was small for long, and can be switched off; rest needs two
/// steps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_storage.h"
#include "parallel/executor.h"

namespace cairn {

/// Finds the bodies that may come to rest in this step: those slower than rest_speed [m/s] at its beginning, without
/// constant forces, which could be too weak to show in a step. @param slow [slots] out, 1 = may
void noteSlow(const BodyStorage& bodies, double rest_speed, const Executor& executor, std::vector<std::uint8_t>& slow);

/// Stops and lets rest those of them that are still slower than rest_speed and that something supports: forces that
/// cancel each other up to 2·rest_speed per step. @pre after the resolution
void letRest(BodyStorage& bodies, double rest_speed, std::span<const std::uint8_t> slow, const Executor& executor);

}  // namespace cairn
