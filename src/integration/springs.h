/// @file Damped springs between two points.
#pragma once

#include <cstdint>
#include <vector>

#include "body/body_storage.h"
#include "cairn/types.h"

namespace cairn {

/// One spring; slots are kept and reused like those of bodies.
struct Spring {
    static constexpr BodyIndex world_point = UINT32_MAX;

    bool present = false;
    std::uint32_t generation = 0;
    BodyIndex a = 0;
    BodyIndex b = world_point;     ///< world_point = anchor_b is a point of W
    Vec3 anchor_a = Vec3::Zero();  ///< [m, frame of A]
    Vec3 anchor_b = Vec3::Zero();  ///< [m, frame of B or W]
    double stiffness = 0;          ///< [N/m]
    double damping = 0;            ///< [N·s/m]
    double rest_length = 0;        ///< [m]
};

/// Adds to the velocities what the springs give in one step, in ascending order of slots. Each spring is integrated
/// implicitly along its own line, so that stiff springs on light bodies do not gain energy.
/// @param time_step [s]
void applySprings(const std::vector<Spring>& springs, BodyStorage& bodies, double time_step);

/// Wakes the sleeping end of every spring whose other end is awake: its force on it changes.
void wakeSpringEnds(const std::vector<Spring>& springs, BodyStorage& bodies);

}  // namespace cairn
