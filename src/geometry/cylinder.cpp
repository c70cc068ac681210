#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/shape_entry.h"

namespace cairn {

namespace {

void validate(const Cylinder& cylinder) {
    validateDimension("the radius of a cylinder", cylinder.radius);
    validateDimension("the length of a cylinder", cylinder.length);
}

UnitMassProperties massProperties(const Cylinder& cylinder) {
    const double r2 = cylinder.radius * cylinder.radius;
    const double volume = std::numbers::pi * r2 * cylinder.length;
    const double across = volume * (3 * r2 + cylinder.length * cylinder.length) / 12;
    return {volume, {across, across, 0.5 * volume * r2}};
}

double radius(const Cylinder& cylinder) {
    return std::hypot(cylinder.radius, 0.5 * cylinder.length);
}

double innerRadius(const Cylinder& cylinder) {
    return std::min(cylinder.radius, 0.5 * cylinder.length);
}

Bounds bounds(const Cylinder& cylinder, const Pose& pose) {
    const Vec3 axis = pose.orientation * Vec3::UnitZ();
    // A disc reaches radius·sin of the angle between its axis and the direction.
    const Vec3 sines = (1 - axis.array().square()).max(0.0).sqrt();
    const Vec3 extent = 0.5 * cylinder.length * axis.cwiseAbs() + cylinder.radius * sines;
    return {pose.position - extent, pose.position + extent};
}

Vec3 farthest(const Cylinder& cylinder, const Vec3& direction) {
    const Eigen::Vector2d across = cylinder.radius * direction.head<2>().stableNormalized();
    return {across.x(), across.y(), std::copysign(0.5 * cylinder.length, direction.z())};
}

constexpr ShapeEntry cylinder_entry =
    finiteShapeEntry<Cylinder, validate, massProperties, radius, innerRadius, bounds, farthest>("cylinder");

}  // namespace

const ShapeEntry& cylinderEntry() {
    return cylinder_entry;
}

}  // namespace cairn
