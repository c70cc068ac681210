/// @file The bodies of a world as questions find them: a tree over their bounds, and one inside each large compound.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "body/body_storage.h"
#include "cairn/query.h"
#include "geometry/bounds_tree.h"
#include "queries/body_query.h"

namespace cairn {

/// Answers questions about bodies. Of equal hits the body with the lower id is first, then the lower part. Nothing that
/// it answers depends on how the tree is built.
class SpatialIndex {
  public:
    /// Follows the bodies to where they are.
    void update(const BodyStorage& bodies);

    /// The nearest hit. @param ray with a unit direction; so below
    std::optional<RayHit> castRay(const BodyStorage& bodies, const Ray& ray, const QueryFilter& filter) const;
    /// All hits, ordered by distance, body and part.
    std::vector<RayHit> castRayThrough(const BodyStorage& bodies, const Ray& ray, const QueryFilter& filter) const;
    /// @param direction unit @param reach [m], finite
    std::optional<BodyHit> castShape(const BodyStorage& bodies, const AskedShape& moving, const Vec3& direction,
                                     double reach, const QueryFilter& filter) const;
    /// Ordered by body and part.
    std::vector<Overlap> overlap(const BodyStorage& bodies, const AskedShape& asked, const QueryFilter& filter) const;
    /// Ordered by distance and body. @param reach [m]
    std::vector<NearBody> closestPoints(const BodyStorage& bodies, const AskedShape& asked, double reach,
                                        const QueryFilter& filter) const;
    /// A body as questions see it.
    Target target(const BodyStorage& bodies, BodyIndex body) const { return {bodies.shape[body], poses_[body]}; }

  private:
    bool listBodies(const BodyStorage& bodies);
    template <class Visit>
    void forEachAlong(const BodyStorage& bodies, const TreeRay& ray, const double& reach, const QueryFilter& filter,
                      const Visit& visit) const;
    template <class Visit>
    void forEachNear(const BodyStorage& bodies, const Bounds& box, const QueryFilter& filter, const Visit& visit) const;

    BoundsTree tree_;
    std::vector<BodyIndex> bounded_;      ///< the items of the tree
    std::vector<BodyIndex> unbounded_;    ///< always asked
    std::vector<Bounds> bounds_;          ///< of the items [W]
    std::vector<Pose> poses_;             ///< [slots] of the shapes
    std::vector<std::uint64_t> numbers_;  ///< [slots] of the bodies, plus 1
};

/// A spatial index that is brought up to date by the first question after a change, on any thread.
class CurrentIndex {
  public:
    /// @param version of the bodies' places and shapes, above 0 and higher after every change
    const SpatialIndex& at(std::uint64_t version, const BodyStorage& bodies) {
        if (version_.load(std::memory_order_acquire) == version) return index_;
        const std::scoped_lock lock(updating_);
        if (version_.load(std::memory_order_relaxed) != version) {
            index_.update(bodies);
            version_.store(version, std::memory_order_release);
        }
        return index_;
    }

    /// Begins anew with the next question: bodies of the same numbers may have other shapes.
    void forget() {
        index_ = {};
        version_ = 0;
    }

  private:
    std::atomic<std::uint64_t> version_ = 0;
    std::mutex updating_;
    SpatialIndex index_;
};

}  // namespace cairn
