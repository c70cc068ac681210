/// @file What a joint demands of the velocities and positions of its bodies, row by row.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "joints/joint.h"
#include "joints/joint_motions.h"

namespace cairn {

/// A component that is free within bounds: ropes, limits, motors, friction and what yields (springs, servos).
struct BoundRow {
    JointRow row;
    double to_lower = 0;     ///< from the position to its lower bound [rad or m]; above 0 = beyond it
    double to_upper = 0;     ///< to its upper bound [rad or m]; below 0 = beyond it
    double lowest = 0;       ///< rate that it must at least have [rad/s or m/s]
    double highest = 0;      ///< and at most
    double strongest = 0;    ///< largest impulse, in both directions
    double softness = 0;     ///< rate by which the bounds yield per impulse
    double restitution = 0;  ///< part of the rate with which a bound throws back
    double slowest = 0;      ///< rate from which on it does [rad/s or m/s]
    double impulse = 0;      ///< what it received in this step
    bool is_motor = false;   ///< bounds the rate only, and may give energy
    bool is_linear = false;  ///< as strong as needed in both directions: solved with the rows, not after them

    /// Whether its rates are those that lead to the bounds of the position in time.
    bool isLimit() const { return strongest == Joint::infinite && softness == 0 && !is_linear; }
};

/// What a row of a coupling means for one of its bodies: rate = Σ linear·v + angular·ω.
struct RowEnd {
    BodyIndex body = UINT32_MAX;  ///< or Joint::world
    Vec3 linear = Vec3::Zero();
    Vec3 angular = Vec3::Zero();
};

/// A joint in one configuration of its bodies.
struct JointBlock {
    static constexpr std::size_t most_rows = 6;

    std::uint32_t joint = 0;  ///< its slot
    std::uint32_t group = 0;  ///< index of its group
    BodyIndex a = 0;
    BodyIndex b = Joint::world;
    double reach = 1;             ///< of the smaller one that can move, from its centre [m]: compares turns with ways
    std::uint32_t size = 0;       ///< rows whose rate must be zero
    std::uint32_t bounds = 0;     ///< bound rows: the size of bound
    std::uint32_t redundant = 0;  ///< rows that followed from others
    std::array<JointRow, most_rows> rows;
    std::array<double, most_rows> error{};  ///< what the rows' rates change; must be zero [m or rad]
    std::vector<BoundRow> bound;
    std::vector<RowEnd> ends;                  ///< of couplings: those of the only row, in place of rows[0]
    std::array<double, most_rows> impulse{};   ///< what the rows received in this step
    std::array<double, most_rows> position{};  ///< of the free axes [rad or m]
    Vec3 arm_a = Vec3::Zero();                 ///< from the centre of mass of A to its anchor [m, W]
};

/// What errors and rates of a row are a part of: the reach where it is about a length, one where about an angle.
double unitOf(const JointBlock& block, std::uint32_t row);
double unitOf(const JointBlock& block, const BoundRow& bound);

/// Poses of the bodies of a joint as they are.
inline Pose poseOf(const BodyStorage& bodies, BodyIndex i) {
    return i == Joint::world ? Pose{} : Pose{bodies.position[i], bodies.orientation[i]};
}

/// Fills rows, errors and bounds; impulses become zero. @param a, b poses of the bodies' centres of mass and principal
/// axes in W; b is the identity for the world @param time_step for the bounds of the rates: a limit is reached, not
/// passed, at the end of the step [s] @pre no coupling
void evaluate(const Joint& joint, const Pose& a, const Pose& b, double time_step, JointBlock& block);

/// The same for any joint of a world, where its bodies are. @param slot of the joint
void evaluate(std::span<const Joint> joints, std::uint32_t slot, const BodyStorage& bodies, double time_step,
              JointBlock& block);

/// Position and rate along a free axis. @pre no coupling
JointMotion motionOf(const Joint& joint, std::size_t axis, const Pose& a, const Pose& b);

/// The rate of a row. @param a, b bodies; b may be the world
double rateOf(const JointRow& row, BodyIndex a, BodyIndex b, const BodyStorage& bodies);

/// Adds what the rows of a block received to the impulses of its joint.
void reportImpulses(const JointBlock& block, const BodyStorage& bodies, Joint& joint);

/// Adds a row whose rate must be zero.
inline void add(JointBlock& block, const JointRow& row, double error) {
    block.rows[block.size] = row;
    block.error[block.size] = error;
    ++block.size;
}

}  // namespace cairn
