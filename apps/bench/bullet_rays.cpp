#include <BulletCollision/NarrowPhaseCollision/btConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <cmath>

#include "bullet_shapes.h"
#include "ray_casters.h"

namespace cairn::bench {

namespace {

/// Bodies that stand still in a world of Bullet's.
class BulletRays final : public RayCaster {
  public:
    /// @param flags how it searches: EFlags of btTriangleRaycastCallback
    BulletRays(const RigidScene& scene, std::span<const Pose> poses, unsigned flags)
        : flags_(flags), dispatcher_(&configuration_), world_(&dispatcher_, &broad_phase_, &configuration_) {
        for (std::size_t i = 0; i < scene.bodies().size(); ++i) {
            shapes_.push_back(std::visit(MakeBulletShape{}, scene.bodies()[i].shape));
            auto made = std::make_unique<btCollisionObject>();
            made->setCollisionShape(shapes_.back().get());
            made->setWorldTransform(btTransform(toBullet(poses[i].orientation), toBullet(poses[i].position)));
            made->setUserIndex(static_cast<int>(i));
            world_.addCollisionObject(made.get());
            bodies_.push_back(std::move(made));
        }
        // Its tree is made of what it was given one by one; with everything put in again a few times it is faster.
        // (Built anew at once, by optimize(), it writes beyond its memory.)
        broad_phase_.m_sets[0].optimizeIncremental(4 * static_cast<int>(bodies_.size()));
    }
    ~BulletRays() override {
        for (const auto& body : bodies_) world_.removeCollisionObject(body.get());
    }
    BulletRays(const BulletRays&) = delete;
    BulletRays& operator=(const BulletRays&) = delete;

    void cast(std::span<const Ray> rays, std::vector<std::optional<CastHit>>& hits) override {
        hits.clear();
        for (const Ray& ray : rays) {
            const Vec3 end = ray.origin + ray.reach * ray.direction.normalized();
            btCollisionWorld::ClosestRayResultCallback result(toBullet(ray.origin), toBullet(end));
            result.m_flags = flags_;
            world_.rayTest(result.m_rayFromWorld, result.m_rayToWorld, result);
            hits.emplace_back();
            if (!result.hasHit()) continue;
            hits.back() = CastHit{static_cast<std::size_t>(result.m_collisionObject->getUserIndex()),
                                  static_cast<double>(result.m_closestHitFraction) * ray.reach};
        }
    }

  private:
    unsigned flags_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btCollisionWorld world_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btCollisionObject>> bodies_;  ///< before the shapes they use are destroyed
};

RayCasterKind kindOf(const char* name, const char* search, unsigned flags, double tolerance) {
    RayCasterKind kind;
    kind.name = name;
    kind.settings = fmt::format("{}, {}, tree optimized, 1 thread", bulletVersion(), search);
    kind.tolerance = tolerance;
    kind.make = [flags](const RigidScene& scene, std::span<const Pose> poses) {
        return std::make_unique<BulletRays>(scene, poses, flags);
    };
    return kind;
}

}  // namespace

std::vector<RayCasterKind> bulletRayCasters() {
    using Flags = btTriangleRaycastCallback::EFlags;
    const double usual = std::sqrt(static_cast<double>(MAX_CONVEX_CAST_EPSILON));
    return {kindOf("bullet", "sub-simplex search (the usual one)", Flags::kF_None, usual),
            kindOf("bullet gjk", "search by conservative advancement", Flags::kF_UseGjkConvexCastRaytest, 1e-3)};
}

}  // namespace cairn::bench
