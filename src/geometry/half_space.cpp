#include "geometry/half_space.h"

#include <fmt/core.h>

#include <cmath>

#include "geometry/shape_entry.h"

namespace cairn {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void validate(const HalfSpace& half_space) {
    const Vec3& n = half_space.normal;
    if (!n.allFinite() || !(n.cwiseAbs().maxCoeff() > 0)) {
        throw InputError(
            fmt::format("the normal of a plane is ({}, {}, {}); it must be finite and not zero", n.x(), n.y(), n.z()));
    }
    if (!(std::abs(half_space.offset) <= largest_dimension)) {
        throw InputError(fmt::format("the offset of a plane is {}; it must be finite and between -{} and {} m",
                                     half_space.offset, largest_dimension, largest_dimension));
    }
}

UnitMassProperties massProperties(const HalfSpace&) {
    return {infinity, Vec3::Constant(infinity)};
}

double radius(const HalfSpace&) {
    return infinity;
}

/// Only a plane that is exactly parallel to two axes bounds anything; it keeps bodies far above a floor out of its
/// pairs.
double innerRadius(const HalfSpace&) {
    return std::numeric_limits<double>::infinity();
}

Bounds bounds(const HalfSpace& half_space, const Pose& pose) {
    Bounds result;
    const Vec3 n = pose.orientation * unitNormal(half_space);
    Eigen::Index axis = 0;
    n.cwiseAbs().maxCoeff(&axis);
    if (n[(axis + 1) % 3] != 0 || n[(axis + 2) % 3] != 0) return result;
    const double surface = n.dot(pose.position) + half_space.offset;
    if (n[axis] > 0) {
        result.upper[axis] = surface;
    } else {
        result.lower[axis] = -surface;
    }
    return result;
}

std::optional<LocalHit> surface(const HalfSpace& half_space, const LocalRay& ray) {
    const Vec3 normal = unitNormal(half_space);
    const double height = normal.dot(ray.origin) - half_space.offset;
    if (height <= 0) return hitAtOnce(ray);
    const double fall = -normal.dot(ray.direction);
    if (!(fall > 0)) return {};
    return LocalHit{height / fall, normal};
}

constexpr ShapeEntry half_space_entry =
    infiniteShapeEntry<HalfSpace, validate, massProperties, radius, innerRadius, bounds, surface>("plane");

}  // namespace

const ShapeEntry& halfSpaceEntry() {
    return half_space_entry;
}

Vec3 unitNormal(const HalfSpace& half_space) {
    const double squared = half_space.normal.squaredNorm();
    if (squared > 1e-200 && squared < 1e200) return half_space.normal / std::sqrt(squared);
    return half_space.normal.stableNormalized();  // the square leaves the range of double
}

}  // namespace cairn
