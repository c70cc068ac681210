#include "world/step_statistics.h"

#include <algorithm>

namespace cairn {

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
