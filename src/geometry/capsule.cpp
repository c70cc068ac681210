#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/shape_entry.h"

namespace cairn {

namespace {

void validate(const Capsule& capsule) {
    validateDimension("the radius of a capsule", capsule.radius);
    validateDimension("the length of a capsule", capsule.length);
}

UnitMassProperties massProperties(const Capsule& capsule) {
    const double r = capsule.radius;
    const double length = capsule.length;
    const double cylinder = std::numbers::pi * r * r * length;
    const double ball = 4.0 / 3.0 * std::numbers::pi * r * r * r;
    // A half ball of mass m has the inertia 83/320·m·r² about the transverse axis through its centroid, which lies
    // 3r/8 above its flat side; moved by length/2 + 3r/8 (Steiner) that becomes m·(2/5·r² + length²/4 + 3/8·r·length).
    const double across = cylinder * (3 * r * r + length * length) / 12 +
                          ball * (0.4 * r * r + 0.25 * length * length + 0.375 * r * length);
    const double along = 0.5 * cylinder * r * r + 0.4 * ball * r * r;
    return {cylinder + ball, {across, across, along}};
}

double radius(const Capsule& capsule) {
    return 0.5 * capsule.length + capsule.radius;
}

double innerRadius(const Capsule& capsule) {
    return capsule.radius;
}

Bounds bounds(const Capsule& capsule, const Pose& pose) {
    const Vec3 axis = pose.orientation * Vec3::UnitZ();
    const Vec3 extent = (0.5 * capsule.length * axis).cwiseAbs().array() + capsule.radius;
    return {pose.position - extent, pose.position + extent};
}

Vec3 farthest(const Capsule& capsule, const Vec3& direction) {
    Vec3 point = capsule.radius * direction.stableNormalized();
    point.z() += std::copysign(0.5 * capsule.length, direction.z());
    return point;
}

/// Where a ray from outside enters a ball on the axis.
void offerBall(const LocalRay& ray, double radius, double height, std::optional<LocalHit>& best) {
    const Vec3 centre(0, 0, height);
    const Vec3 from = ray.origin - centre;
    const double along = from.dot(ray.direction);
    if (!(along < 0)) return;
    const double chord = radius * radius - (from - along * ray.direction).squaredNorm();
    if (chord < 0) return;
    const double distance = std::max(0.0, -along - std::sqrt(chord));
    if (best && best->distance <= distance) return;
    best = LocalHit{distance, (from + distance * ray.direction).normalized()};
}

std::optional<LocalHit> surface(const Capsule& capsule, const LocalRay& ray) {
    const double r = capsule.radius;
    const double half = 0.5 * capsule.length;
    const Vec3 beside = ray.origin - Vec3(0, 0, std::clamp(ray.origin.z(), -half, half));
    if (beside.squaredNorm() <= r * r) return hitAtOnce(ray);
    // The solid is a tube and two balls: outside all of them, the ray enters it where it first enters one.
    std::optional<LocalHit> best;
    const Eigen::Vector2d across = ray.direction.head<2>();
    const double squared = across.squaredNorm();
    const double along = ray.origin.head<2>().dot(across) / squared;
    const double chord = r * r - (ray.origin.head<2>() - along * across).squaredNorm();
    if (squared > 0 && chord >= 0) {
        const double distance = -along - std::sqrt(chord / squared);
        const Vec3 point = ray.origin + distance * ray.direction;
        if (distance >= 0 && std::abs(point.z()) <= half) {
            best = LocalHit{distance, Vec3(point.x(), point.y(), 0).normalized()};
        }
    }
    offerBall(ray, r, half, best);
    offerBall(ray, r, -half, best);
    return best;
}

constexpr ShapeEntry capsule_entry =
    finiteShapeEntry<Capsule, validate, massProperties, radius, innerRadius, bounds, surface, farthest>("capsule");

}  // namespace

const ShapeEntry& capsuleEntry() {
    return capsule_entry;
}

}  // namespace cairn
