/// @file What the engine needs to know of a shape apart from its contacts. One table entry per kind of shape.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "cairn/shape.h"

namespace cairn {

/// An axis-aligned box in W; infinite shapes have infinite bounds.
struct Bounds {
    Vec3 lower = Vec3::Constant(-std::numeric_limits<double>::infinity());  ///< [m, W]
    Vec3 upper = Vec3::Constant(std::numeric_limits<double>::infinity());   ///< [m, W]

    Bounds grown(double by) const { return {lower.array() - by, upper.array() + by}; }
    /// Without branches, since nobody can predict them.
    bool overlaps(const Bounds& other) const {
        return (isBelow(lower, other.upper) & isBelow(other.lower, upper)) != 0;
    }
    bool contains(const Bounds& other) const {
        return (isBelow(lower, other.lower) & isBelow(other.upper, upper)) != 0;
    }

  private:
    /// @return 0 or 1
    static int isBelow(const Vec3& x, const Vec3& y) {
        return static_cast<int>(x.x() <= y.x()) & static_cast<int>(x.y() <= y.y()) & static_cast<int>(x.z() <= y.z());
    }
};

/// Volume and inertia of a solid of density 1.
struct UnitMassProperties {
    double volume;                 ///< [m³]; infinite for a half-space
    Vec3 inertia_volume;           ///< principal moments about the centre for density 1 [m⁵, B]
    Vec3 centre = Vec3::Zero();    ///< of mass [m, frame of the shape]
    Quat axes = Quat::Identity();  ///< B, the principal axes, to the frame of the shape
};

/// A half line in the frame of a shape.
struct LocalRay {
    Vec3 origin;     ///< [m]
    Vec3 direction;  ///< unit
};

/// Where a ray meets a shape.
struct LocalHit {
    double distance;         ///< from the origin of the ray [m]
    Vec3 normal;             ///< unit, outward, in the frame of the shape
    std::uint32_t part = 0;  ///< of a compound, or triangle of a surface
};

/// "sphere", "box", "capsule", "plane", "cylinder", "hull", "compound", "mesh", "height_field": the name in scene
/// files.
std::string_view shapeName(const Shape& shape);
/// Gives a compound of many parts a tree over them; takes that of any other away. @pre validateShape(shape), with unit
/// quaternions of parts
void indexParts(Shape& shape);
/// Bounds that hold also what rounding makes of them, so that who asks them first finds all that who does not finds.
Bounds widened(const Bounds& bounds);
/// @throws InputError if a dimension is not finite or not positive; the text names it
void validateShape(const Shape& shape);
/// True if the shape has no bounds.
bool isInfinite(const Shape& shape);
/// True if the shape encloses mass; others must be fixed.
bool isSolid(const Shape& shape);
/// The triangles of a mesh or height field; null for other shapes.
inline const SurfaceData* surfaceOf(const Shape& shape) {
    if (const auto* mesh = std::get_if<Mesh>(&shape)) return &mesh->data();
    if (const auto* field = std::get_if<HeightField>(&shape)) return &field->data();
    return nullptr;
}
/// @pre validateShape(shape)
UnitMassProperties unitMassProperties(const Shape& shape);
/// Largest distance of a surface point from the centre of mass [m]: r_max of thesis (3.2.2); infinite for a half-space.
/// Of a surface that from the origin of its frame.
double largestRadius(const Shape& shape);
/// Radius of a ball that fits into the shape about its middle [m]: half of what a box or a plate is thick, and of a
/// compound that of its thinnest part; infinite for half-spaces and surfaces.
double smallestRadius(const Shape& shape);
/// Bounds of the posed shape, as tight as an axis-aligned box can be. @param pose of B in W
Bounds boundsOf(const Shape& shape, const Pose& pose);
/// The farthest point in a direction. @param direction [B], not zero @return [m, B] @pre !isInfinite(shape)
Vec3 support(const Shape& shape, const Vec3& direction);
/// Where a ray first meets a shape; one that begins inside or on it meets it at once, with the normal against it. Of
/// parts of a compound that are met at once the first counts.
std::optional<LocalHit> castRay(const Shape& shape, const LocalRay& ray);
/// The same for one part of a compound, in the frame of the compound.
std::optional<LocalHit> castRay(const CompoundPart& part, const LocalRay& ray);

}  // namespace cairn
