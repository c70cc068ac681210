#include "world/faults.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "world/limits.h"

namespace cairn {

namespace {

/// False for what is not a number, too: comparisons with it are false.
bool isWithin(const Vec3& u, double limit) {
    return std::abs(u.x()) <= limit && std::abs(u.y()) <= limit && std::abs(u.z()) <= limit;
}

bool isSound(const BodyStorage& bodies, std::size_t i) {
    if (!std::isfinite(bodies.orientation[i].coeffs().sum())) return false;
    // What is short enough, as nearly all is, has no large components.
    const double speeds = bodies.v[i].squaredNorm() + bodies.w[i].squaredNorm();
    const double distance = bodies.position[i].squaredNorm();
    if (speeds <= speed_limit * speed_limit && distance <= distance_limit * distance_limit) return true;
    return isWithin(bodies.v[i], speed_limit) && isWithin(bodies.w[i], speed_limit) &&
           isWithin(bodies.position[i], distance_limit);
}

std::string describe(const BodyStorage& bodies, std::size_t i) {
    const Vec3& p = bodies.position[i];
    const Vec3& v = bodies.v[i];
    const Vec3& w = bodies.w[i];
    return fmt::format(
        "position ({}, {}, {}) m, velocity ({}, {}, {}) m/s, angular velocity ({}, {}, {}) rad/s left the "
        "limits of {} m and {} m/s",
        p.x(), p.y(), p.z(), v.x(), v.y(), v.z(), w.x(), w.y(), w.z(), distance_limit, speed_limit);
}

/// What two fixed bodies give each other moves nobody, and a resolution that finds such a contact in a batch may leave
/// any impulse in it.
void clearUnmoved(WorldState& world) {
    const auto& kind = world.bodies.kind;
    for (Contact& contact : world.data.contacts) {
        if (kind[contact.a] == BodyKind::dynamic || kind[contact.b] == BodyKind::dynamic) continue;
        contact.impulse.setZero();
        contact.angular_impulse.setZero();
        contact.last_impulse.setZero();
    }
}

}  // namespace

void fixNonFinite(WorldState& world) {
    BodyStorage& bodies = world.bodies;
    const std::size_t known = world.faults.size();
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        // Nothing changes who sleeps.
        if (bodies.kind[i] != BodyKind::dynamic || bodies.asleep[i] != 0 || isSound(bodies, i)) continue;
        world.lasting.reset();
        world.faults.push_back({.body = bodies.idOf(i), .step = world.steps, .what = describe(bodies, i)});
        if (!bodies.position[i].allFinite()) bodies.position[i].setZero();
        if (!bodies.orientation[i].coeffs().allFinite()) bodies.orientation[i].setIdentity();
        bodies.v[i].setZero();
        bodies.w[i].setZero();
        bodies.constant_force[i].setZero();
        bodies.constant_torque[i].setZero();
        bodies.asleep[i] = 0;
        bodies.kind[i] = BodyKind::fixed;
        bodies.updateMassProperties(i);
    }
    if (world.faults.size() > known) {
        // By body within a step, whichever stage found it: so ranks list their faults as one does.
        std::ranges::stable_sort(world.faults, {}, [](const FaultInfo& f) { return std::tuple(f.step, f.body); });
    }
    if (!world.faults.empty() && world.faults.back().step == world.steps) clearUnmoved(world);
}

}  // namespace cairn
