#include "world/weights.h"

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

/// Calls mark(body) with all that other forces than gravity act on; of springs and joints also with what cannot move.
template <class Mark>
void forForced(const WorldState& world, const Mark& mark) {
    const BodyStorage& b = world.bodies;
    const std::vector<Carried>& carried = world.data.carried;
    const double negligible = negligibleDrag(world);
    for (BodyIndex i = 0; i < b.slots(); ++i) {
        if (isPushed(b, i) || b.linear_damping[i] > negligible ||
            (!carried.empty() && carried[i] != Carried::not_at_all))
            mark(i);
    }
    for (const Spring& spring : world.springs) {
        if (!spring.present) continue;
        mark(spring.a);
        mark(spring.b);
    }
    for (const Joint& joint : world.joints) {
        if (!joint.present || !isLoading(joint)) continue;
        mark(joint.a);
        mark(joint.b);
    }
}

}  // namespace

void findAllWeight(WorldState& world) {
    FieldArray<std::uint8_t>& whole = world.bodies.all_weight;
    std::ranges::fill(whole, 0);
    if (!(world.settings.sleep.damping > 0) || !foresees(world.settings)) return;
    bool any = false;
    forForced(world, [&](BodyIndex i) {
        if (i >= world.bodies.slots() || world.bodies.kind[i] != BodyKind::dynamic) return;
        whole[i] = 1;
        any = true;
    });
    if (!any) return;
    for (std::size_t batch = 0; batch < world.data.batches.size(); ++batch) {
        const auto bodies = world.data.batches[batch].bodies;
        if (std::ranges::none_of(bodies, [&](BodyIndex i) { return whole[i] != 0; })) continue;
        for (const BodyIndex i : bodies) whole[i] = 1;
    }
}

}  // namespace cairn
