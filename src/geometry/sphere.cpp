#include <numbers>

#include "geometry/shape_entry.h"

namespace cairn {

namespace {

void validate(const Sphere& sphere) {
    validateDimension("the radius of a sphere", sphere.radius);
}

UnitMassProperties massProperties(const Sphere& sphere) {
    const double r2 = sphere.radius * sphere.radius;
    const double volume = 4.0 / 3.0 * std::numbers::pi * r2 * sphere.radius;
    return {volume, Vec3::Constant(0.4 * volume * r2)};
}

double radius(const Sphere& sphere) {
    return sphere.radius;
}

double innerRadius(const Sphere& sphere) {
    return sphere.radius;
}

Bounds bounds(const Sphere& sphere, const Pose& pose) {
    return {pose.position.array() - sphere.radius, pose.position.array() + sphere.radius};
}

Vec3 farthest(const Sphere& sphere, const Vec3& direction) {
    return sphere.radius * direction.stableNormalized();
}

constexpr ShapeEntry sphere_entry =
    finiteShapeEntry<Sphere, validate, massProperties, radius, innerRadius, bounds, farthest>("sphere");

}  // namespace

const ShapeEntry& sphereEntry() {
    return sphere_entry;
}

}  // namespace cairn
