/// @file A joint as the world keeps it.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "body/body_storage.h"
#include "cairn/joint.h"

namespace cairn {

/// One free axis of a joint, with what acts along it.
struct FreeAxis {
    static constexpr double infinite = std::numeric_limits<double>::infinity();

    JointAlong along = JointAlong::x;
    double lower = -infinite;       ///< least position [rad or m]
    double upper = infinite;        ///< greatest position [rad or m]
    double restitution = 0;         ///< at both
    double motor_speed = 0;         ///< [rad/s or m/s]
    double motor_limit = 0;         ///< [N·m or N]; 0 = no motor
    double servo_position = 0;      ///< [rad or m]
    double servo_speed = 0;         ///< [rad/s or m/s]
    double servo_stiffness = 0;     ///< [N·m/rad or N/m]
    double servo_damping = 0;       ///< [N·m·s/rad or N·s/m]
    double servo_limit = infinite;  ///< [N·m or N]
    double spring_stiffness = 0;    ///< [N·m/rad or N/m]
    double spring_rest = 0;         ///< [rad or m]
    double damping = 0;             ///< [N·m·s/rad or N·s/m]
    double friction = 0;            ///< [N·m or N]
    double rotor_inertia = 0;       ///< [kg·m² or kg]
    double position = 0;            ///< in the last step, from which turns are counted [rad or m]
    double rotor_speed = 0;         ///< at the beginning of the step [rad/s or m/s]

    bool hasMotor() const { return motor_limit > 0; }
    bool hasServo() const { return (servo_stiffness > 0 || servo_damping > 0) && servo_limit > 0; }
    /// Whether it may give energy to its bodies.
    bool mayDrive() const { return hasMotor() || hasServo() || spring_stiffness > 0 || rotor_inertia > 0; }
    /// Whether something other than a motor opposes what gravity does along it.
    bool resists() const {
        return friction > 0 || damping > 0 || spring_stiffness > 0 || rotor_inertia > 0 || hasServo();
    }
    bool isLimited() const { return lower > -infinite || upper < infinite; }
};

/// One joint; slots are kept and reused like those of bodies. Frames are those of the bodies' centres and principal
/// axes, of the world without a second body.
struct Joint {
    static constexpr BodyIndex world = UINT32_MAX;
    static constexpr double infinite = std::numeric_limits<double>::infinity();

    bool present = false;
    std::uint32_t generation = 0;
    JointKind kind = JointKind::ball;
    BodyIndex a = 0;  ///< of couplings a body of the first joint that can move
    BodyIndex b = world;
    Vec3 anchor_a = Vec3::Zero();              ///< [m, A]
    Vec3 anchor_b = Vec3::Zero();              ///< [m, B]
    Vec3 axis_a = Vec3::UnitZ();               ///< unit [A]
    Vec3 axis_b = Vec3::UnitZ();               ///< unit [B]
    Quat rest = Quat::Identity();              ///< A to B where the positions are zero
    Quat frame = Quat::Identity();             ///< the joint's frame to B
    double length = 0;                         ///< of distances and ropes [m]
    double lead = 0;                           ///< of screws: displacement per angle [m/rad]
    double cone = infinite;                    ///< of balls [rad]
    std::vector<FreeAxis> free{};              ///< what may move, by JointAlong
    double break_force = infinite;             ///< [N]
    double break_torque = infinite;            ///< [N·m]
    std::uint8_t locked = 0;                   ///< of locks: which axes of the world, a bit for each JointAlong
    bool collide = false;                      ///< whether A and B may touch
    std::uint32_t first = 0;                   ///< of couplings: slot of a joint
    std::uint32_t second = 0;                  ///< of couplings: slot of the joint that follows it
    std::uint32_t first_axis = 0;              ///< index in its free axes
    std::uint32_t second_axis = 0;             ///< index in its free axes
    double ratio = 1;                          ///< of couplings: position of the second per that of the first
    double coupled_impulse = 0;                ///< of couplings: on the second one's axis in the step [N·s or N·m·s]
    double offset = 0;                         ///< of couplings: position of the second where that of the first is zero
    std::uint32_t redundant = 0;               ///< rows of the last step that followed from others
    Vec3 impulse = Vec3::Zero();               ///< on A at its anchor in the last step [N·s, W]
    Vec3 angular_impulse = Vec3::Zero();       ///< on A besides [N·m·s, W]
    Vec3 last_impulse = Vec3::Zero();          ///< that of the step before, during a step: sleepers go on with it
    Vec3 last_angular_impulse = Vec3::Zero();  ///< likewise
    Vec3 booked_impulse = Vec3::Zero();        ///< of impulse: that of before what is measured [N·s, W]
    Vec3 booked_angular_impulse = Vec3::Zero();  ///< likewise [N·m·s, W]
    Vec3 fixed_impulse = Vec3::Zero();  ///< of couplings: that bodies that cannot move received, and the world [N·s, W]
    Vec3 fixed_angular_impulse = Vec3::Zero();  ///< likewise, about the origin [N·m·s, W]
};

/// Whether a body of a joint can move. @param i may be Joint::world
inline bool isMovable(std::span<const BodyKind> kind, BodyIndex i) {
    return i != Joint::world && kind[i] == BodyKind::dynamic;
}

/// Joints that do nothing now are left out of everything: removed ones, and those of bodies that cannot move.
inline bool isActive(const Joint& joint, std::span<const BodyKind> kind) {
    return joint.present && (isMovable(kind, joint.a) || isMovable(kind, joint.b));
}

}  // namespace cairn
