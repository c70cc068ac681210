/// @file Joints: what holds two bodies together, or a body and the world. Everything is given in W as it is when the
/// joint is added, which is where its position (angle or displacement) is zero.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "cairn/types.h"

namespace cairn {

/// What a joint keeps.
enum class JointKind : std::uint8_t {
    distance,  ///< the distance of two points: a rod without mass; leaves five ways to move
    rope,      ///< that distance at most
    ball,      ///< two points on each other; leaves the rotation
    hinge,     ///< two points on each other and two axes on each other; leaves one angle
    slider,    ///< the orientation and all but the displacement along an axis
    fixed,     ///< everything
};

/// Drives a hinge or a slider at a speed, as far as its force reaches.
struct JointMotor {
    double speed = 0;  ///< of A relative to B about or along the axis [rad/s or m/s]
    double limit = 0;  ///< largest torque or force [N·m or N], ≥ 0; with speed 0 it is a brake
};

/// How a joint begins.
struct JointDescription {
    JointKind kind = JointKind::ball;  ///< what it keeps
    BodyId a{};                        ///< first body
    std::optional<BodyId> b{};         ///< second body; none = the world itself
    Vec3 anchor = Vec3::Zero();        ///< where they are joined, of distances and ropes the point of A [m, W]
    std::optional<Vec3> anchor_b{};    ///< of distances and ropes, which need it: the point of B or of the world [m, W]
    Vec3 axis = Vec3::UnitZ();         ///< of hinges and sliders, of any length above 0 [W]
    std::optional<double> length{};    ///< of distances and ropes [m], > 0; otherwise the distance at the beginning
    std::optional<double> lower{};     ///< of hinges [rad, −π to π] and sliders [m]: least position
    std::optional<double> upper{};     ///< of hinges [rad, −π to π] and sliders [m]: greatest position, ≥ lower
    std::optional<JointMotor> motor{};  ///< of hinges and sliders
    double break_force = infinite;      ///< mean over a time step above which the joint breaks [N], > 0
    double break_torque = infinite;     ///< of hinges, sliders and fixed joints: the same [N·m], > 0
    bool collide = false;               ///< whether the two bodies may touch each other

    /// For what never breaks.
    static constexpr double infinite = std::numeric_limits<double>::infinity();
};

/// A joint as it was after the last step.
struct JointInfo {
    JointKind kind;           ///< what it keeps
    BodyId a;                 ///< first body
    std::optional<BodyId> b;  ///< second body; none = the world
    Vec3 anchor_a;            ///< the point of A [m, W]
    Vec3 anchor_b;            ///< the point of B or of the world [m, W]
    Vec3 axis;                ///< of hinges and sliders, that of B: unit, W
    double position;          ///< angle of hinges [rad], displacement of sliders, length of distances and ropes [m]
    double speed;             ///< its rate [rad/s or m/s]
    double error;             ///< how far the joint is from what it keeps [m or rad]: the largest component
    Vec3 impulse;             ///< that A received at its point in the step [N·s, W]; B received the opposite
    Vec3 angular_impulse;     ///< that A received besides [N·m·s, W]; B received the opposite
    Vec3 force;               ///< the impulse divided by the time step [N, W]
    Vec3 torque;              ///< the angular impulse divided by the time step [N·m, W]
};

}  // namespace cairn
