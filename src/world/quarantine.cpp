#include "world/quarantine.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cairn {

namespace {

/// False for what is not a number, too: comparisons with it are false. Without branches, since it is true nearly
/// always.
bool isWithin(const Vec3& u, double limit) {
    return (static_cast<int>(std::abs(u.x()) <= limit) & static_cast<int>(std::abs(u.y()) <= limit) &
            static_cast<int>(std::abs(u.z()) <= limit)) != 0;
}

bool isSound(const BodyStorage& bodies, std::size_t i) {
    return isWithin(bodies.v[i], speed_limit) && isWithin(bodies.w[i], speed_limit) &&
           isWithin(bodies.position[i], distance_limit) && std::isfinite(bodies.orientation[i].coeffs().sum());
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

void quarantine(WorldState& world) {
    BodyStorage& bodies = world.bodies;
    const std::size_t known = world.faults.size();
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (bodies.kind[i] != BodyKind::dynamic || isSound(bodies, i)) continue;
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

Overlaps overlapsOf(const WorldState& world) {
    Overlaps overlaps;
    for (const Contact& contact : world.data.contacts) {
        if (contact.distance >= 0) continue;
        ++overlaps.count;
        overlaps.sum.add(-contact.distance);
        overlaps.largest = std::max(overlaps.largest, -contact.distance);
    }
    return overlaps;
}

void measureOverlaps(WorldState& world) {
    const Overlaps overlaps = overlapsOf(world);
    world.statistics.largest_overlap = std::max(world.statistics.largest_overlap, overlaps.largest);
    world.statistics.mean_overlap = overlaps.mean();
}

void summarize(WorldState& world) {
    Statistics& s = world.statistics;
    const StepData& data = world.data;
    s.contacts = static_cast<std::int64_t>(data.contacts.size());
    for (const CorrectionCounts& counts : data.correction_counts) {
        s.penetrating_contacts += counts.penetrating;
        s.corrected_contacts += counts.corrected;
        s.uncorrected_contacts += counts.uncorrected;
        s.displaced_bodies += counts.displaced;
    }
    s.global_iterations = data.resolution_counts.global_iterations;
    s.shock_iterations = data.resolution_counts.shock_iterations;
    s.shock_batches = data.resolution_counts.shock_batches;
    s.batches = static_cast<std::int64_t>(data.batches.size());
    for (std::size_t i = 0; i < data.batches.size(); ++i) {
        s.largest_batch = std::max(s.largest_batch, static_cast<std::int64_t>(data.batches[i].contacts.size()));
    }
    measureOverlaps(world);
    for (BodyIndex i = 0; i < world.bodies.slots(); ++i) {
        s.asleep += world.bodies.asleep[i];
        if (world.bodies.woken[i] == WakeReason::none) continue;
        ++s.woken;
        world.bodies.woken[i] = WakeReason::none;
    }
}

}  // namespace cairn
