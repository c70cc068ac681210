/// @file Rays into a pile, answered by Cairn and by Bullet: time per ray, and where the hits differ.
#pragma once

#include "common.h"

namespace cairn::bench {

/// What is asked.
struct RaysOptions {
    std::string scene = "heap:10000";  ///< of balls, boxes, capsules and half-spaces
    double seconds = 3;                ///< of the scene that are simulated before the rays are cast, ≥ 0
    std::size_t rays = 100'000;        ///< from above, in all directions into the pile
    std::size_t repetitions = 5;       ///< of each engine, in turns
    Extent extent = Extent::full;
    Progress progress;
};

/// @throws InputError, also if this program was built without Bullet; Interrupted
Outcome runRays(const RaysOptions& options);

}  // namespace cairn::bench
