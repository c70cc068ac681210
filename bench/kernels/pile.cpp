#include "pile.h"

#include <limits>
#include <map>
#include <numeric>

#include "cairn/scene.h"

namespace cairn::kernels {

namespace {

constexpr int simulation_steps = 30;

SceneRun pouredHeap() {
    Scene scene = builtInScene("heap:500");
    SettingOverrides overrides;
    overrides.fields = {{"sleeping", "false"}};
    SceneRun run(scene, settingsFor(scene, overrides));
    for (int i = 0; i < simulation_steps; ++i) run.simulationStep();
    return run;
}

BodyIndex addBody(const World& world, BodyId id, Pile& pile) {
    const bool fixed = world.isFixed(id);
    const BodyIndex i = pile.allocate(fixed ? BodyKind::fixed : BodyKind::dynamic);
    pile.position[i] = world.pose(id).position;
    if (fixed) return i;
    const double time_step = pile.settings.timeStep();
    pile.v[i] = world.linearVelocity(id) + time_step * world.gravity();
    pile.w[i] = world.angularVelocity(id);
    pile.linear_step[i] = time_step * pile.v[i];
    pile.mass[i] = world.mass(id);
    pile.inertia_B[i] = world.principalInertia(id);
    pile.orientation[i] = world.principalAxes(id);
    pile.updateMassProperties(i);
    return i;
}

}  // namespace

Pile makePile(std::size_t copies) {
    const SceneRun run = pouredHeap();
    const World& world = run.world();
    const std::vector<ContactInfo> found = world.contacts();
    Pile pile;
    pile.settings = world.settings();
    for (std::size_t copy = 0; copy < copies; ++copy) {
        std::map<BodyId, BodyIndex> index;
        for (const BodyId id : run.ids()) index[id] = addBody(world, id, pile);
        for (const ContactInfo& info : found) {
            Contact contact;
            contact.a = index.at(info.a);
            contact.b = index.at(info.b);
            contact.point = info.point;
            contact.normal = info.normal;
            contact.distance = info.distance;
            const PairProperties pair = world.pairProperties(world.material(info.a), world.material(info.b));
            contact.restitution = pair.restitution;
            contact.static_friction = pair.static_friction;
            contact.kinetic_friction = pair.kinetic_friction;
            contact.last_impulse = info.impulse;
            pile.contacts.push_back(contact);
        }
    }
    for (BodyIndex i = 0; i < pile.kind.size(); ++i) {
        if (pile.kind[i] == BodyKind::dynamic) pile.bodies.push_back(i);
    }
    pile.indices.resize(pile.contacts.size());
    std::iota(pile.indices.begin(), pile.indices.end(), 0U);
    return pile;
}

}  // namespace cairn::kernels
