#include "world/joint_axes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "world/limits.h"

namespace cairn {

namespace {

/// Largest gain, stiffness, damping and inertia: their products with a time step stay far from overflow.
constexpr double gain_limit = 1e30;

/// Largest angle of a limit, a spring or a servo [rad].
constexpr double angle_limit = 1e6;

void requireRange(double value, double most, std::string_view what, std::string_view title) {
    if (value >= 0 && value <= most) return;
    throw InputError(fmt::format("{} of a {} is {}; it must be within 0 and {}", what, title, value, most));
}

void requirePlace(double value, std::string_view what, JointAlong along) {
    const double most = isAngle(along) ? angle_limit : distance_limit;
    if (std::abs(value) <= most) return;
    throw InputError(
        fmt::format("the {} is {} {}; it must be within ±{}", what, value, isAngle(along) ? "rad" : "m", most));
}

void requireServo(const JointServo& servo, JointAlong along) {
    requirePlace(servo.position, "position of a servo", along);
    if (!(std::abs(servo.speed) <= speed_limit)) {
        throw InputError(fmt::format("the speed of a servo is {}; it must be within ±{}", servo.speed, speed_limit));
    }
    requireRange(servo.stiffness, gain_limit, "stiffness", "servo");
    requireRange(servo.damping, gain_limit, "damping", "servo");
    requireRange(servo.limit, JointServo::no_limit, "limit", "servo");
    if (servo.stiffness > 0 || servo.damping > 0) return;
    throw InputError("a servo has neither stiffness nor damping, so it does nothing; give one of them above 0");
}

/// What the description has of its own for its only free axis.
JointAxis ownOf(const JointDescription& d) {
    return {.lower = d.lower,
            .upper = d.upper,
            .restitution = d.restitution,
            .motor = d.motor,
            .servo = d.servo,
            .spring = d.spring,
            .damping = d.damping,
            .friction = d.friction,
            .rotor_inertia = d.rotor_inertia};
}

/// The first member that is given, or nothing.
std::string_view givenOf(const JointAxis& axis) {
    if (axis.lower || axis.upper) return "limits";
    if (axis.motor) return "motor";
    if (axis.servo) return "servo";
    if (axis.spring) return "spring";
    if (axis.damping != 0) return "damping";
    if (axis.friction != 0) return "friction";
    if (axis.rotor_inertia != 0) return "rotor_inertia";
    if (axis.restitution != 0) return "restitution";
    return {};
}

void requireBallLimits(const FreeAxis& axis) {
    if (axis.along == JointAlong::turn_x) {
        const auto isPast = [](double value) { return std::isfinite(value) && std::abs(value) > std::numbers::pi; };
        if (!isPast(axis.lower) && !isPast(axis.upper)) return;
        throw InputError("a twist limit of a ball joint is beyond ±π; its twist ends there");
    }
    if (axis.isLimited()) throw InputError("only the twist of a ball joint has limits; give the others a cone");
}

std::vector<FreeAxis> namedAxes(const JointDescription& d, const JointKindEntry& kind) {
    std::vector<FreeAxis> free;
    for (const JointAxis& axis : d.axes) {
        if (axis.along > JointAlong::turn_z) throw InputError("an axis of a joint is none of JointAlong");
        const auto isSame = [&](const FreeAxis& other) { return other.along == axis.along; };
        if (std::ranges::any_of(free, isSame)) {
            throw InputError(fmt::format("an axis of a {} is given twice; give it once", kind.title));
        }
        free.push_back(freeAxisOf(axis, axis.along, kind));
    }
    return free;
}

}  // namespace

void requireLimits(const std::optional<double>& lower, const std::optional<double>& upper, JointAlong along,
                   const JointKindEntry& kind) {
    const double limit = isAngle(along) ? angle_limit : distance_limit;
    const std::string_view unit = isAngle(along) ? "rad" : "m";
    for (const auto& value : {lower, upper}) {
        if (!value || std::abs(*value) <= limit) continue;
        throw InputError(
            fmt::format("a limit of a {} is {} {}; it must be within ±{} {}", kind.title, *value, unit, limit, unit));
    }
    if (lower && upper && *lower > *upper) {
        throw InputError(fmt::format("the limits of a {} are reversed: lower {} {} is above upper {} {}; swap them",
                                     kind.title, *lower, unit, *upper, unit));
    }
}

void requireMotor(const JointMotor& motor) {
    if (!(std::abs(motor.speed) <= speed_limit)) {
        throw InputError(
            fmt::format("the speed of a motor is {}; it must be finite and within ±{}", motor.speed, speed_limit));
    }
    if (!(motor.limit >= 0 && std::isfinite(motor.limit))) {
        throw InputError(
            fmt::format("the limit of a motor is {}; it must be finite and at least 0 [N or N·m]", motor.limit));
    }
}

void setServo(const JointServo& servo, FreeAxis& axis) {
    requireServo(servo, axis.along);
    axis.servo_position = servo.position;
    axis.servo_speed = servo.speed;
    axis.servo_stiffness = servo.stiffness;
    axis.servo_damping = servo.damping;
    axis.servo_limit = servo.limit;
}

FreeAxis freeAxisOf(const JointAxis& axis, JointAlong along, const JointKindEntry& kind) {
    FreeAxis free;
    free.along = along;
    requireLimits(axis.lower, axis.upper, along, kind);
    free.lower = axis.lower.value_or(-FreeAxis::infinite);
    free.upper = axis.upper.value_or(FreeAxis::infinite);
    requireRange(axis.restitution, 1, "restitution", kind.title);
    free.restitution = axis.restitution;
    if (axis.motor && axis.servo) {
        throw InputError(fmt::format("an axis of a {} has a motor and a servo; give one of them", kind.title));
    }
    if (axis.motor) {
        requireMotor(*axis.motor);
        free.motor_speed = axis.motor->speed;
        free.motor_limit = axis.motor->limit;
    }
    if (axis.servo) setServo(*axis.servo, free);
    if (axis.spring) {
        requireRange(axis.spring->stiffness, gain_limit, "stiffness", "spring");
        requirePlace(axis.spring->rest, "rest of a spring", along);
        free.spring_stiffness = axis.spring->stiffness;
        free.spring_rest = axis.spring->rest;
    }
    requireRange(axis.damping, gain_limit, "damping", kind.title);
    requireRange(axis.friction, gain_limit, "friction", kind.title);
    requireRange(axis.rotor_inertia, gain_limit, "rotor_inertia", kind.title);
    free.damping = axis.damping;
    free.friction = axis.friction;
    free.rotor_inertia = axis.rotor_inertia;
    if (kind.uses.cone) requireBallLimits(free);
    return free;
}

std::vector<FreeAxis> freeAxesOf(const JointDescription& d, const JointKindEntry& kind) {
    const JointAxis own = ownOf(d);
    const std::string_view given = givenOf(own);
    if (!kind.uses.own_axis && !given.empty()) {
        throw InputError(fmt::format("a {} has no {} of its own; {}", kind.title, given,
                                     kind.uses.axes ? "give it in axes" : "hinges, sliders and screws have"));
    }
    if (!kind.uses.axes && !d.axes.empty()) {
        throw InputError(fmt::format("a {} has no axes; give what acts on it without the list", kind.title));
    }
    if (kind.uses.free_axes) return namedAxes(d, kind);
    if (!d.axes.empty() && d.axes.size() != kind.free.size()) {
        throw InputError(fmt::format("a {} has {} free axes, but axes has {}; give all of them, or none", kind.title,
                                     kind.free.size(), d.axes.size()));
    }
    std::vector<FreeAxis> free;
    for (std::size_t i = 0; i < kind.free.size(); ++i) {
        const JointAxis& axis = kind.uses.own_axis ? own : d.axes.empty() ? JointAxis{} : d.axes[i];
        free.push_back(freeAxisOf(axis, kind.free[i], kind));
    }
    return free;
}

}  // namespace cairn
