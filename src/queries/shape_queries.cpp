/// The questions about shapes that need no world.
#include <fmt/core.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "cairn/query.h"
#include "narrow_phase/narrow_phase.h"
#include "queries/asked.h"
#include "queries/body_query.h"
#include "queries/shape_pair.h"

namespace cairn {

std::optional<SurfaceHit> castRay(const Shape& shape, const Pose& pose, const Ray& ray) {
    const Shape asked = checkedShape(shape);
    return castRayAt({asked, checkedPose(pose)}, checkedRay(ray));
}

std::optional<ShapeHit> castShape(const Shape& moving, const Pose& pose, const Vec3& way, const Shape& other,
                                  const Pose& other_pose) {
    const Shape asked = checkedShape(moving);
    const Shape met = checkedShape(other);
    const Ray path = checkedWay(way);
    requireBounded(asked);
    return castShapeAt({asked, checkedPose(pose)}, path.direction, path.reach, {met, checkedPose(other_pose)});
}

bool overlap(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
    const Shape asked = checkedShape(a);
    const Shape met = checkedShape(b);
    std::vector<std::uint32_t> parts;
    findOverlaps({asked, checkedPose(pose_a)}, {met, checkedPose(pose_b)}, parts);
    return !parts.empty();
}

ClosestPoints closestPoints(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
    const Shape asked = checkedShape(a);
    const Shape met = checkedShape(b);
    requireClosest(asked, met);
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    return closestAt({asked, checkedPose(pose_a)}, {met, checkedPose(pose_b)}, everywhere).value();
}

namespace {

struct PosedSurface {
    const SurfaceData& surface;
    Pose pose;
};

/// Of all parts of a solid shape, which is A.
void addSurfaceContacts(const AskedShape& asked, const PosedSurface& other, double margin,
                        std::vector<ShapeContact>& contacts) {
    for (std::uint32_t i = 0; i < partCount(asked.shape); ++i) {
        const Placed part = placedPart(asked.shape, asked.pose, i);
        collideSurface({part.shape, part.pose, other.surface, other.pose}, margin, [&](const Manifold& found) {
            for (std::size_t p = 0; p < found.size; ++p) {
                const ManifoldPoint& point = found.points[p];
                contacts.push_back({point.point, found.normal, point.distance, i, point.triangle});
            }
        });
    }
}

void swapShapes(std::vector<ShapeContact>& contacts) {
    for (ShapeContact& contact : contacts) {
        contact.normal = -contact.normal;
        std::swap(contact.part_a, contact.part_b);
    }
}

}  // namespace

std::vector<ShapeContact> contactsOf(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                     double margin) {
    const Shape shape_a = checkedShape(a);
    const Shape shape_b = checkedShape(b);
    const Pose at_a = checkedPose(pose_a);
    const Pose at_b = checkedPose(pose_b);
    requireReach(margin, "the margin of contacts");
    std::vector<ShapeContact> contacts;
    const SurfaceData* surface_a = surfaceOf(shape_a);
    const SurfaceData* surface_b = surfaceOf(shape_b);
    if (surface_a != nullptr || surface_b != nullptr) {
        if (isSolid(shape_a)) addSurfaceContacts({shape_a, at_a}, {*surface_b, at_b}, margin, contacts);
        if (isSolid(shape_b)) addSurfaceContacts({shape_b, at_b}, {*surface_a, at_a}, margin, contacts);
        if (surface_a != nullptr) swapShapes(contacts);
        std::ranges::stable_sort(contacts, {}, [](const ShapeContact& c) { return std::tuple(c.part_a, c.part_b); });
        return contacts;
    }
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
