#include <algorithm>
#include <cmath>
#include <limits>
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

std::optional<LocalHit> surface(const Cylinder& cylinder, const LocalRay& ray) {
    const double r = cylinder.radius;
    const double half = 0.5 * cylinder.length;
    const Eigen::Vector2d from = ray.origin.head<2>();
    const Eigen::Vector2d across = ray.direction.head<2>();
    const bool within_tube = from.squaredNorm() <= r * r;
    if (within_tube && std::abs(ray.origin.z()) <= half) return hitAtOnce(ray);
    double enter = -std::numeric_limits<double>::infinity();
    double leave = std::numeric_limits<double>::infinity();
    const double squared = across.squaredNorm();
    if (squared > 0) {
        const double along = from.dot(across) / squared;
        const double chord = r * r - (from - along * across).squaredNorm();
        if (chord < 0) return {};
        enter = -along - std::sqrt(chord / squared);
        leave = -along + std::sqrt(chord / squared);
    } else if (!within_tube) {
        return {};
    }
    bool by_cap = false;
    if (const double d = ray.direction.z(); d != 0) {
        const double cap = (-std::copysign(half, d) - ray.origin.z()) / d;
        leave = std::min(leave, (std::copysign(half, d) - ray.origin.z()) / d);
        by_cap = cap > enter;
        enter = std::max(enter, cap);
    } else if (std::abs(ray.origin.z()) > half) {
        return {};
    }
    if (enter > leave || enter < 0) return {};
    if (by_cap) return LocalHit{enter, {0, 0, -std::copysign(1.0, ray.direction.z())}};
    const Vec3 point = ray.origin + enter * ray.direction;
    return LocalHit{enter, Vec3(point.x(), point.y(), 0).normalized()};
}

constexpr ShapeEntry cylinder_entry =
    finiteShapeEntry<Cylinder, validate, massProperties, radius, innerRadius, bounds, surface, farthest>("cylinder");

}  // namespace

const ShapeEntry& cylinderEntry() {
    return cylinder_entry;
}

}  // namespace cairn
