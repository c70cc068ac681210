/// @file The principal axes of an inertia.
#pragma once

#include "cairn/types.h"

namespace cairn {

/// Moments about three perpendicular axes, and the axes.
struct PrincipalInertia {
    Vec3 moments;
    Quat axes;  ///< from the principal axes to the frame of the inertia
};

/// @param inertia symmetric; one that is diagonal but for rounding keeps its axes
PrincipalInertia principalInertia(const Mat3& inertia);

}  // namespace cairn
