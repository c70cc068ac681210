#include <cmath>

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

constexpr ShapeEntry box_entry =
    finiteShapeEntry<Box, validate, massProperties, radius, innerRadius, bounds, farthest>("box");

}  // namespace

const ShapeEntry& boxEntry() {
    return box_entry;
}

}  // namespace cairn
