#include <fmt/format.h>
#include <ode/ode.h>

#include <algorithm>
#include <array>

#include "engine.h"

namespace cairn::bench {

namespace {

constexpr int iterations = 20;
constexpr int most_contacts = 8;         ///< of a pair
constexpr double bounce_speed = 0.0458;  ///< as Cairn's restitution threshold at 240 steps per second [m/s]

/// The library's own state.
class Library {
  public:
    Library() { dInitODE2(0); }
    ~Library() { dCloseODE(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

/// Makes a geometry; half-spaces have no pose in ODE and are put into the world here.
struct MakeGeometry {
    dSpaceID space;
    const Pose& pose;

    dGeomID operator()(const Sphere& s) const { return dCreateSphere(space, s.radius); }
    dGeomID operator()(const Box& b) const { return dCreateBox(space, b.size.x(), b.size.y(), b.size.z()); }
    dGeomID operator()(const Capsule& c) const { return dCreateCapsule(space, c.radius, c.length); }
    dGeomID operator()(const HalfSpace& h) const {
        const Vec3 normal = pose.orientation * h.normal.normalized();
        return dCreatePlane(space, normal.x(), normal.y(), normal.z(), h.offset + normal.dot(pose.position));
    }
};

std::array<dReal, 4> toOde(const Quat& q) {
    return {q.w(), q.x(), q.y(), q.z()};
}

class OdeEngine final : public Engine {
  public:
    OdeEngine(const RigidScene& scene, const EngineOptions& options)
        : scene_(scene), time_step_(1 / options.steps_per_second) {
        // The quick step takes its rows in a random order; its generator is shared by all worlds.
        dRandSetSeed(0);
        dWorldSetQuickStepNumIterations(world_, iterations);
        dWorldSetAutoDisableFlag(world_, options.sleeping ? 1 : 0);
        setGravity(scene_.gravityAt(0, time_step_));
        for (const RigidBody& body : scene_.bodies()) add(body);
    }
    ~OdeEngine() override {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }
    OdeEngine(const OdeEngine&) = delete;
    OdeEngine& operator=(const OdeEngine&) = delete;

    void step() override {
        setGravity(scene_.gravityAt(static_cast<double>(steps_) * time_step_, time_step_));
        dSpaceCollide(space_, this, collide);
        dWorldQuickStep(world_, time_step_);
        dJointGroupEmpty(contacts_);
        ++steps_;
    }

    void poses(std::vector<Pose>& poses) const override {
        poses.resize(bodies_.size());
        for (std::size_t i = 0; i < poses.size(); ++i) {
            if (bodies_[i] == nullptr) {
                poses[i] = scene_.bodies()[i].pose;
                continue;
            }
            const dReal* p = dBodyGetPosition(bodies_[i]);
            const dReal* q = dBodyGetQuaternion(bodies_[i]);
            poses[i] = {Vec3(p[0], p[1], p[2]), Quat(q[0], q[1], q[2], q[3])};
        }
    }

    std::size_t asleep() const override {
        return static_cast<std::size_t>(std::count_if(
            bodies_.begin(), bodies_.end(), [](dBodyID body) { return body != nullptr && dBodyIsEnabled(body) == 0; }));
    }

  private:
    void setGravity(const Vec3& gravity) {
        if (gravity == gravity_) return;
        gravity_ = gravity;
        dWorldSetGravity(world_, gravity.x(), gravity.y(), gravity.z());
        for (const dBodyID body : bodies_) {
            if (body != nullptr) dBodyEnable(body);
        }
    }

    void add(const RigidBody& body) {
        const dGeomID geometry = std::visit(MakeGeometry{space_, body.pose}, body.shape);
        dGeomSetData(geometry, const_cast<RigidBody*>(&body));
        const Vec3& p = body.pose.position;
        const std::array<dReal, 4> q = toOde(body.pose.orientation);
        if (body.fixed) {
            bodies_.push_back(nullptr);
            if (std::holds_alternative<HalfSpace>(body.shape)) return;
            dGeomSetPosition(geometry, p.x(), p.y(), p.z());
            dGeomSetQuaternion(geometry, q.data());
            return;
        }
        const dBodyID made = dBodyCreate(world_);
        const Vec3& inertia = body.principal_inertia;
        dMass mass;
        dMassSetParameters(&mass, body.mass, 0, 0, 0, inertia.x(), inertia.y(), inertia.z(), 0, 0, 0);
        dBodySetMass(made, &mass);
        dBodySetPosition(made, p.x(), p.y(), p.z());
        dBodySetQuaternion(made, q.data());
        const Vec3& v = body.linear_velocity;
        const Vec3& w = body.angular_velocity;
        dBodySetLinearVel(made, v.x(), v.y(), v.z());
        dBodySetAngularVel(made, w.x(), w.y(), w.z());
        dGeomSetBody(geometry, made);
        bodies_.push_back(made);
    }

    static void collide(void* engine, dGeomID a, dGeomID b) { static_cast<OdeEngine*>(engine)->collidePair(a, b); }

    void collidePair(dGeomID a, dGeomID b) {
        const dBodyID body_a = dGeomGetBody(a);
        const dBodyID body_b = dGeomGetBody(b);
        const auto moves = [](dBodyID body) { return body != nullptr && dBodyIsEnabled(body) != 0; };
        if (!moves(body_a) && !moves(body_b)) return;
        std::array<dContactGeom, most_contacts> points;
        const int count = dCollide(a, b, most_contacts, points.data(), sizeof(dContactGeom));
        if (count == 0) return;
        const PairProperties& pair = scene_.pair(static_cast<const RigidBody*>(dGeomGetData(a))->material,
                                                 static_cast<const RigidBody*>(dGeomGetData(b))->material);
        for (int i = 0; i < count; ++i) {
            dContact contact{};
            contact.geom = points[static_cast<std::size_t>(i)];
            contact.surface.mode = dContactApprox1 | dContactBounce;
            contact.surface.mu = pair.kinetic_friction;
            contact.surface.bounce = pair.restitution;
            contact.surface.bounce_vel = bounce_speed;
            dJointAttach(dJointCreateContact(world_, contacts_, &contact), body_a, body_b);
        }
    }

    Library library_;
    const RigidScene& scene_;
    double time_step_;
    std::int64_t steps_ = 0;
    Vec3 gravity_ = Vec3::Zero();
    dWorldID world_ = dWorldCreate();
    dSpaceID space_ = dHashSpaceCreate(nullptr);
    dJointGroupID contacts_ = dJointGroupCreate(0);
    std::vector<dBodyID> bodies_;  ///< per body of the scene; null = fixed
};

}  // namespace

EngineKind odeEngine() {
    EngineKind kind;
    kind.name = "ode";
    kind.version =
        fmt::format("ODE {}, {} precision", dODE_VERSION, sizeof(dReal) == sizeof(float) ? "single" : "double");
    kind.settings = fmt::format(
        "dWorldQuickStep, {} iterations, up to {} contacts a pair, dContactApprox1, bounce from {} m/s on, hash space, "
        "ERP, CFM and auto-disable as they are, 1 thread",
        iterations, most_contacts, bounce_speed);
    kind.make = [](const Scene&, const RigidScene& scene, const EngineOptions& options) {
        return std::make_unique<OdeEngine>(scene, options);
    };
    return kind;
}

}  // namespace cairn::bench
