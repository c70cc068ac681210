#include <algorithm>
#include <cmath>
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

std::optional<LocalHit> surface(const Sphere& sphere, const LocalRay& ray) {
    const double along = ray.origin.dot(ray.direction);
    const double outside = ray.origin.squaredNorm() - sphere.radius * sphere.radius;
    if (!(outside > 0)) return hitAtOnce(ray);
    if (!(along < 0)) return {};
    // Of the line's nearest point, not of the origin: nothing is lost when the ray comes from far away.
    const double chord = sphere.radius * sphere.radius - (ray.origin - along * ray.direction).squaredNorm();
    if (chord < 0) return {};
    const double distance = std::max(0.0, -along - std::sqrt(chord));
    return LocalHit{distance, (ray.origin + distance * ray.direction).normalized()};
}

constexpr ShapeEntry sphere_entry =
    finiteShapeEntry<Sphere, validate, massProperties, radius, innerRadius, bounds, surface, farthest>("sphere");

}  // namespace

const ShapeEntry& sphereEntry() {
    return sphere_entry;
}

}  // namespace cairn
