/// @file Joints: what holds two bodies together, or a body and the world. Everything is given in W as it is when the
/// joint is added, which is where its positions (angles or displacements) are zero.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "cairn/types.h"

namespace cairn {

/// What a joint keeps.
enum class JointKind : std::uint8_t {
    distance,     ///< the distance of two points: a rod without mass; leaves five ways to move
    rope,         ///< that distance at most
    ball,         ///< two points on each other; leaves the rotation
    hinge,        ///< two points on each other and two axes on each other; leaves one angle
    slider,       ///< the orientation and all but the displacement along an axis
    fixed,        ///< everything
    universal,    ///< two points on each other, and an axis of each body at right angles; leaves the angles about both
    planar,       ///< a plane; leaves the two displacements in it and the angle about its normal
    cylindrical,  ///< two axes on each other; leaves the displacement along them and the angle about them
    screw,        ///< the same with the displacement in proportion to the angle; leaves the angle
    generic,      ///< everything but the axes that are named
    gear,         ///< the angle of a second joint in proportion to that of a first
    rack,         ///< the displacement of a second joint in proportion to the angle of a first
    mimic,        ///< any position of a second joint as a linear law of one of a first
};

/// One of the six ways in which A can move relative to B, along and about the axes of the joint's frame: x is along
/// `axis`, y along what `axis_2` has across it.
enum class JointAlong : std::uint8_t { x, y, z, turn_x, turn_y, turn_z };

/// Drives a free axis at a speed, as far as its force reaches.
struct JointMotor {
    double speed = 0;  ///< of A relative to B about or along the axis [rad/s or m/s]
    double limit = 0;  ///< largest torque or force [N·m or N], ≥ 0; with speed 0 it is a brake
};

/// Drives a free axis to a position, at a speed, or both, by the force stiffness·(position − x) + damping·(speed − ẋ)
/// with x and ẋ as they are at the end of the step: stable whatever the gains are.
struct JointServo {
    double position = 0;      ///< wanted [rad or m]
    double speed = 0;         ///< wanted [rad/s or m/s]
    double stiffness = 0;     ///< gain of the position [N·m/rad or N/m], 0 to 1e30; 0 = it drives a speed only
    double damping = 0;       ///< gain of the speed [N·m·s/rad or N·s/m], 0 to 1e30
    double limit = no_limit;  ///< largest torque or force [N·m or N], ≥ 0

    /// For servos of any strength.
    static constexpr double no_limit = std::numeric_limits<double>::infinity();
};

/// Pulls a free axis to a position, by the force at the end of the step: stable whatever the stiffness is. Where the
/// step is not short against its period it takes energy from an oscillation.
struct JointSpring {
    double stiffness = 0;  ///< [N·m/rad or N/m], 0 to 1e30
    double rest = 0;       ///< position without force [rad or m]
};

/// What acts along or about one free axis of a joint.
struct JointAxis {
    JointAlong along = JointAlong::x;     ///< of generic joints: which axis is free
    std::optional<double> lower{};        ///< least position [rad or m]
    std::optional<double> upper{};        ///< greatest position [rad or m], ≥ lower
    double restitution = 0;               ///< part of the speed with which a limit throws back, 0 to 1
    std::optional<JointMotor> motor{};    ///< drives at a speed; an axis has a motor or a servo
    std::optional<JointServo> servo{};    ///< drives to a position or at a speed
    std::optional<JointSpring> spring{};  ///< pulls to a position
    double damping = 0;                   ///< force per speed [N·m·s/rad or N·s/m], 0 to 1e30
    double friction = 0;                  ///< largest torque or force of dry friction [N·m or N], ≥ 0
    double rotor_inertia = 0;             ///< of what turns with the axis, behind its gear [kg·m² or kg], 0 to 1e30
};

/// How a joint begins. What hinges, sliders and screws have along their one free axis may be given by the members that
/// are called as in JointAxis; joints with several free axes have them in `axes`.
struct JointDescription {
    JointKind kind = JointKind::ball;  ///< what it keeps
    BodyId a{};                        ///< first body
    std::optional<BodyId> b{};         ///< second body; none = the world itself
    Vec3 anchor = Vec3::Zero();        ///< where they are joined, of distances and ropes the point of A [m, W]
    std::optional<Vec3> anchor_b{};    ///< of distances and ropes, which need it: the point of B or of the world [m, W]
    Vec3 axis = Vec3::UnitZ();         ///< of any length above 0 [W]: of planar joints the normal; see JointAlong
    std::optional<Vec3> axis_2{};      ///< of universal, planar, generic and ball joints: not along axis [W]
    std::optional<double> length{};    ///< of distances and ropes [m], > 0; otherwise the distance at the beginning
    std::optional<double> lead{};      ///< of screws, which need it: displacement per turn [m]
    std::optional<double> lower{};     ///< of hinges and screws [rad] and sliders [m]: least position
    std::optional<double> upper{};     ///< of hinges and screws [rad] and sliders [m]: greatest position, ≥ lower
    double restitution = 0;            ///< as JointAxis::restitution
    std::optional<JointMotor> motor{};    ///< of hinges, screws and sliders
    std::optional<JointServo> servo{};    ///< of hinges, screws and sliders; in place of a motor
    std::optional<JointSpring> spring{};  ///< of hinges, screws and sliders
    double damping = 0;                   ///< as JointAxis::damping
    double friction = 0;                  ///< as JointAxis::friction
    double rotor_inertia = 0;             ///< as JointAxis::rotor_inertia
    std::optional<double> cone{};         ///< of balls: largest angle between the axes of A and B [rad], 0 to π
    /// Of cylindrical (x, turn_x), planar (y, z, turn_x), universal (turn_x of B, turn_y of A) and ball joints (turn_x,
    /// turn_y, turn_z: the rotation vector): what acts along their free axes in this order, or none. Of generic joints:
    /// the free axes.
    std::vector<JointAxis> axes{};
    /// Mean over a time step above which the joint breaks [N], > 0; of racks and mimics: along a displacement of the
    /// second joint.
    double break_force = infinite;
    /// Of joints that pass torque: the same [N·m], > 0; of gears and mimics: about an angle of the second joint.
    double break_torque = infinite;
    bool collide = false;         ///< whether the two bodies may touch each other
    JointId first{};              ///< of gears, racks and mimics, which have no bodies of their own: a joint
    JointId second{};             ///< and the joint that follows it; both go on as they are
    std::size_t first_axis = 0;   ///< which free axis of the first
    std::size_t second_axis = 0;  ///< and of the second
    /// Of gears: turns of the second per turn of the first, in the opposite sense (negative: the same sense); of racks:
    /// displacement per angle [m/rad], the pinion's radius; of mimics: position of the second per that of the first.
    double ratio = 1;

    /// For what never breaks.
    static constexpr double infinite = std::numeric_limits<double>::infinity();
};

/// A joint as it was after the last step.
struct JointInfo {
    JointKind kind;           ///< what it keeps
    BodyId a;                 ///< first body; of gears, racks and mimics that of the first joint
    std::optional<BodyId> b;  ///< second body, none = the world; of gears, racks and mimics the second joint's first
    Vec3 anchor_a;            ///< the point of A [m, W]
    Vec3 anchor_b;            ///< the point of B or of the world [m, W]
    Vec3 axis;                ///< that of B: unit, W
    double position;          ///< of the first free axis; of distances and ropes their length [rad or m]
    double speed;             ///< its rate [rad/s or m/s]
    double error;             ///< how far the joint is from what it keeps [m or rad]: the largest component
    Vec3 impulse;             ///< that A received at its point in the step [N·s, W]; B received the opposite
    Vec3 angular_impulse;     ///< that A received besides [N·m·s, W]; B received the opposite
    Vec3 force;               ///< the impulse divided by the time step [N, W]
    Vec3 torque;              ///< the angular impulse divided by the time step [N·m, W]
    std::vector<double> positions;  ///< of the free axes [rad or m]; angles count on over turns
    std::vector<double> speeds;     ///< their rates [rad/s or m/s]
    std::size_t redundant;  ///< how many of its conditions followed from those of others in the last step: closed loops
};

}  // namespace cairn
