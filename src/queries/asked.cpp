#include "queries/asked.h"

#include <fmt/core.h>

#include <cmath>

#include "geometry/geometry.h"

namespace cairn {

namespace {

void requirePoint(const Vec3& point, std::string_view what) {
    if (point.allFinite() && point.cwiseAbs().maxCoeff() <= query_limit) return;
    throw InputError(fmt::format("{} is ({}, {}, {}) m; every component must be finite and within ±{} m", what,
                                 point.x(), point.y(), point.z(), query_limit));
}

Vec3 requireDirection(const Vec3& direction, std::string_view what) {
    // Scaled first, so that the shortest vectors keep their direction and get unit length, too.
    if (direction.allFinite() && !direction.isZero(0)) {
        return (direction / direction.cwiseAbs().maxCoeff()).normalized();
    }
    throw InputError(fmt::format("{} is ({}, {}, {}); it must be finite and not zero", what, direction.x(),
                                 direction.y(), direction.z()));
}

}  // namespace

Ray checkedRay(const Ray& ray) {
    requirePoint(ray.origin, "the origin of a ray");
    requireReach(ray.reach, "the reach of a ray");
    return {ray.origin, requireDirection(ray.direction, "the direction of a ray"), ray.reach};
}

Ray checkedWay(const Vec3& way) {
    requirePoint(way, "the way of a shape");
    return {Vec3::Zero(), requireDirection(way, "the way of a shape"), way.stableNorm()};
}

Pose checkedPose(const Pose& pose) {
    requirePoint(pose.position, "the position of a shape");
    const double length = pose.orientation.coeffs().stableNorm();
    if (std::isfinite(length) && length > 1e-6) return {pose.position, pose.orientation.normalized()};
    throw InputError(
        fmt::format("the orientation of a shape has the length {}; a quaternion must be finite and not zero", length));
}

Shape checkedShape(const Shape& shape) {
    validateShape(shape);
    Shape result = shape;
    if (auto* compound = std::get_if<Compound>(&result)) {
        for (CompoundPart& part : compound->parts) part.pose.orientation.normalize();
        compound->tree.reset();  // for one question it pays to ask all parts
    }
    return result;
}

void requireReach(double reach, std::string_view what) {
    if (reach >= 0) return;
    throw InputError(fmt::format("{} is {} m; it must be 0 or more", what, reach));
}

}  // namespace cairn
