#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/shape_entry.h"

namespace cairn {

namespace {

void validate(const Box& box) {
    validateDimension("the size x of a box", box.size.x());
    validateDimension("the size y of a box", box.size.y());
    validateDimension("the size z of a box", box.size.z());
}

UnitMassProperties massProperties(const Box& box) {
    const double volume = box.size.prod();
    const Vec3 squares = box.size.cwiseAbs2();
    return {volume, volume / 12 * (Vec3::Constant(squares.sum()) - squares)};
}

double radius(const Box& box) {
    return 0.5 * box.size.norm();
}

double innerRadius(const Box& box) {
    return 0.5 * box.size.minCoeff();
}

Bounds bounds(const Box& box, const Pose& pose) {
    const Vec3 extent = pose.orientation.toRotationMatrix().cwiseAbs() * (0.5 * box.size);
    return {pose.position - extent, pose.position + extent};
}

Vec3 farthest(const Box& box, const Vec3& direction) {
    return {std::copysign(0.5 * box.size.x(), direction.x()), std::copysign(0.5 * box.size.y(), direction.y()),
            std::copysign(0.5 * box.size.z(), direction.z())};
}

std::optional<LocalHit> surface(const Box& box, const LocalRay& ray) {
    const Vec3 half = 0.5 * box.size;
    if ((ray.origin.array().abs() <= half.array()).all()) return hitAtOnce(ray);
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    Eigen::Index entered = -1;
    for (Eigen::Index k = 0; k < 3; ++k) {
        const double d = ray.direction[k];
        if (d == 0) {
            if (std::abs(ray.origin[k]) > half[k]) return {};
            continue;
        }
        const double near = (-std::copysign(half[k], d) - ray.origin[k]) / d;
        leave = std::min(leave, (std::copysign(half[k], d) - ray.origin[k]) / d);
        if (near < 0 || (near <= enter && entered >= 0)) continue;
        enter = near;
        entered = k;
    }
    if (entered < 0 || enter > leave) return {};
    Vec3 normal = Vec3::Zero();
    normal[entered] = -std::copysign(1.0, ray.direction[entered]);
    return LocalHit{enter, normal};
}

constexpr ShapeEntry box_entry =
    finiteShapeEntry<Box, validate, massProperties, radius, innerRadius, bounds, surface, farthest>("box");

}  // namespace

const ShapeEntry& boxEntry() {
    return box_entry;
}

}  // namespace cairn
