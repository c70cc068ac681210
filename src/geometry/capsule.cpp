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

constexpr ShapeEntry capsule_entry =
    finiteShapeEntry<Capsule, validate, massProperties, radius, innerRadius, bounds, farthest>("capsule");

}  // namespace

const ShapeEntry& capsuleEntry() {
    return capsule_entry;
}

}  // namespace cairn
