/// @file One tester per pair of shapes. Each stands in the file of its name and fills an empty manifold whose normal
/// points from the second shape to the first; the table in narrow_phase.cpp chooses and swaps them. Pairs
/// that have none of their own use convexPair of convex_contact.h.
#pragma once

#include "narrow_phase/narrow_phase.h"

namespace cairn {

void sphereSphere(const Sphere& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b, double margin,
                  Manifold& manifold);
void sphereBox(const Sphere& a, const Pose& pose_a, const Box& b, const Pose& pose_b, double margin,
               Manifold& manifold);
void sphereCapsule(const Sphere& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b, double margin,
                   Manifold& manifold);
void sphereHalfSpace(const Sphere& a, const Pose& pose_a, const HalfSpace& b, const Pose& pose_b, double margin,
                     Manifold& manifold);
void boxBox(const Box& a, const Pose& pose_a, const Box& b, const Pose& pose_b, double margin, Manifold& manifold);
void boxHalfSpace(const Box& a, const Pose& pose_a, const HalfSpace& b, const Pose& pose_b, double margin,
                  Manifold& manifold);
void capsuleBox(const Capsule& a, const Pose& pose_a, const Box& b, const Pose& pose_b, double margin,
                Manifold& manifold);
void capsuleCapsule(const Capsule& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b, double margin,
                    Manifold& manifold);
void capsuleHalfSpace(const Capsule& a, const Pose& pose_a, const HalfSpace& b, const Pose& pose_b, double margin,
                      Manifold& manifold);

void sphereCylinder(const Sphere& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b, double margin,
                    Manifold& manifold);
void cylinderHalfSpace(const Cylinder& a, const Pose& pose_a, const HalfSpace& b, const Pose& pose_b, double margin,
                       Manifold& manifold);
void hullHalfSpace(const ConvexHull& a, const Pose& pose_a, const HalfSpace& b, const Pose& pose_b, double margin,
                   Manifold& manifold);

}  // namespace cairn
