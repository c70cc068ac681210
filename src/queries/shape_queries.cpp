/// The questions about shapes that need no world.
#include <fmt/core.h>

#include <algorithm>

#include "cairn/query.h"
#include "narrow_phase/narrow_phase.h"
#include "queries/asked.h"
#include "queries/body_query.h"
#include "queries/shape_pair.h"

namespace cairn {

std::optional<SurfaceHit> castRay(const Shape& shape, const Pose& pose, const Ray& ray) {
    const Shape asked = checkedShape(shape);
    return castRayAt({asked, checkedPose(pose), nullptr}, checkedRay(ray));
}

std::optional<ShapeHit> castShape(const Shape& moving, const Pose& pose, const Vec3& way, const Shape& other,
                                  const Pose& other_pose) {
    const Shape asked = checkedShape(moving);
    const Shape met = checkedShape(other);
    const Ray path = checkedWay(way);
    requireBounded(asked);
    return castShapeAt({asked, checkedPose(pose)}, path.direction, path.reach, {met, checkedPose(other_pose), nullptr});
}

bool overlap(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
    const Shape asked = checkedShape(a);
    const Shape met = checkedShape(b);
    std::vector<std::uint32_t> parts;
    findOverlaps({asked, checkedPose(pose_a)}, {met, checkedPose(pose_b), nullptr}, parts);
    return !parts.empty();
}

ClosestPoints closestPoints(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
    const Shape asked = checkedShape(a);
    const Shape met = checkedShape(b);
    requireClosest(asked, met);
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    return closestAt({asked, checkedPose(pose_a)}, {met, checkedPose(pose_b), nullptr}, everywhere).value();
}

std::vector<ShapeContact> contactsOf(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                     double margin) {
    const Shape shape_a = checkedShape(a);
    const Shape shape_b = checkedShape(b);
    const Pose at_a = checkedPose(pose_a);
    const Pose at_b = checkedPose(pose_b);
    requireReach(margin, "the margin of contacts");
    std::vector<ShapeContact> contacts;
    Manifold manifold;
    for (std::uint32_t i = 0; i < partCount(shape_a); ++i) {
        const Placed part_a = placedPart(shape_a, at_a, i);
        const Bounds bounds = boundsOf(part_a.shape, part_a.pose).grown(margin);
        for (std::uint32_t k = 0; k < partCount(shape_b); ++k) {
            const Placed part_b = placedPart(shape_b, at_b, k);
            if (!bounds.overlaps(boundsOf(part_b.shape, part_b.pose))) continue;
            collide(part_a.shape, part_a.pose, part_b.shape, part_b.pose, margin, manifold);
            for (std::size_t p = 0; p < manifold.size; ++p) {
                contacts.push_back({manifold.points[p].point, manifold.normal, manifold.points[p].distance, i, k});
            }
        }
    }
    return contacts;
}

}  // namespace cairn
