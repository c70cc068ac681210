#include "geometry/geometry.h"

#include <fmt/core.h>

#include <array>
#include <cassert>

#include "geometry/shape_entry.h"

namespace cairn {

namespace {

using EntryOf = const ShapeEntry& (*)();

/// In the order of the alternatives of Shape.
constexpr std::array<EntryOf, std::variant_size_v<Shape>> entries = {sphereEntry,    boxEntry,      capsuleEntry,
                                                                     halfSpaceEntry, cylinderEntry, hullEntry,
                                                                     compoundEntry,  meshEntry,     heightFieldEntry};

const ShapeEntry& entryOf(const Shape& shape) {
    return entries[shape.index()]();
}

}  // namespace

void validateDimension(std::string_view what, double length) {
    if (length >= smallest_dimension && length <= largest_dimension) return;
    throw InputError(fmt::format("{} is {}; it must be a positive, finite length between {} and {} m", what, length,
                                 smallest_dimension, largest_dimension));
}

std::string_view shapeName(const Shape& shape) {
    return entryOf(shape).name;
}

void validateShape(const Shape& shape) {
    entryOf(shape).validate(shape);
}

bool isInfinite(const Shape& shape) {
    return entryOf(shape).support == nullptr;
}

bool isSolid(const Shape& shape) {
    return !isInfinite(shape) && surfaceOf(shape) == nullptr;
}

UnitMassProperties unitMassProperties(const Shape& shape) {
    return entryOf(shape).mass_properties(shape);
}

double largestRadius(const Shape& shape) {
    return entryOf(shape).largest_radius(shape);
}

double smallestRadius(const Shape& shape) {
    return entryOf(shape).smallest_radius(shape);
}

Bounds boundsOf(const Shape& shape, const Pose& pose) {
    return entryOf(shape).bounds(shape, pose);
}

Vec3 support(const Shape& shape, const Vec3& direction) {
    assert(!isInfinite(shape));
    return entryOf(shape).support(shape, direction);
}

std::optional<LocalHit> castRay(const Shape& shape, const LocalRay& ray) {
    return entryOf(shape).cast_ray(shape, ray);
}

}  // namespace cairn
