/// @file The algorithms behind makeResolution(), one file each.
#pragma once

#include <memory>

#include "resolution/batch_resolution.h"

namespace cairn {

std::unique_ptr<BatchResolution> makeImpulseQueueResolution();  ///< in impulse_queue.cpp
std::unique_ptr<BatchResolution> makeSweepResolution();         ///< in sweep.cpp

std::unique_ptr<BatchResolution> makeSweepsOfOne();  ///< in sweeps_of_all.cpp
std::unique_ptr<Resolution> makeSweepsOfAll();       ///< in sweeps_of_all.cpp

}  // namespace cairn
