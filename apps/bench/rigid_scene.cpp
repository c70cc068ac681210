#include "rigid_scene.h"

#include <fmt/format.h>

#include <algorithm>

namespace cairn::bench {

namespace {

std::size_t materialOf(const Scene& scene, const SceneBody& body) {
    const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [&](const Material& material) { return material.name == body.material; });
    return static_cast<std::size_t>(found - scene.materials.begin());
}

[[noreturn]] void refuse(const Scene& scene, const char* what) {
    throw InputError(fmt::format(
        "scene '{}' has {}, which cannot be given to every engine alike; the engines are compared in scenes "
        "of balls, boxes, capsules and half-spaces; give another scene",
        scene.name, what));
}

/// The shape, if all engines have it.
struct CommonShape {
    const Scene& scene;

    RigidShape operator()(const Sphere& shape) const { return shape; }
    RigidShape operator()(const Box& shape) const { return shape; }
    RigidShape operator()(const Capsule& shape) const { return shape; }
    RigidShape operator()(const HalfSpace& shape) const { return shape; }
    RigidShape operator()(const Cylinder&) const { refuse(scene, "cylinders"); }
    RigidShape operator()(const ConvexHull&) const { refuse(scene, "convex hulls"); }
    RigidShape operator()(const Mesh&) const { refuse(scene, "meshes"); }
    RigidShape operator()(const HeightField&) const { refuse(scene, "height fields"); }
    RigidShape operator()(const Compound&) const { refuse(scene, "compounds"); }
};

}  // namespace

RigidScene::RigidScene(const Scene& scene) : materials_(scene.materials.size()), gravity_{{0, scene.gravity}} {
    if (!scene.springs.empty()) refuse(scene, "springs");
    if (!scene.joints.empty()) refuse(scene, "joints");
    if (scene.gravity_law) refuse(scene, "a gravity that follows a law");
    for (const SceneEvent& event : scene.events) {
        const auto* change = std::get_if<SetGravity>(&event.action);
        if (change == nullptr) refuse(scene, "events other than changes of gravity");
        gravity_.push_back({event.time, change->gravity});
    }
    std::stable_sort(gravity_.begin(), gravity_.end(),
                     [](const GravityChange& a, const GravityChange& b) { return a.time < b.time; });

    // A world computes masses and inertias, and refuses what is wrong with the scene.
    const SceneRun run(scene, settingsFor(scene));
    const World& world = run.world();
    bodies_.reserve(scene.bodies.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const SceneBody& body = scene.bodies[i];
        if (body.centre_of_mass || body.inertia) refuse(scene, "centres of mass or inertias given by hand");
        const RigidShape shape = std::visit(CommonShape{scene}, body.shape);
        const BodyId id = run.ids()[i];
        bodies_.push_back({shape, world.pose(id), body.linear_velocity, body.angular_velocity, world.mass(id),
                           world.principalInertia(id), body.fixed, materialOf(scene, body)});
    }
    for (std::size_t a = 0; a < materials_; ++a) {
        for (std::size_t b = 0; b < materials_; ++b) {
            pairs_.push_back(world.pairProperties(static_cast<MaterialId>(a), static_cast<MaterialId>(b)));
        }
    }
}

const Vec3& RigidScene::gravityAt(double time, double time_step) const {
    // With the tolerance of SceneRun: all engines see an event in the same time step.
    const double now = time + 1e-9 * time_step;
    std::size_t last = 0;
    while (last + 1 < gravity_.size() && gravity_[last + 1].time <= now) ++last;
    return gravity_[last].gravity;
}

}  // namespace cairn::bench
