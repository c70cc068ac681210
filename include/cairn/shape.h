/// @file The shapes a body can have. Lengths in metres, in the body's own frame B (centre of mass, principal axes).
#pragma once

#include <variant>

#include "cairn/types.h"

namespace cairn {

/// A ball about the origin of B.
struct Sphere {
    double radius = 0.5;  ///< [m], > 0
};

/// A cuboid about the origin of B, its edges along the axes of B.
struct Box {
    Vec3 size = Vec3::Ones();  ///< full edge lengths [m], each > 0
};

/// A cylinder along the z axis of B with a half ball on each end.
struct Capsule {
    double radius = 0.5;  ///< [m], > 0
    double length = 1.0;  ///< of the cylindrical part, without the half balls [m], > 0
};

/// A cylinder about the origin of B, its axis along z.
struct Cylinder {
    double radius = 0.5;  ///< [m], > 0
    double length = 1.0;  ///< along the axis [m], > 0
};

/// All points p with normal·p ≤ offset are solid; always fixed, has no mass.
struct HalfSpace {
    Vec3 normal = Vec3::UnitZ();  ///< outward, in B, any length > 0
    double offset = 0;            ///< distance of the plane from the origin of B along the normal [m]
};

/// Any shape. A new kind joins here, in src/geometry (one table entry) and src/narrow_phase (its row of testers).
using Shape = std::variant<Sphere, Box, Capsule, HalfSpace, Cylinder>;

}  // namespace cairn
