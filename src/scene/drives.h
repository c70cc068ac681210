/// @file What follows functions of time.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "cairn/scene.h"
#include "integration/motion_curve.h"

namespace cairn {

/// In the order of DriveOf, as scenes call them.
inline constexpr std::array<std::string_view, 4> drive_names = {"position", "speed", "force", "torque"};

/// Whether its target is a joint.
constexpr bool drivesJoint(DriveOf what) {
    return what == DriveOf::position || what == DriveOf::speed;
}

/// @param start its value at the beginning @throws InputError for a law that no function of time has
void requireFunction(const Motion& law, const Vec3& start);
/// @throws InputError unless the scene has what it drives
void requireDrive(const SceneDrive& drive, const Scene& scene);
/// Sets what it drives to its value in the coming step; a joint that broke and a body that is gone stay so.
/// @param curve of its law @param ids of the bodies @pre the world's first joints are those of the scene, none was
/// removed before
void applyDrive(const SceneDrive& drive, const MotionCurve& curve, const Scene& scene, std::span<const BodyId> ids,
                World& world);

}  // namespace cairn
