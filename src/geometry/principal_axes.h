/// @file The principal axes of an inertia.
#pragma once

#include <string_view>

#include "cairn/types.h"

namespace cairn {

/// Moments about three perpendicular axes, and the axes.
struct PrincipalInertia {
    Vec3 moments;
    Quat axes;  ///< from the principal axes to the frame of the inertia
};

/// @param inertia symmetric; one that is diagonal but for rounding keeps its axes
PrincipalInertia principalInertia(const Mat3& inertia);

/// Moments of a body are positive, and none is larger than the sum of the others.
/// @param unit in the message @throws InputError unless the inertia is symmetric and that of a body
void requireInertia(const Mat3& inertia, std::string_view unit);

}  // namespace cairn
