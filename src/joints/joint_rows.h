/// @file What a joint demands of the velocities and positions of its bodies, row by row.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "joints/joint.h"

namespace cairn {

/// One component of the relative motion of A and B: rate = linear·(vA − vB) + angular_a·ωA + angular_b·ωB. An impulse λ
/// along it gives A linear·λ and angular_a·λ, and B −linear·λ and angular_b·λ.
struct JointRow {
    Vec3 linear = Vec3::Zero();
    Vec3 angular_a = Vec3::Zero();  ///< about the centre of mass of A
    Vec3 angular_b = Vec3::Zero();  ///< about the centre of mass of B
};

/// A component that is free within bounds: ropes, limits and motors.
struct BoundRow {
    JointRow row;
    double to_lower = 0;    ///< from the position to its lower bound [rad or m]; above 0 = beyond it
    double to_upper = 0;    ///< to its upper bound [rad or m]; below 0 = beyond it
    double lowest = 0;      ///< rate that it must at least have [rad/s or m/s]
    double highest = 0;     ///< and at most
    double strongest = 0;   ///< largest impulse, in both directions
    double impulse = 0;     ///< what it received in this step
    bool is_motor = false;  ///< bounds the rate only
};

/// A joint in one configuration of its bodies.
struct JointBlock {
    static constexpr std::size_t most_rows = 6;

    std::uint32_t joint = 0;  ///< its slot
    std::uint32_t group = 0;  ///< index of its group
    BodyIndex a = 0;
    BodyIndex b = Joint::world;
    std::uint32_t size = 0;    ///< rows whose rate must be zero
    std::uint32_t bounds = 0;  ///< bound rows
    std::array<JointRow, most_rows> rows;
    std::array<double, most_rows> error{};  ///< what the rows' rates change; must be zero [m or rad]
    std::array<BoundRow, 2> bound;
    std::array<double, most_rows> impulse{};  ///< what the rows received in this step
    Vec3 arm_a = Vec3::Zero();                ///< from the centre of mass of A to its anchor [m, W]
};

/// Position and rate of the free component of a joint.
struct JointMotion {
    double position;  ///< [rad or m]
    JointRow row;     ///< whose rate changes it
};

/// @param a, b poses of the bodies' centres of mass and principal axes in W; b is the identity for the world
JointMotion motionOf(const Joint& joint, const Pose& a, const Pose& b);

/// Fills rows, errors and bounds; impulses become zero. @param time_step for the bounds of the rates: a limit is
/// reached, not passed, at the end of the step [s]
void evaluate(const Joint& joint, const Pose& a, const Pose& b, double time_step, JointBlock& block);

/// Poses of the bodies of a joint as they are.
inline Pose poseOf(const BodyStorage& bodies, BodyIndex i) {
    return i == Joint::world ? Pose{} : Pose{bodies.position[i], bodies.orientation[i]};
}

/// Adds what the rows of a block received to the impulses of its joint.
void reportImpulses(const JointBlock& block, Joint& joint);

}  // namespace cairn
