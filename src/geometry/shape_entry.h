/// @file The table of shapes: one entry per kind, each filled in by the file of its shape.
#pragma once

#include <string_view>

#include "geometry/geometry.h"

namespace cairn {

/// What a kind of shape can do; the functions mean what those of geometry.h mean.
struct ShapeEntry {
    std::string_view name;
    void (*validate)(const Shape&);
    UnitMassProperties (*mass_properties)(const Shape&);
    double (*largest_radius)(const Shape&);
    double (*smallest_radius)(const Shape&);
    Bounds (*bounds)(const Shape&, const Pose&);
    std::optional<LocalHit> (*cast_ray)(const Shape&, const LocalRay&);
    Vec3 (*support)(const Shape&, const Vec3&);  ///< null for infinite shapes
};

/// Adapts functions that take the shape's own type. @tparam S the alternative of Shape they belong to
template <class S, void (*validate)(const S&), UnitMassProperties (*mass_properties)(const S&),
          double (*largest_radius)(const S&), double (*smallest_radius)(const S&),
          Bounds (*bounds)(const S&, const Pose&), std::optional<LocalHit> (*cast_ray)(const S&, const LocalRay&)>
constexpr ShapeEntry infiniteShapeEntry(std::string_view name) {
    return {name,
            [](const Shape& shape) { validate(*std::get_if<S>(&shape)); },
            [](const Shape& shape) { return mass_properties(*std::get_if<S>(&shape)); },
            [](const Shape& shape) { return largest_radius(*std::get_if<S>(&shape)); },
            [](const Shape& shape) { return smallest_radius(*std::get_if<S>(&shape)); },
            [](const Shape& shape, const Pose& pose) { return bounds(*std::get_if<S>(&shape), pose); },
            [](const Shape& shape, const LocalRay& ray) { return cast_ray(*std::get_if<S>(&shape), ray); },
            nullptr};
}

/// The same for a shape that has an end in every direction.
template <class S, void (*validate)(const S&), UnitMassProperties (*mass_properties)(const S&),
          double (*largest_radius)(const S&), double (*smallest_radius)(const S&),
          Bounds (*bounds)(const S&, const Pose&), std::optional<LocalHit> (*cast_ray)(const S&, const LocalRay&),
          Vec3 (*support)(const S&, const Vec3&)>
constexpr ShapeEntry finiteShapeEntry(std::string_view name) {
    ShapeEntry entry =
        infiniteShapeEntry<S, validate, mass_properties, largest_radius, smallest_radius, bounds, cast_ray>(name);
    entry.support = [](const Shape& shape, const Vec3& direction) {
        return support(*std::get_if<S>(&shape), direction);
    };
    return entry;
}

/// Of a ray that begins inside a shape or on its surface.
inline LocalHit hitAtOnce(const LocalRay& ray) {
    return {0, -ray.direction};
}

/// Each stands in the file of its shape.
const ShapeEntry& sphereEntry();
const ShapeEntry& boxEntry();
const ShapeEntry& capsuleEntry();
const ShapeEntry& halfSpaceEntry();
const ShapeEntry& cylinderEntry();
const ShapeEntry& hullEntry();
const ShapeEntry& compoundEntry();
const ShapeEntry& meshEntry();
const ShapeEntry& heightFieldEntry();

/// Smallest and largest length of a shape [m]: between them no volume, inertia or inverse leaves the range of double,
/// nor comes near what is not normal.
inline constexpr double smallest_dimension = 1e-6;
inline constexpr double largest_dimension = 1e9;

/// @param what names the length in the message @throws InputError if it is not within the limits above
void validateDimension(std::string_view what, double length);

}  // namespace cairn
