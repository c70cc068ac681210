#include "queries/spatial_index.h"

#include <algorithm>
#include <tuple>

namespace cairn {

namespace {

/// @param groups of the filter, as bits; 0 = all
bool isAsked(const BodyStorage& bodies, BodyIndex body, const QueryFilter& filter, std::uint64_t groups) {
    if (bodies.sensor[body] != 0) return false;
    if (groups != 0 && (bodies.groups[body] & groups) == 0) return false;
    return std::ranges::find(filter.except, bodies.idOf(body)) == filter.except.end();
}

auto order(const RayHit& hit) {
    return std::tuple(hit.distance, hit.body, hit.part);
}
auto order(const BodyHit& hit) {
    return std::tuple(hit.distance, hit.body, hit.part, hit.moving_part);
}

}  // namespace

/// Lists the bodies anew. @return whether they are the same as before
bool SpatialIndex::listBodies(const BodyStorage& bodies) {
    std::vector<BodyIndex> bounded;
    unbounded_.clear();
    bool same = numbers_.size() == bodies.slots();
    numbers_.resize(bodies.slots());
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (bodies.kind[i] == BodyKind::hole) continue;
        if (isInfinite(bodies.shape[i])) {
            unbounded_.push_back(i);
        } else {
            bounded.push_back(i);
        }
        // Numbers begin with 0.
        if (numbers_[i] == bodies.number[i] + 1) continue;
        same = false;
        numbers_[i] = bodies.number[i] + 1;
    }
    same = same && bounded == bounded_;
    bounded_ = std::move(bounded);
    return same;
}

void SpatialIndex::update(const BodyStorage& bodies) {
    const bool same = listBodies(bodies);
    poses_.resize(bodies.slots());
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (bodies.kind[i] != BodyKind::hole) poses_[i] = bodies.shapePose(i);
    }
    bounds_.resize(bounded_.size());
    for (std::size_t item = 0; item < bounded_.size(); ++item) {
        const BodyIndex i = bounded_[item];
        bounds_[item] = widened(boundsOf(bodies.shape[i], poses_[i]));
    }
    if (same) tree_.refit(bounds_);
    if (!same || tree_.isWorn()) tree_.build(bounds_);
}

template <class Visit>
void SpatialIndex::forEachAlong(const BodyStorage& bodies, const TreeRay& ray, const double& reach,
                                const QueryFilter& filter, const Visit& visit) const {
    const std::uint64_t groups = bodies.filter.maskOf(filter.groups);
    const auto ask = [&](BodyIndex body) {
        if (isAsked(bodies, body, filter, groups)) visit(body);
    };
    for (const BodyIndex body : unbounded_) ask(body);
    tree_.forEachAlong(ray, reach, [&](std::uint32_t item) { ask(bounded_[item]); });
}

template <class Visit>
void SpatialIndex::forEachNear(const BodyStorage& bodies, const Bounds& box, const QueryFilter& filter,
                               const Visit& visit) const {
    const std::uint64_t groups = bodies.filter.maskOf(filter.groups);
    const auto ask = [&](BodyIndex body) {
        if (isAsked(bodies, body, filter, groups)) visit(body);
    };
    for (const BodyIndex body : unbounded_) ask(body);
    tree_.forEachOverlapping(box, [&](std::uint32_t item) { ask(bounded_[item]); });
}

std::optional<RayHit> SpatialIndex::castRay(const BodyStorage& bodies, const Ray& ray,
                                            const QueryFilter& filter) const {
    std::optional<RayHit> best;
    Ray nearer = ray;
    forEachAlong(bodies, {ray.origin, ray.direction}, nearer.reach, filter, [&](BodyIndex body) {
        const std::optional<SurfaceHit> hit = castRayAt(target(bodies, body), nearer);
        if (!hit) return;
        const RayHit of_body{*hit, bodies.idOf(body)};
        if (best && order(*best) < order(of_body)) return;
        best = of_body;
        nearer.reach = hit->distance;
    });
    return best;
}

std::vector<RayHit> SpatialIndex::castRayThrough(const BodyStorage& bodies, const Ray& ray,
                                                 const QueryFilter& filter) const {
    std::vector<RayHit> hits;
    std::vector<SurfaceHit> of_body;
    forEachAlong(bodies, {ray.origin, ray.direction}, ray.reach, filter, [&](BodyIndex body) {
        of_body.clear();
        cairn::castRayThrough(target(bodies, body), ray, of_body);
        for (const SurfaceHit& hit : of_body) hits.push_back({hit, bodies.idOf(body)});
    });
    std::ranges::sort(hits, {}, [](const RayHit& hit) { return order(hit); });
    return hits;
}

std::optional<BodyHit> SpatialIndex::castShape(const BodyStorage& bodies, const AskedShape& moving,
                                               const Vec3& direction, double reach, const QueryFilter& filter) const {
    const Bounds begin = boundsOf(moving.shape, moving.pose);
    const Vec3 half = 0.5 * (begin.upper - begin.lower);
    std::optional<BodyHit> best;
    const TreeRay ray{begin.lower + half, direction, half + widened({-half, half}).upper - half};
    forEachAlong(bodies, ray, reach, filter, [&](BodyIndex body) {
        const std::optional<ShapeHit> hit = castShapeAt(moving, direction, reach, target(bodies, body));
        if (!hit) return;
        const BodyHit of_body{*hit, bodies.idOf(body)};
        if (best && order(*best) < order(of_body)) return;
        best = of_body;
        reach = hit->distance;
    });
    return best;
}

std::vector<Overlap> SpatialIndex::overlap(const BodyStorage& bodies, const AskedShape& asked,
                                           const QueryFilter& filter) const {
    std::vector<Overlap> found;
    std::vector<std::uint32_t> parts;
    forEachNear(bodies, widened(boundsOf(asked.shape, asked.pose)), filter, [&](BodyIndex body) {
        findOverlaps(asked, target(bodies, body), parts);
        for (const std::uint32_t part : parts) found.push_back({bodies.idOf(body), part});
    });
    std::ranges::sort(found, {}, [](const Overlap& o) { return std::tuple(o.body, o.part); });
    return found;
}

std::vector<NearBody> SpatialIndex::closestPoints(const BodyStorage& bodies, const AskedShape& asked, double reach,
                                                  const QueryFilter& filter) const {
    std::vector<NearBody> found;
    forEachNear(bodies, widened(boundsOf(asked.shape, asked.pose)).grown(reach), filter, [&](BodyIndex body) {
        const std::optional<ClosestPoints> closest = closestAt(asked, target(bodies, body), reach);
        if (closest) found.push_back({bodies.idOf(body), *closest});
    });
    std::ranges::sort(found, {}, [](const NearBody& n) { return std::tuple(n.closest.distance, n.body); });
    return found;
}

}  // namespace cairn
