/// @file Whether a point is in a shape, told without anything of the engine but the shape's own numbers.
#pragma once

#include <algorithm>
#include <cmath>

#include "cairn/shape.h"
#include "geometry/hull_data.h"
#include "narrow_phase/pair_random.h"

namespace cairn::testing {

/// How deep a point is in a shape, as a function that is positive inside, negative outside and has no flat places.
/// @param p [m, frame of the shape] @pre no compound
inline double depthIn(const Shape& shape, const Vec3& p) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius - p.norm();
    if (const auto* box = std::get_if<Box>(&shape)) return (0.5 * box->size - p.cwiseAbs()).minCoeff();
    if (const auto* capsule = std::get_if<Capsule>(&shape)) {
        const double z = std::clamp(p.z(), -0.5 * capsule->length, 0.5 * capsule->length);
        return capsule->radius - (p - Vec3(0, 0, z)).norm();
    }
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        return std::min(cylinder->radius - p.head<2>().norm(), 0.5 * cylinder->length - std::abs(p.z()));
    }
    if (const auto* half = std::get_if<HalfSpace>(&shape)) return half->offset - half->normal.normalized().dot(p);
    double least = std::numeric_limits<double>::infinity();
    for (const HullFace& face : std::get_if<ConvexHull>(&shape)->data().faces) {
        least = std::min(least, face.offset - face.normal.dot(p));
    }
    return least;
}

/// Any shape without parts that has an end, hulls as well.
inline Shape anySolid(Random& random, double size) {
    if (random.below(4) != 0) return random.solid(size);
    std::vector<Vec3> points;
    for (int i = 0; i < 12; ++i) points.push_back(random.vector(0.5 * size));
    return ConvexHull(points);
}

/// Some parts that may overlap.
inline Compound anyCompound(Random& random, int parts, double size) {
    Compound compound;
    for (int i = 0; i < parts; ++i) {
        compound.parts.push_back({anySolid(random, 0.4 * size), {random.vector(0.5 * size), random.orientation()}});
    }
    return compound;
}

}  // namespace cairn::testing
