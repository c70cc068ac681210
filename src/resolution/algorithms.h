/// @file The algorithms behind makeResolution(), one file each.
#pragma once

#include <cstddef>
#include <memory>

#include "resolution/batch_resolution.h"

namespace cairn {

/// The constants of the thesis's algorithm; only tests take others.
struct QueueConstants {
    /// Limit for each stage of the shock propagation as a multiple of its contacts; 0 = none. @source thesis §5.1
    double shock_iterations = 6;
    /// Batches with more contacts use the TournamentQueue; its file says why. @source thesis §3.8
    std::size_t queue_switch = 64;
};

std::unique_ptr<BatchResolution> makeImpulseQueueResolution(
    const QueueConstants& constants = {});               ///< impulse_queue.cpp
std::unique_ptr<BatchResolution> makeSweepResolution();  ///< in sweep.cpp

std::unique_ptr<BatchResolution> makeSweepsOfOne();  ///< in sweeps_of_all.cpp
std::unique_ptr<Resolution> makeSweepsOfAll();       ///< in sweeps_of_all.cpp

}  // namespace cairn
