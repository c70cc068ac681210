#include "world/detection.h"

#include <algorithm>

#include "math/arrays.h"
#include "narrow_phase/narrow_phase.h"

namespace cairn {

namespace {

/// Fewest pairs worth a thread of their own: most are far from each other, or known.
constexpr std::size_t pair_grain = 256;

/// Compares every body with its place at the last detection, and notes where it is now.
void findStill(const BodyStorage& bodies, double margin, const Executor& executor, StillBodies& still) {
    if (margin != still.margin) forgetPlaces(still);
    still.margin = margin;
    still.places.resize(bodies.slots());
    still.still.resize(bodies.slots());
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            StillBodies::Place& place = still.places[i];
            const bool same = place.kind != BodyKind::hole && place.kind == bodies.kind[i] &&
                              place.generation == bodies.generation[i] && place.position == bodies.position[i] &&
                              place.orientation.coeffs() == bodies.orientation[i].coeffs();
            still.still[i] = same ? 1 : 0;
            place = {bodies.position[i], bodies.orientation[i], bodies.generation[i], bodies.kind[i]};
        }
    });
    still.found = still.still;
}

/// Finds the bodies that are farther than a way [m] from their places at the last detection, and notes where they are
/// now. @return whether there is one
bool findDisplaced(const BodyStorage& bodies, double way, StillBodies& still) {
    bool any = false;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        Vec3& place = still.places[i].position;
        const bool displaced =
            bodies.kind[i] == BodyKind::dynamic && (place - bodies.position[i]).squaredNorm() > way * way;
        still.found[i] = displaced ? 0 : 1;
        if (!displaced) continue;
        any = true;
        still.still[i] = 0;
        place = bodies.position[i];
    }
    return any;
}

bool areFound(const StillBodies& still, const BodyPair& pair) {
    return (still.found[pair.a] & still.found[pair.b]) != 0;
}

void findBounds(const BodyStorage& bodies, double margin, const Executor& executor, StepData& data) {
    data.bounds.resize(bodies.slots());
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            if (bodies.kind[i] == BodyKind::hole || data.still.found[i] != 0) continue;
            Bounds grown = boundsOf(bodies.shape[i], bodies.shapePose(i));
            grown.lower.array() -= margin;
            grown.upper.array() += margin;
            data.bounds[i] = grown;
        }
    });
}

/// Contacts of one pair of bodies closer to each other than this part of the smaller body are one, if their directions
/// are as equal as this cosine: parts of a compound that meet in a face share its corners.
constexpr double same_place = 1e-3;
constexpr double same_direction = 0.999;

/// Whether another contact of the pair is at the same place; the deeper of the two stays.
bool mergeInto(std::span<FoundContact> others, const Vec3& point, const Vec3& normal, double distance, double reach) {
    for (FoundContact& other : others) {
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
void collidePair(const BodyStorage& bodies, const BodyPair& pair, double margin, Manifold& manifold,
                 std::vector<FoundContact>& contacts) {
    const std::size_t first = contacts.size();
    const double reach = same_place * std::min(bodies.r_max[pair.a], bodies.r_max[pair.b]);
    const auto add = [&](const Manifold& found) {
        // Within one manifold points are apart already.
        const std::size_t earlier = contacts.size() - first;
        for (std::size_t k = 0; k < found.size; ++k) {
            const auto& [point, distance] = found.points[k];
            if (mergeInto(std::span(contacts).subspan(first, earlier), point, found.normal, distance, reach)) continue;
            appendTightly(contacts, {pair.a, pair.b, point, found.normal, distance});
        }
    };
    forEachManifold(bodies.shape[pair.a], bodies.shapePose(pair.a), bodies.shape[pair.b], bodies.shapePose(pair.b),
                    margin, manifold, add);
}

bool isBefore(const Contact& contact, const BodyPair& pair) {
    return contact.a < pair.a || (contact.a == pair.a && contact.b < pair.b);
}

/// The contacts of the last step, pair by pair.
class LastContacts {
  public:
    /// @param pair the first that will be asked for
    LastContacts(std::span<const Contact> contacts, const BodyPair& pair) : contacts_(contacts) {
        next_ = static_cast<std::size_t>(
            std::ranges::partition_point(contacts, [&](const Contact& c) { return isBefore(c, pair); }) -
            contacts.begin());
    }
    /// @param pair not below the one asked for before
    std::span<const Contact> of(const BodyPair& pair) {
        while (next_ < contacts_.size() && isBefore(contacts_[next_], pair)) ++next_;
        std::size_t end = next_;
        while (end < contacts_.size() && contacts_[end].a == pair.a && contacts_[end].b == pair.b) ++end;
        return contacts_.subspan(next_, end - next_);
    }

  private:
    std::span<const Contact> contacts_;
    std::size_t next_;
};

/// Whether joints keep two bodies from touching. @param excluded sorted
bool isExcluded(std::span<const BodyPair> excluded, const BodyPair& pair) {
    const auto before = [](const BodyPair& x, const BodyPair& y) { return x.a < y.a || (x.a == y.a && x.b < y.b); };
    return !excluded.empty() && std::binary_search(excluded.begin(), excluded.end(), pair, before);
}

/// Finds the contacts of all pairs but those that are found already.
void detect(const BodyStorage& bodies, const MaterialTable& materials, BroadPhase& broad_phase,
            const Executor& executor, DetectionRound round, StepData& data) {
    const double margin = data.still.margin;
    findBounds(bodies, margin, executor, data);
    data.near_pairs.update({bodies.kind, data.bounds, bodies.v, data.still.still}, broad_phase, executor);
    const std::span<const BodyPair> pairs = data.near_pairs.pairs();
    data.thread_contacts.resize(static_cast<std::size_t>(executor.threads()));
    for (FoundContacts& part : data.thread_contacts) part.clear();
    executor.forBlocks(
        pairs.size(),
        [&](std::size_t begin, std::size_t end, int thread) {
            if (begin == end) return;
            Manifold manifold;
            LastContacts last_contacts(data.contacts, pairs[begin]);
            FoundContacts& part = data.thread_contacts[static_cast<std::size_t>(thread)];
            for (std::size_t i = begin; i < end; ++i) {
                const BodyPair& pair = pairs[i];
                if (isExcluded(data.excluded, pair)) continue;
                const bool found = areFound(data.still, pair);
                const auto last = found ? last_contacts.of(pair) : std::span<const Contact>();
                if (!last.empty()) {
                    part.add(static_cast<std::size_t>(last.data() - data.contacts.data()), last.size(), true);
                    continue;
                }
                if (found && data.still.all_tested) continue;
                if (!data.bounds[pair.a].overlaps(data.bounds[pair.b])) continue;
                const std::size_t before = part.found.size();
                collidePair(bodies, pair, margin, manifold, part.found);
                part.add(before, part.found.size() - before, false);
            }
        },
        pair_grain);
    joinContacts(bodies, materials, executor, round, data);
    data.still.all_tested = data.excluded.empty();
}

}  // namespace

void detectContacts(const BodyStorage& bodies, const MaterialTable& materials, BroadPhase& broad_phase, double margin,
                    const Executor& executor, StepData& data) {
    findStill(bodies, margin, executor, data.still);
    detect(bodies, materials, broad_phase, executor, DetectionRound::first, data);
}

bool detectDisplaced(const BodyStorage& bodies, const MaterialTable& materials, BroadPhase& broad_phase, double way,
                     const Executor& executor, StepData& data) {
    if (!findDisplaced(bodies, way, data.still)) return false;
    detect(bodies, materials, broad_phase, executor, DetectionRound::later, data);
    return true;
}

void forgetPlaces(StillBodies& still) {
    still.places.clear();
}

void forgetDisplaced(const BodyStorage& bodies, StillBodies& still) {
    still.unmoved = still.still;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        StillBodies::Place& place = still.places[i];
        if (place.position == bodies.position[i]) continue;
        place.kind = BodyKind::hole;
        still.unmoved[i] = 0;
    }
}

}  // namespace cairn
