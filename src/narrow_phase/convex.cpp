#include "narrow_phase/convex.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "geometry/hull_data.h"

namespace cairn {

namespace {

/// Largest cosine between the axis of a capsule and a direction that its whole side faces.
constexpr double lying_cosine = 0.1;

/// Smallest cosine between the axis of a cylinder and a direction that its cap faces.
constexpr double cap_cosine = std::numbers::sqrt2 / 2;

}  // namespace

Eigen::Vector2d rimDirection(int index) {
    constexpr double s = std::numbers::sqrt2 / 2;
    constexpr std::array<double, rim_corners> cosines = {1, s, 0, -s, -1, -s, 0, s};
    const auto i = static_cast<std::size_t>(index);
    return {cosines[i], cosines[(i + 6) % rim_corners]};
}

Convex::Convex(const Sphere& sphere, const Pose& pose, const Vec3& origin)
    : kind_(Kind::point), centre_(pose.position - origin), rounding_(sphere.radius), smallest_(sphere.radius) {}

Convex::Convex(const Box& box, const Pose& pose, const Vec3& origin)
    : kind_(Kind::box),
      axes_(pose.orientation.toRotationMatrix()),
      centre_(pose.position - origin),
      half_(0.5 * box.size),
      reach_(half_.norm()),
      smallest_(half_.minCoeff()) {}

Convex::Convex(const Capsule& capsule, const Pose& pose, const Vec3& origin)
    : kind_(Kind::line),
      axes_(pose.orientation.toRotationMatrix()),
      centre_(pose.position - origin),
      half_(0, 0, 0.5 * capsule.length),
      rounding_(capsule.radius),
      reach_(half_.z()),
      smallest_(capsule.radius) {}

Convex::Convex(const Cylinder& cylinder, const Pose& pose, const Vec3& origin)
    : kind_(Kind::cylinder),
      axes_(pose.orientation.toRotationMatrix()),
      centre_(pose.position - origin),
      half_(cylinder.radius, cylinder.radius, 0.5 * cylinder.length),
      reach_(std::hypot(half_.x(), half_.z())),
      smallest_(half_.minCoeff()) {}

Convex::Convex(const ConvexHull& hull, const Pose& pose, const Vec3& origin)
    : kind_(Kind::hull),
      axes_(pose.orientation.toRotationMatrix()),
      hull_(&hull.data()),
      hull_origin_(pose.position - origin),
      reach_(hull.data().radius),
      smallest_(hull.data().smallest) {
    centre_ = hull_origin_ + axes_ * hull_->mass.centre;
}

/// It has no extent of its own: what is small beside the other shape is not small beside a surface.
Convex::Convex(const ConvexTriangle& triangle)
    : kind_(Kind::triangle),
      centre_((triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3),
      triangle_(&triangle),
      smallest_(std::numeric_limits<double>::infinity()) {
    for (const Vec3& corner : triangle.corners) reach_ = std::max(reach_, (corner - centre_).norm());
}

Convex convexOf(const Shape& shape, const Pose& pose, const Vec3& origin) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return {*sphere, pose, origin};
    if (const auto* box = std::get_if<Box>(&shape)) return {*box, pose, origin};
    if (const auto* capsule = std::get_if<Capsule>(&shape)) return {*capsule, pose, origin};
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return {*cylinder, pose, origin};
    return {*std::get_if<ConvexHull>(&shape), pose, origin};
}

Vec3 Convex::support(const Vec3& direction) const {
    if (kind_ == Kind::point) return centre_;
    if (kind_ == Kind::triangle) {
        const auto& [a, b, c] = triangle_->corners;
        const double at_a = a.dot(direction);
        const double at_b = b.dot(direction);
        const double at_c = c.dot(direction);
        if (at_b > at_a) return at_c > at_b ? c : b;
        return at_c > at_a ? c : a;
    }
    const Vec3 d = axes_.transpose() * direction;
    if (kind_ == Kind::hull) {
        const std::vector<Vec3>& corners = hull_->corners;
        std::size_t best = 0;
        double farthest = corners[0].dot(d);
        for (std::size_t i = 1; i < corners.size(); ++i) {
            const double height = corners[i].dot(d);
            if (!(height > farthest)) continue;
            farthest = height;
            best = i;
        }
        return hull_origin_ + axes_ * corners[best];
    }
    Vec3 farthest(std::copysign(half_.x(), d.x()), std::copysign(half_.y(), d.y()), std::copysign(half_.z(), d.z()));
    if (kind_ == Kind::cylinder) {
        const double across = std::sqrt(d.x() * d.x() + d.y() * d.y());
        farthest.head<2>() =
            across > 0 ? Eigen::Vector2d(half_.x() / across * d.head<2>()) : Eigen::Vector2d(half_.x(), 0);
    }
    return centre_ + axes_ * farthest;
}

void Convex::findFeature(const Vec3& direction, Feature& feature) const {
    feature.corners.size = 0;
    feature.disc_radius = 0;
    switch (kind_) {
        case Kind::point:
            feature.corners.add(centre_);
            return;
        case Kind::box:
            return findBoxFace(direction, feature);
        case Kind::line:
            return findLine(direction, feature);
        case Kind::hull:
            return findHullFace(direction, feature);
        case Kind::triangle:
            return findTriangleFace(direction, feature);
        case Kind::cylinder:
            return findCylinderFeature(direction, feature);
    }
}

void Convex::findBoxFace(const Vec3& direction, Feature& feature) const {
    const Vec3 d = axes_.transpose() * direction;
    Eigen::Index k = 0;
    d.cwiseAbs().maxCoeff(&k);
    const Vec3 normal = std::copysign(1.0, d[k]) * axes_.col(k);
    const Vec3 middle = centre_ + half_[k] * normal;
    const Vec3 u = half_[(k + 1) % 3] * axes_.col((k + 1) % 3);
    // Counter-clockwise seen from outside.
    const Vec3 v = std::copysign(half_[(k + 2) % 3], d[k]) * axes_.col((k + 2) % 3);
    feature.corners.add(middle - u - v);
    feature.corners.add(middle + u - v);
    feature.corners.add(middle + u + v);
    feature.corners.add(middle - u + v);
    feature.face = {normal, normal.dot(middle)};
}

void Convex::findHullFace(const Vec3& direction, Feature& feature) const {
    const Vec3 d = axes_.transpose() * direction;
    const HullFace* best = &hull_->faces.front();
    double nearest = best->normal.dot(d);
    for (const HullFace& face : std::span(hull_->faces).subspan(1)) {
        const double cosine = face.normal.dot(d);
        if (!(cosine > nearest)) continue;
        nearest = cosine;
        best = &face;
    }
    const auto loop = hull_->loop(*best);
    const std::size_t count = std::min(loop.size(), most_face_corners);
    for (std::size_t i = 0; i < count; ++i) {
        feature.corners.add(hull_origin_ + axes_ * hull_->corners[loop[i * loop.size() / count]]);
    }
    const Vec3 normal = axes_ * best->normal;
    feature.face = {normal, normal.dot(hull_origin_) + best->offset};
}

/// Of the side that faces the direction.
void Convex::findTriangleFace(const Vec3& direction, Feature& feature) const {
    const auto& [a, b, c] = triangle_->corners;
    const bool front = triangle_->normal.dot(direction) >= 0;
    feature.corners.add(a);
    feature.corners.add(front ? b : c);
    feature.corners.add(front ? c : b);
    const Vec3 normal = front ? triangle_->normal : Vec3(-triangle_->normal);
    feature.face = {normal, normal.dot(a)};
}

void Convex::findLine(const Vec3& direction, Feature& feature) const {
    const Vec3 half = half_.z() * axes_.col(2);
    const double cosine = axes_.col(2).dot(direction);
    if (cosine >= -lying_cosine) feature.corners.add(centre_ + half);
    if (cosine <= lying_cosine) feature.corners.add(centre_ - half);
}

void Convex::findCylinderFeature(const Vec3& direction, Feature& feature) const {
    const double cosine = axes_.col(2).dot(direction);
    if (std::abs(cosine) > cap_cosine) return addCap(direction, std::copysign(1.0, cosine), feature);
    const Vec3 across = half_.x() * (direction - cosine * axes_.col(2)).normalized();
    const Vec3 half = half_.z() * axes_.col(2);
    feature.corners.add(centre_ + across + half);
    feature.corners.add(centre_ + across - half);
}

void Convex::addCap(const Vec3& direction, double end, Feature& feature) const {
    const double radius = half_.x();
    const Vec3 normal = end * axes_.col(2);
    feature.disc_radius = radius;
    feature.disc_centre = centre_ + half_.z() * normal;
    feature.face = {normal, normal.dot(feature.disc_centre)};
    const Eigen::Vector2d d = (axes_.transpose() * direction).head<2>();
    const double tilt = d.norm();
    const bool tilted = (1 - std::cos(std::numbers::pi / rim_corners)) * tilt > rim_part;
    const Eigen::Vector2d lowest = tilted ? Eigen::Vector2d(d / tilt) : Eigen::Vector2d::Zero();
    const auto add = [&](const Eigen::Vector2d& at) {
        feature.corners.add(feature.disc_centre + radius * (axes_.leftCols<2>() * at));
    };
    bool lowest_added = !tilted;
    for (int i = 0; i < rim_corners; ++i) {
        // Counter-clockwise seen from outside.
        const int index = end > 0 ? i : rim_corners - 1 - i;
        const Eigen::Vector2d at = rimDirection(index);
        const double turn = end * (at.x() * lowest.y() - at.y() * lowest.x());
        if (!tilted || (at - lowest).norm() > rim_spacing) add(at);
        // The lowest point lies between this corner and the next, or on one of them.
        const double ahead = at.dot(lowest);
        if (!lowest_added && turn >= 0 && ahead >= std::cos(2 * std::numbers::pi / rim_corners) - 1e-9) {
            add(lowest);
            lowest_added = true;
        }
    }
}

}  // namespace cairn
