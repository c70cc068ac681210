#include "world/detection.h"

#include <algorithm>

#include "narrow_phase/narrow_phase.h"

namespace cairn {

namespace {

/// Fewest pairs worth a thread of their own.
constexpr std::size_t pair_grain = 32;

void findBounds(const BodyStorage& bodies, double margin, const Executor& executor, std::vector<Bounds>& bounds) {
    bounds.resize(bodies.slots());
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            if (bodies.kind[i] == BodyKind::hole) continue;
            Bounds grown = boundsOf(bodies.shape[i], bodies.shapePose(i));
            grown.lower.array() -= margin;
            grown.upper.array() += margin;
            bounds[i] = grown;
        }
    });
}

/// Contacts of one pair of bodies closer to each other than this part of the smaller body are one, if their directions
/// are as equal as this cosine: parts of a compound that meet in a face share its corners.
constexpr double same_place = 1e-3;
constexpr double same_direction = 0.999;

/// Whether another contact of the pair is at the same place; the deeper of the two stays.
bool mergeInto(std::span<Contact> others, const Vec3& point, const Vec3& normal, double distance, double reach) {
    for (Contact& other : others) {
        if ((other.point - point).squaredNorm() > reach * reach) continue;
        if (other.normal.dot(normal) < same_direction) continue;
        if (distance < other.distance) {
            other.point = point;
            other.normal = normal;
            other.distance = distance;
        }
        return true;
    }
    return false;
}

/// Appends the contacts of one pair.
void collidePair(const BodyStorage& bodies, const MaterialTable& materials, const BodyPair& pair, double margin,
                 Manifold& manifold, std::vector<Contact>& contacts) {
    const PairProperties& properties = materials.pair(bodies.material[pair.a], bodies.material[pair.b]);
    const std::size_t first = contacts.size();
    const double reach = same_place * std::min(bodies.r_max[pair.a], bodies.r_max[pair.b]);
    const auto add = [&](const Manifold& found) {
        // Within one manifold points are apart already.
        const std::size_t earlier = contacts.size() - first;
        for (std::size_t k = 0; k < found.size; ++k) {
            const auto& [point, distance] = found.points[k];
            if (mergeInto(std::span(contacts).subspan(first, earlier), point, found.normal, distance, reach)) continue;
            contacts.push_back({.a = pair.a,
                                .b = pair.b,
                                .point = point,
                                .normal = found.normal,
                                .distance = distance,
                                .restitution = properties.restitution,
                                .static_friction = properties.static_friction,
                                .kinetic_friction = properties.kinetic_friction,
                                .rolling_friction = properties.rolling_friction,
                                .spinning_friction = properties.spinning_friction});
        }
    };
    forEachManifold(bodies.shape[pair.a], bodies.shapePose(pair.a), bodies.shape[pair.b], bodies.shapePose(pair.b),
                    margin, manifold, add);
}

/// Whether joints keep two bodies from touching. @param excluded sorted
bool isExcluded(std::span<const BodyPair> excluded, const BodyPair& pair) {
    const auto before = [](const BodyPair& x, const BodyPair& y) { return x.a < y.a || (x.a == y.a && x.b < y.b); };
    return !excluded.empty() && std::binary_search(excluded.begin(), excluded.end(), pair, before);
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
                if (isExcluded(data.excluded, data.pairs[i])) continue;
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
