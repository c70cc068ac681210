/// @file How good a simulation is, measured on nothing but the poses, by the same rules for every engine.
#pragma once

#include <vector>

#include "rigid_scene.h"

namespace cairn::bench {

/// A run as it is measured: the poses of all bodies at the end of each simulation step of 1/30 s.
using Trajectory = std::vector<std::vector<Pose>>;

/// What the poses tell. Overlaps are found by Cairn's narrow phase, whoever computed the poses.
struct Quality {
    double largest_overlap = 0;   ///< of the run [m]
    double mean_overlap = 0;      ///< mean over the frames of the mean over the overlapping contacts [m]
    double resting_largest = 0;   ///< of the last frame [m]
    double resting_mean = 0;      ///< of the last frame [m]
    double energy_gain = 0;       ///< most above the energy at the start, or at the last change of gravity [J]
    double energy_gain_part = 0;  ///< the same as a part of the scene's energy; see docs/performance.md
    std::size_t moving = 0;       ///< bodies that moved on in the last third of a second
    std::size_t lost = 0;         ///< bodies behind a fixed half-space at the end, or with no finite pose
    double highest = 0;           ///< centre of the highest body at the end, against gravity [m]
    double drift = 0;             ///< largest distance of a centre from where it began, at the end [m]
};

/// @pre the trajectory has a frame or more, each with a pose per body
/// @param time_step of the engine, which decides when gravity changes [s]
Quality measureQuality(const Scene& scene, const RigidScene& rigid, const Trajectory& trajectory, double time_step);

}  // namespace cairn::bench
