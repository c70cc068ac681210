/// @file What a world keeps of motions by laws.
#pragma once

#include <cstdint>
#include <memory>

#include "body/body_fields.h"
#include "integration/motion_curve.h"

namespace cairn {

/// A body that moves by a law.
struct DrivenBody {
    BodyIndex body = 0;
    double start = 0;           ///< simulated time at which the law begins [s]
    Pose pose{};                ///< of the shape's frame at that time [W]
    Vec3 pivot = Vec3::Zero();  ///< about which it turns [m, frame of the shape]
    std::shared_ptr<const MotionCurve> curve{};
};

/// How the moving laws that a body's batch touches carry it.
enum class Carried : std::uint8_t {
    not_at_all,
    evenly,   ///< by a velocity that stays the same
    unevenly  ///< by one that changes from step to step
};

/// The motion of the frame of a world.
struct FrameMotion {
    double start = 0;  ///< simulated time at which it begins [s]
    std::shared_ptr<const MotionCurve> curve{};
};

/// Gravity as a function of time.
struct GravityLaw {
    double start = 0;                            ///< simulated time at which it begins [s]
    Vec3 gravity = Vec3::Zero();                 ///< at that time [m/s², W]
    std::shared_ptr<const MotionCurve> curve{};  ///< what is added to it [m/s², W]
};

}  // namespace cairn
