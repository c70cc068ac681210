/// @file The algorithms behind makeResolution(), one file each.
#pragma once

#include <memory>

#include "resolution/resolution.h"

namespace cairn {

std::unique_ptr<Resolution> makeImpulseQueueResolution();  ///< in impulse_queue.cpp
std::unique_ptr<Resolution> makeSweepResolution();         ///< in sweep.cpp

std::unique_ptr<Resolution> makeAcceleratedSweepsResolution();  ///< in accelerated_sweeps.cpp

}  // namespace cairn
