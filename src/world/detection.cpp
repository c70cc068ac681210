#include "world/detection.h"

#include "narrow_phase/narrow_phase.h"

namespace cairn {

namespace {

/// Fewest pairs worth a thread of their own.
constexpr std::size_t pair_grain = 32;

Pose poseOf(const BodyStorage& bodies, BodyIndex i) {
    return {bodies.position[i], bodies.orientation[i]};
}

void findBounds(const BodyStorage& bodies, double margin, const Executor& executor, std::vector<Bounds>& bounds) {
    bounds.resize(bodies.slots());
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            if (bodies.kind[i] == BodyKind::hole) continue;
            Bounds grown = boundsOf(bodies.shape[i], poseOf(bodies, i));
            grown.lower.array() -= margin;
            grown.upper.array() += margin;
            bounds[i] = grown;
        }
    });
}

/// Appends the contacts of one pair.
void collidePair(const BodyStorage& bodies, const MaterialTable& materials, const BodyPair& pair, double margin,
                 Manifold& manifold, std::vector<Contact>& contacts) {
    collide(bodies.shape[pair.a], poseOf(bodies, pair.a), bodies.shape[pair.b], poseOf(bodies, pair.b), margin,
            manifold);
    if (manifold.size == 0) return;
    const PairProperties& properties = materials.pair(bodies.material[pair.a], bodies.material[pair.b]);
    for (std::size_t k = 0; k < manifold.size; ++k) {
        contacts.push_back({.a = pair.a,
                            .b = pair.b,
                            .point = manifold.points[k].point,
                            .normal = manifold.normal,
                            .distance = manifold.points[k].distance,
                            .restitution = properties.restitution,
                            .static_friction = properties.static_friction,
                            .kinetic_friction = properties.kinetic_friction});
    }
}

}  // namespace

void detectContacts(const BodyStorage& bodies, const MaterialTable& materials, BroadPhase& broad_phase, double margin,
                    const Executor& executor, StepData& data) {
    findBounds(bodies, margin, executor, data.bounds);
    broad_phase.findPairs({.kind = bodies.kind, .bounds = data.bounds}, executor, data.pairs);

    data.thread_contacts.resize(static_cast<std::size_t>(executor.threads()));
    for (auto& contacts : data.thread_contacts) contacts.clear();
    executor.forBlocks(
        data.pairs.size(),
        [&](std::size_t begin, std::size_t end, int thread) {
            Manifold manifold;
            auto& contacts = data.thread_contacts[static_cast<std::size_t>(thread)];
            for (std::size_t i = begin; i < end; ++i) {
                collidePair(bodies, materials, data.pairs[i], margin, manifold, contacts);
            }
        },
        pair_grain);
    // Threads own ascending blocks of the sorted pairs, so joining them in order keeps the contacts sorted.
    data.contacts.clear();
    for (const auto& contacts : data.thread_contacts) {
        data.contacts.insert(data.contacts.end(), contacts.begin(), contacts.end());
    }
}

}  // namespace cairn
