/// @file What may act along the free axes of joints, checked as users give it.
#pragma once

#include <optional>
#include <vector>

#include "joints/joint_kinds.h"

namespace cairn {

/// @throws InputError unless they are finite and not reversed
void requireLimits(const std::optional<double>& lower, const std::optional<double>& upper, JointAlong along,
                   const JointKindEntry& kind);

/// @throws InputError out of range
void requireMotor(const JointMotor& motor);

/// Gives an axis a servo. @throws InputError out of range
void setServo(const JointServo& servo, FreeAxis& axis);

/// @param along which axis it is @throws InputError out of range
FreeAxis freeAxisOf(const JointAxis& axis, JointAlong along, const JointKindEntry& kind);

/// All free axes of a joint. @throws InputError for members that its kind has not, or that are out of range
std::vector<FreeAxis> freeAxesOf(const JointDescription& d, const JointKindEntry& kind);

}  // namespace cairn
