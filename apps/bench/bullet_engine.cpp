#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <algorithm>

#include "bullet_shapes.h"
#include "engine.h"

namespace cairn::bench {

namespace {

/// What the callbacks of the pair properties find at a collision object.
const RigidScene& sceneOf(const btCollisionObject& object) {
    return *static_cast<const RigidScene*>(object.getUserPointer());
}

const PairProperties& pairOf(const btCollisionObject* a, const btCollisionObject* b) {
    return sceneOf(*a).pair(static_cast<std::size_t>(a->getUserIndex()), static_cast<std::size_t>(b->getUserIndex()));
}

btScalar restitutionOf(const btCollisionObject* a, const btCollisionObject* b) {
    return static_cast<btScalar>(pairOf(a, b).restitution);
}

btScalar frictionOf(const btCollisionObject* a, const btCollisionObject* b) {
    return static_cast<btScalar>(pairOf(a, b).kinetic_friction);
}

class BulletEngine final : public Engine {
  public:
    BulletEngine(const RigidScene& scene, const EngineOptions& options)
        : scene_(scene),
          time_step_(1 / options.steps_per_second),
          dispatcher_(&configuration_),
          world_(&dispatcher_, &broad_phase_, &solver_, &configuration_) {
        // Bullet multiplies the coefficients of bodies; pairs of materials need these callbacks of its.
        gCalculateCombinedRestitutionCallback = restitutionOf;
        gCalculateCombinedFrictionCallback = frictionOf;
        // A new world has a gravity of its own.
        world_.setGravity(toBullet(gravity_));
        setGravity(scene_.gravityAt(0, time_step_));
        for (const RigidBody& body : scene_.bodies()) add(body, options);
    }
    ~BulletEngine() override {
        for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    }
    BulletEngine(const BulletEngine&) = delete;
    BulletEngine& operator=(const BulletEngine&) = delete;

    void step() override {
        setGravity(scene_.gravityAt(static_cast<double>(steps_) * time_step_, time_step_));
        world_.stepSimulation(static_cast<btScalar>(time_step_), 0);
        ++steps_;
    }

    void poses(std::vector<Pose>& poses) const override {
        poses.resize(bodies_.size());
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const btTransform& transform = bodies_[i]->getWorldTransform();
            const btQuaternion q = transform.getRotation();
            poses[i] = {fromBullet(transform.getOrigin()), Quat(q.w(), q.x(), q.y(), q.z()).normalized()};
        }
    }

    std::size_t asleep() const override {
        return static_cast<std::size_t>(std::count_if(bodies_.begin(), bodies_.end(), [](const auto& body) {
            return !body->isStaticObject() && !body->isActive();
        }));
    }

  private:
    void setGravity(const Vec3& gravity) {
        if (gravity == gravity_) return;
        gravity_ = gravity;
        for (const auto& body : bodies_) {
            if (!body->isStaticObject()) body->activate(true);
        }
        world_.setGravity(toBullet(gravity));
    }

    void add(const RigidBody& body, const EngineOptions& options) {
        shapes_.push_back(std::visit(MakeBulletShape{}, body.shape));
        btRigidBody::btRigidBodyConstructionInfo info(
            body.fixed ? 0 : static_cast<btScalar>(body.mass), nullptr, shapes_.back().get(),
            body.fixed ? btVector3(0, 0, 0) : toBullet(body.principal_inertia));
        info.m_startWorldTransform = btTransform(toBullet(body.pose.orientation), toBullet(body.pose.position));
        auto made = std::make_unique<btRigidBody>(info);
        made->setUserPointer(const_cast<RigidScene*>(&scene_));
        made->setUserIndex(static_cast<int>(body.material));
        if (!body.fixed) {
            made->setLinearVelocity(toBullet(body.linear_velocity));
            made->setAngularVelocity(toBullet(body.angular_velocity));
            if (!options.sleeping) made->setActivationState(DISABLE_DEACTIVATION);
        }
        world_.addRigidBody(made.get());
        bodies_.push_back(std::move(made));
    }

    const RigidScene& scene_;
    double time_step_;
    std::int64_t steps_ = 0;
    Vec3 gravity_ = Vec3::Zero();
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;  ///< before the shapes they use are destroyed
};

}  // namespace

EngineKind bulletEngine() {
    EngineKind kind;
    kind.name = "bullet";
    kind.version = bulletVersion();
    const btContactSolverInfo solver;
    kind.settings = fmt::format(
        "btDiscreteDynamicsWorld, sequential impulses, {} iterations, split impulse {}, erp2 {:.2g}, warm starting "
        "{:.2g}, "
        "restitution from {:.2g} m/s on, margins within the full edge lengths (a tenth of the half edge), thresholds "
        "of "
        "sleep as they are (0.8 m/s, 1 rad/s, {:.2g} s), 1 thread",
        solver.m_numIterations, solver.m_splitImpulse != 0 ? "on" : "off", solver.m_erp2, solver.m_warmstartingFactor,
        solver.m_restitutionVelocityThreshold, gDeactivationTime);
    kind.make = [](const Scene&, const RigidScene& scene, const EngineOptions& options) {
        return std::make_unique<BulletEngine>(scene, options);
    };
    return kind;
}

}  // namespace cairn::bench
