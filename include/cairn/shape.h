/// @file The shapes a body can have. Lengths in metres, in the body's own frame B (centre of mass, principal
/// axes), for hulls and compounds in the frame in which they are
/// given: the pose of a body is that of its shape.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

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

struct HullData;

/// The smallest convex solid that holds some points. They may stand in any frame: the pose of a body is that of this
/// frame, wherever its centre of mass is. Copies share what was computed of the points.
class ConvexHull {
  public:
    /// @param points in any order, some may be inside or equal [m]
    /// @throws InputError unless they are finite, at least four of them differ and they are not all in one plane
    explicit ConvexHull(std::vector<Vec3> points);

    std::span<const Vec3> points() const;   ///< as given [m]
    std::span<const Vec3> corners() const;  ///< the points that are corners of the solid, in the order given [m]
    /// Corners, faces and mass properties, for the engine itself.
    const HullData& data() const { return *data_; }

  private:
    std::shared_ptr<const HullData> data_;
};

/// All points p with normal·p ≤ offset are solid; always fixed, has no mass.
struct HalfSpace {
    Vec3 normal = Vec3::UnitZ();  ///< outward, in B, any length > 0
    double offset = 0;            ///< distance of the plane from the origin of B along the normal [m]
};

struct CompoundPart;

/// Several shapes that move as one body. Parts may touch and overlap; where they overlap each counts with its own mass.
struct Compound {
    std::vector<CompoundPart> parts;  ///< at least one
};

/// Any shape. A new kind joins here, in src/geometry (one table entry) and src/narrow_phase (its row of testers).
using Shape = std::variant<Sphere, Box, Capsule, HalfSpace, Cylinder, ConvexHull, Compound>;

/// A shape of a compound.
struct CompoundPart {
    Shape shape;                      ///< any but half-spaces and compounds
    Pose pose{};                      ///< of the shape in the compound's frame; the quaternion is normalised
    std::optional<double> mass{};     ///< [kg], > 0
    std::optional<double> density{};  ///< in place of a mass [kg/m³], > 0; without either it is that of the material
};

}  // namespace cairn
