#include "world/loads.h"

#include <algorithm>

#include "world/parts.h"

namespace cairn {

namespace {

bool isPushed(const BodyStorage& bodies, BodyIndex i) {
    return !(bodies.force[i].isZero(0) && bodies.torque[i].isZero(0) && bodies.constant_force[i].isZero(0) &&
             bodies.constant_torque[i].isZero(0));
}

/// Whether a joint does more than keep its bodies together.
bool isLoading(const Joint& joint) {
    return std::ranges::any_of(joint.free, [](const FreeAxis& axis) { return axis.mayDrive() || axis.resists(); });
}

/// The rate up to which drag can be neglected: with it, what is as slow as damping asks for is held by a hundredth of
/// its weight [1/s].
double negligibleDrag(const WorldState& world) {
    constexpr double part = 0.01;
    return part * (world.gravity + world.global_acceleration).norm() / dampedSpeed(world.settings.sleep);
}

/// Calls mark(body, load) for the loads of single bodies; of springs and joints also for what cannot move.
template <class Mark>
void forLoads(const WorldState& world, const Mark& mark) {
    const BodyStorage& b = world.bodies;
    const std::vector<Carried>& carried = world.data.carried;
    const double negligible = negligibleDrag(world);
    for (BodyIndex i = 0; i < b.slots(); ++i) {
        if (!carried.empty() && carried[i] != Carried::not_at_all) mark(i, Load::carried);
        if (isPushed(b, i) || b.linear_damping[i] > negligible) mark(i, Load::pulled);
    }
    for (const Spring& spring : world.springs) {
        if (!spring.present) continue;
        mark(spring.a, Load::pulled);
        mark(spring.b, Load::pulled);
    }
    for (const Joint& joint : world.joints) {
        if (!joint.present || !isLoading(joint)) continue;
        mark(joint.a, Load::pulled);
        mark(joint.b, Load::pulled);
    }
}

}  // namespace

void findLoads(WorldState& world) {
    FieldArray<Load>& loads = world.bodies.load;
    std::ranges::fill(loads, Load::none);
    if (!foresees(world.settings)) return;
    bool any = false;
    forLoads(world, [&](BodyIndex i, Load load) {
        if (i >= world.bodies.slots() || world.bodies.kind[i] != BodyKind::dynamic) return;
        loads[i] = std::max(loads[i], load);
        any = true;
    });
    if (!any) return;
    for (std::size_t batch = 0; batch < world.data.batches.size(); ++batch) {
        Load most = Load::none;
        for (const BodyIndex i : world.data.batches[batch].bodies) most = std::max(most, loads[i]);
        if (most == Load::none) continue;
        for (const BodyIndex i : world.data.batches[batch].bodies) loads[i] = most;
    }
}

}  // namespace cairn
