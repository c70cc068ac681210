/// @file The contact manifold of any two convex shapes.
#pragma once

#include "narrow_phase/convex.h"
#include "narrow_phase/narrow_phase.h"

namespace cairn {

/// Finds the direction of contact, then all points in which the features that face each other touch.
/// @param origin of the frame of both shapes [m, W] @param margin [m], ≥ 0 @param manifold empty; of W
void convexContact(const Convex& a, const Convex& b, const Vec3& origin, double margin, Manifold& manifold);

/// The tester of two kinds of convex shapes for the table.
template <class S, class T>
void convexPair(const S& a, const Pose& pose_a, const T& b, const Pose& pose_b, double margin, Manifold& manifold) {
    const Vec3& origin = pose_a.position;
    convexContact(Convex(a, pose_a, origin), Convex(b, pose_b, origin), origin, margin, manifold);
}

}  // namespace cairn
