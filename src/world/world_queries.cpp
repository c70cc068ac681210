/// The part of World that answers questions about where its bodies are.
#include "cairn/world.h"
#include "queries/asked.h"
#include "world/division.h"
#include "world/world_state.h"

namespace cairn {

namespace {

/// Fewest rays worth a thread of their own.
constexpr std::size_t ray_grain = 64;

const SpatialIndex& indexOf(WorldState& world) {
    return world.index.at(world.places_version, world.bodies);
}

}  // namespace

std::optional<RayHit> World::castRay(const Ray& ray, const QueryFilter& filter) const {
    requireWhole(*state_, "World::castRay");
    return indexOf(*state_).castRay(state_->bodies, checkedRay(ray), filter);
}

std::vector<RayHit> World::castRayThrough(const Ray& ray, const QueryFilter& filter) const {
    requireWhole(*state_, "World::castRayThrough");
    return indexOf(*state_).castRayThrough(state_->bodies, checkedRay(ray), filter);
}

std::vector<std::optional<RayHit>> World::castRays(std::span<const Ray> rays, const QueryFilter& filter) const {
    requireWhole(*state_, "World::castRays");
    const SpatialIndex& index = indexOf(*state_);
    std::vector<std::optional<RayHit>> hits(rays.size());
    const auto cast = [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            hits[i] = index.castRay(state_->bodies, checkedRay(rays[i]), filter);
        }
    };
    // The world's threads serve one caller at a time; others cast their rays themselves.
    const std::unique_lock threads(state_->asking, std::try_to_lock);
    if (threads.owns_lock()) {
        state_->executor.forBlocks(rays.size(), cast, ray_grain);
    } else {
        cast(0, rays.size(), 0);
    }
    return hits;
}

std::optional<BodyHit> World::castShape(const Shape& shape, const Pose& pose, const Vec3& way,
                                        const QueryFilter& filter) const {
    requireWhole(*state_, "World::castShape");
    const Shape asked = checkedShape(shape);
    requireBounded(asked);
    const Ray path = checkedWay(way);
    return indexOf(*state_).castShape(state_->bodies, {asked, checkedPose(pose)}, path.direction, path.reach, filter);
}

std::vector<Overlap> World::overlap(const Shape& shape, const Pose& pose, const QueryFilter& filter) const {
    requireWhole(*state_, "World::overlap");
    const Shape asked = checkedShape(shape);
    return indexOf(*state_).overlap(state_->bodies, {asked, checkedPose(pose)}, filter);
}

std::vector<Overlap> World::overlap(const Vec3& lower, const Vec3& upper, const QueryFilter& filter) const {
    requireWhole(*state_, "World::overlap");
    return overlap(Box{upper - lower}, {lower + 0.5 * (upper - lower), Quat::Identity()}, filter);
}

std::vector<NearBody> World::closestPoints(const Shape& shape, const Pose& pose, double reach,
                                           const QueryFilter& filter) const {
    requireWhole(*state_, "World::closestPoints");
    const Shape asked = checkedShape(shape);
    requireReach(reach, "the reach of closest points");
    return indexOf(*state_).closestPoints(state_->bodies, {asked, checkedPose(pose)}, reach, filter);
}

ClosestPoints World::closestPoints(BodyId a, BodyId b) const {
    requireWhole(*state_, "World::closestPoints");
    const BodyIndex i = state_->bodies.indexOf(a);
    const BodyIndex k = state_->bodies.indexOf(b);
    const SpatialIndex& index = indexOf(*state_);
    const Target target_a = index.target(state_->bodies, i);
    requireClosest(target_a.shape, state_->bodies.shape[k]);
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    return closestAt({target_a.shape, target_a.pose}, index.target(state_->bodies, k), everywhere).value();
}

}  // namespace cairn
