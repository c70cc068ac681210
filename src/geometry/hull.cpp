#include <utility>

#include "geometry/hull_data.h"
#include "geometry/shape_entry.h"

namespace cairn {

namespace {

/// It was validated when it was built.
void validate(const ConvexHull&) {}

UnitMassProperties massProperties(const ConvexHull& hull) {
    return hull.data().mass;
}

double radius(const ConvexHull& hull) {
    return hull.data().radius;
}

double innerRadius(const ConvexHull& hull) {
    return hull.data().smallest;
}

Bounds bounds(const ConvexHull& hull, const Pose& pose) {
    const Mat3 axes = pose.orientation.toRotationMatrix();
    Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 upper = -lower;
    for (const Vec3& corner : hull.data().corners) {
        const Vec3 p = axes * corner;
        lower = lower.cwiseMin(p);
        upper = upper.cwiseMax(p);
    }
    return {pose.position + lower, pose.position + upper};
}

Vec3 farthest(const ConvexHull& hull, const Vec3& direction) {
    const Vec3 unit = direction.stableNormalized();
    const std::vector<Vec3>& corners = hull.data().corners;
    std::size_t best = 0;
    for (std::size_t i = 1; i < corners.size(); ++i) {
        if (corners[i].dot(unit) > corners[best].dot(unit)) best = i;
    }
    return corners[best];
}

std::optional<LocalHit> surface(const ConvexHull& hull, const LocalRay& ray) {
    double enter = -std::numeric_limits<double>::infinity();
    double leave = std::numeric_limits<double>::infinity();
    const HullFace* entered = nullptr;
    bool is_inside = true;
    for (const HullFace& face : hull.data().faces) {
        const double height = face.normal.dot(ray.origin) - face.offset;
        const double climb = face.normal.dot(ray.direction);
        is_inside = is_inside && height <= 0;
        if (climb == 0) {
            if (height > 0) return {};
        } else if (climb > 0) {
            leave = std::min(leave, -height / climb);
        } else if (-height / climb > enter) {
            enter = -height / climb;
            entered = &face;
        }
    }
    if (is_inside) return hitAtOnce(ray);
    if (entered == nullptr || enter > leave || enter < 0) return {};
    return LocalHit{enter, entered->normal};
}

constexpr ShapeEntry hull_entry =
    finiteShapeEntry<ConvexHull, validate, massProperties, radius, innerRadius, bounds, surface, farthest>("hull");

}  // namespace

ConvexHull::ConvexHull(std::vector<Vec3> points)
    : data_(std::make_shared<const HullData>(buildHull(std::move(points)))) {}

std::span<const Vec3> ConvexHull::points() const {
    return data_->points;
}

std::span<const Vec3> ConvexHull::corners() const {
    return data_->corners;
}

const ShapeEntry& hullEntry() {
    return hull_entry;
}

}  // namespace cairn
