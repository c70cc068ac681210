/// @file A joint as the world keeps it.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "body/body_storage.h"
#include "cairn/joint.h"

namespace cairn {

/// One joint; slots are kept and reused like those of bodies. Frames are those of the bodies' centres and principal
/// axes, of the world without a second body.
struct Joint {
    static constexpr BodyIndex world = UINT32_MAX;
    static constexpr double infinite = std::numeric_limits<double>::infinity();

    bool present = false;
    std::uint32_t generation = 0;
    JointKind kind = JointKind::ball;
    BodyIndex a = 0;
    BodyIndex b = world;
    Vec3 anchor_a = Vec3::Zero();              ///< [m, A]
    Vec3 anchor_b = Vec3::Zero();              ///< [m, B]
    Vec3 axis_a = Vec3::UnitZ();               ///< unit [A]
    Vec3 axis_b = Vec3::UnitZ();               ///< unit [B]
    Quat rest = Quat::Identity();              ///< A to B where the position is zero
    double length = 0;                         ///< of distances and ropes [m]
    double lower = -infinite;                  ///< least position [rad or m]
    double upper = infinite;                   ///< greatest position [rad or m]
    double motor_speed = 0;                    ///< [rad/s or m/s]
    double motor_limit = 0;                    ///< [N·m or N]; 0 = no motor
    double break_force = infinite;             ///< [N]
    double break_torque = infinite;            ///< [N·m]
    bool collide = false;                      ///< whether A and B may touch
    Vec3 impulse = Vec3::Zero();               ///< on A at its anchor in the last step [N·s, W]
    Vec3 angular_impulse = Vec3::Zero();       ///< on A besides [N·m·s, W]
    Vec3 last_impulse = Vec3::Zero();          ///< that of the step before, during a step: sleepers go on with it
    Vec3 last_angular_impulse = Vec3::Zero();  ///< likewise

    bool hasMotor() const { return motor_limit > 0; }
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
