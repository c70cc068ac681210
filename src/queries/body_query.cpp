#include "queries/body_query.h"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

#include "geometry/surface_data.h"
#include "queries/shape_pair.h"

namespace cairn {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Over the parts of a compound; null = ask all.
const BoundsTree* treeOf(const Shape& shape) {
    const auto* compound = std::get_if<Compound>(&shape);
    return compound != nullptr ? compound->tree.get() : nullptr;
}

/// Calls visit(part) for the parts of a target whose bounds overlap a box of W.
template <class Visit>
void forEachPart(const Target& target, const Bounds& box, const Visit& visit) {
    const SurfaceData* surface = surfaceOf(target.shape);
    const auto* compound = std::get_if<Compound>(&target.shape);
    if (compound == nullptr && surface == nullptr) return visit(std::uint32_t{0});
    const BoundsTree* tree = surface != nullptr ? &surface->tree : treeOf(target.shape);
    if (tree != nullptr && box.lower.allFinite() && box.upper.allFinite()) {
        // The box turned into the frame of the compound, in bounds of its own.
        const Vec3 half = 0.5 * (box.upper - box.lower);
        const Vec3 centre = target.pose.toInner(box.lower + half);
        const Vec3 extent = target.pose.orientation.conjugate().toRotationMatrix().cwiseAbs() * half;
        return tree->forEachOverlapping(widened({centre - extent, centre + extent}), visit);
    }
    for (std::uint32_t i = 0; i < partCount(target.shape); ++i) visit(i);
}

/// The ray in the frame of a target.
LocalRay localRay(const Target& target, const Ray& ray) {
    return {target.pose.toInner(ray.origin), target.pose.orientation.conjugate() * ray.direction};
}

SurfaceHit outerHit(const Target& target, const Ray& ray, const LocalHit& hit) {
    return {hit.distance, ray.origin + hit.distance * ray.direction, target.pose.orientation * hit.normal, hit.part};
}

/// Of a part, with its index.
std::optional<LocalHit> hitOfPart(const Compound& compound, std::uint32_t part, const LocalRay& ray) {
    std::optional<LocalHit> hit = castRay(compound.parts[part], ray);
    if (hit) hit->part = part;
    return hit;
}

auto order(const ShapeHit& hit) {
    return std::tuple(hit.distance, hit.part, hit.moving_part);
}
auto order(const ClosestPoints& found) {
    return std::tuple(found.distance, found.part_b, found.part_a);
}

/// How far two boxes are apart at least [m].
double gapOf(const Bounds& a, const Bounds& b) {
    const Vec3 apart = (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(0.0);
    return apart.stableNorm();
}

/// Bounds of a shape on its whole way.
Bounds sweptBounds(const AskedShape& moving, const Vec3& direction, double reach) {
    const Bounds begin = boundsOf(moving.shape, moving.pose);
    const Vec3 way = reach * direction;
    return widened({begin.lower.cwiseMin(begin.lower + way), begin.upper.cwiseMax(begin.upper + way)});
}

}  // namespace

std::optional<SurfaceHit> castRayAt(const Target& target, const Ray& ray) {
    const LocalRay local = localRay(target, ray);
    std::optional<LocalHit> best;
    if (const SurfaceData* surface = surfaceOf(target.shape)) {
        best = castRay(*surface, local, ray.reach);
    } else if (treeOf(target.shape) == nullptr) {
        best = castRay(target.shape, local);
        if (best && best->distance > ray.reach) best.reset();
    } else {
        const auto& compound = *std::get_if<Compound>(&target.shape);
        double reach = ray.reach;
        compound.tree->forEachAlong({local.origin, local.direction}, reach, [&](std::uint32_t part) {
            const std::optional<LocalHit> hit = hitOfPart(compound, part, local);
            if (!hit || hit->distance > reach) return;
            if (best && std::tuple(best->distance, best->part) < std::tuple(hit->distance, part)) return;
            best = hit;
            reach = hit->distance;
        });
    }
    if (!best) return {};
    return outerHit(target, ray, *best);
}

void castRayThrough(const Target& target, const Ray& ray, std::vector<SurfaceHit>& hits) {
    const LocalRay local = localRay(target, ray);
    if (const SurfaceData* surface = surfaceOf(target.shape)) {
        surface->tree.forEachAlong({local.origin, local.direction}, ray.reach, [&](std::uint32_t triangle) {
            const std::optional<LocalHit> hit = castRayAt(*surface, triangle, local);
            if (hit && hit->distance <= ray.reach) hits.push_back(outerHit(target, ray, *hit));
        });
        return;
    }
    const auto* compound = std::get_if<Compound>(&target.shape);
    if (compound == nullptr) {
        if (const auto hit = castRayAt(target, ray)) hits.push_back(*hit);
        return;
    }
    for (std::uint32_t part = 0; part < compound->parts.size(); ++part) {
        const std::optional<LocalHit> hit = hitOfPart(*compound, part, local);
        if (hit && hit->distance <= ray.reach) hits.push_back(outerHit(target, ray, *hit));
    }
}

std::optional<ShapeHit> castShapeAt(const AskedShape& moving, const Vec3& direction, double reach,
                                    const Target& target) {
    std::optional<ShapeHit> best;
    for (std::uint32_t i = 0; i < partCount(moving.shape); ++i) {
        const Placed part = placedPart(moving.shape, moving.pose, i);
        forEachPart(target, sweptBounds({part.shape, part.pose}, direction, reach), [&](std::uint32_t k) {
            std::optional<ShapeHit> hit = castPart(part, direction, reach, placedPart(target.shape, target.pose, k));
            if (!hit) return;
            hit->moving_part = i;
            hit->part = k;
            if (!best || order(*hit) < order(*best)) best = hit;
            reach = std::min(reach, best->distance);
        });
    }
    return best;
}

void findOverlaps(const AskedShape& asked, const Target& target, std::vector<std::uint32_t>& parts) {
    parts.clear();
    for (std::uint32_t i = 0; i < partCount(asked.shape); ++i) {
        const Placed part = placedPart(asked.shape, asked.pose, i);
        const Bounds bounds = widened(boundsOf(part));
        forEachPart(target, bounds, [&](std::uint32_t k) {
            const Placed other = placedPart(target.shape, target.pose, k);
            if (!bounds.overlaps(widened(boundsOf(other)))) return;
            if (closestOfParts(part, other, 0)) parts.push_back(k);
        });
    }
    std::ranges::sort(parts);
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
}

std::optional<ClosestPoints> closestAt(const AskedShape& asked, const Target& target, double limit) {
    std::optional<ClosestPoints> best;
    for (std::uint32_t i = 0; i < partCount(asked.shape); ++i) {
        const Placed part = placedPart(asked.shape, asked.pose, i);
        const Bounds bounds = widened(boundsOf(part));
        forEachPart(target, bounds.grown(limit), [&](std::uint32_t k) {
            const Placed other = placedPart(target.shape, target.pose, k);
            const double farthest = best ? std::max(best->distance, 0.0) : limit;
            if (gapOf(bounds, widened(boundsOf(other))) > farthest) return;
            std::optional<ClosestPoints> found = closestOfParts(part, other, farthest);
            if (!found) return;
            found->part_a = i;
            found->part_b = k;
            if (!best || order(*found) < order(*best)) best = found;
        });
    }
    return best;
}

void requireBounded(const Shape& moving) {
    if (isSolid(moving)) return;
    throw InputError(fmt::format("a {} {} and cannot move; cast another shape", shapeName(moving),
                                 isInfinite(moving) ? "has no bounds" : "is a surface"));
}

void requireClosest(const Shape& a, const Shape& b) {
    if (isSolid(a) || isSolid(b)) return;
    throw InputError(fmt::format("a {} and a {} have no closest points; at least one shape must be solid", shapeName(a),
                                 shapeName(b)));
}

}  // namespace cairn
