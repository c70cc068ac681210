/// @file When two moving shapes would overlap.
#pragma once

#include <optional>

#include "narrow_phase/narrow_phase.h"

namespace cairn {

/// A shape that moves and turns uniformly.
struct MovingShape {
    const Shape& shape;
    Pose pose;              ///< of its frame at the beginning [m, W]
    Vec3 centre;            ///< about which it turns, at the beginning [m, W]
    Vec3 v = Vec3::Zero();  ///< of the centre [m/s, W]
    Vec3 w = Vec3::Zero();  ///< [rad/s, W]
    double turning = 0;     ///< largest speed of a surface point about the centre that changes where the shape is [m/s]

    Pose poseAfter(double time) const;
};

/// How deep two shapes are in each other [m]; 0 = not at all.
double overlapDepth(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);

/// As a multiple of the depth that two shapes have now: one that timeOfOverlap() does not take for reached.
inline constexpr double clearly_deeper = 1.02;

/// When two shapes, if nothing stopped them, would first overlap by more than a depth within a time step [s]; none if
/// they would not. Conservative advancement: no time is passed over in which they could. Where both are convex solids,
/// the farther of two bounds counts. What is not decided after a number of rounds, since they graze each other, is
/// looked at from there on in steps in which no point of one passes the other by more than the inner radius of the
/// smaller shape, but for a number of steps at most.
/// @param time of the step [s] @param depth [m], ≥ 0
/// @source Mirtich: Impulse-based dynamic simulation of rigid body systems, Berkeley 1996, §2.3
std::optional<double> timeOfOverlap(const MovingShape& a, const MovingShape& b, double time, double depth);

}  // namespace cairn
