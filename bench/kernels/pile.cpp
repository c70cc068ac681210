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

void addBody(const World& world, BodyId id, Pile& pile) {
    const bool fixed = world.isFixed(id);
    const double time_step = pile.settings.timeStep();
    pile.kind.push_back(fixed ? BodyKind::fixed : BodyKind::dynamic);
    pile.position.push_back(world.pose(id).position);
    pile.v.push_back(fixed ? Vec3(Vec3::Zero()) : Vec3(world.linearVelocity(id) + time_step * world.gravity()));
    pile.w.push_back(fixed ? Vec3(Vec3::Zero()) : world.angularVelocity(id));
    pile.linear_step.push_back(time_step * pile.v.back());
    pile.mass_inv.push_back(fixed ? 0 : 1 / world.mass(id));
    pile.asleep.push_back(0);
    pile.woken.push_back(WakeReason::none);
    if (fixed) {
        pile.inertiaInv_W.emplace_back(Mat3::Zero());
        return;
    }
    const Mat3 axes = world.principalAxes(id).toRotationMatrix();
    pile.inertiaInv_W.emplace_back(axes * world.principalInertia(id).cwiseInverse().asDiagonal() * axes.transpose());
}

}  // namespace

BodyState Pile::state() {
    return {.kind = kind,
            .position = position,
            .v = v,
            .w = w,
            .mass_inv = mass_inv,
            .inertiaInv_W = inertiaInv_W,
            .linear_step = linear_step,
            .asleep = asleep,
            .woken = woken};
}

Pile makePile(std::size_t copies) {
    const SceneRun run = pouredHeap();
    const World& world = run.world();
    const std::vector<ContactInfo> found = world.contacts();
    Pile pile;
    pile.settings = world.settings();
    for (std::size_t copy = 0; copy < copies; ++copy) {
        const auto first = static_cast<BodyIndex>(pile.kind.size());
        std::map<BodyId, BodyIndex> index;
        for (const BodyId id : run.ids()) {
            index[id] = first + static_cast<BodyIndex>(index.size());
            addBody(world, id, pile);
        }
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
