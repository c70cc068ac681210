#include "world/detection.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>

#include "math/arrays.h"
#include "narrow_phase/narrow_phase.h"

namespace cairn {

namespace {

/// Which detection of a step it is.
enum class DetectionRound : std::uint8_t { first, later };

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

Contact contactOf(const FoundContact& found, const PairProperties& properties) {
    return {.a = found.a,
            .b = found.b,
            .point = found.point,
            .normal = found.normal,
            .distance = found.distance,
            .restitution = properties.restitution,
            .static_friction = properties.static_friction,
            .kinetic_friction = properties.kinetic_friction,
            .rolling_friction = properties.rolling_friction,
            .spinning_friction = properties.spinning_friction};
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

/// Calls use(piece, place of its first contact), in the order of the contacts.
template <class Use>
void forEachPiece(const StepData& data, const Use& use) {
    std::size_t next = 0;
    for (const FoundContacts& part : data.thread_contacts) {
        for (const FoundContacts::Piece& piece : part.pieces) {
            use(piece, next);
            next += piece.count;
        }
    }
}

/// Brings the contacts that stay to their places: first all that move down, then, from the last on, those that move up.
/// So none is written over before its turn.
void moveStaying(StepData& data, std::size_t total) {
    std::vector<Contact>& contacts = data.contacts;
    resizeTightly(contacts, std::max(total, contacts.size()));
    data.rising.clear();
    forEachPiece(data, [&](const FoundContacts::Piece& piece, std::size_t to) {
        if (!piece.stays || to == piece.from) return;
        if (to > piece.from) {
            data.rising.emplace_back(piece, to);
        } else {
            const auto first = contacts.begin() + piece.from;
            std::move(first, first + piece.count, contacts.begin() + static_cast<std::ptrdiff_t>(to));
        }
    });
    for (const auto& [piece, to] : std::views::reverse(data.rising)) {
        const auto first = contacts.begin() + piece.from;
        std::move_backward(first, first + piece.count,
                           contacts.begin() + static_cast<std::ptrdiff_t>(to) + piece.count);
    }
    contacts.resize(total);
}

/// Makes what the response of the last step left the beginning of the present one.
void beginStep(bool has_history, std::span<Contact> contacts) {
    for (Contact& contact : contacts) {
        contact.last_impulse = has_history ? contact.impulse : Vec3(Vec3::Zero());
        if (!has_history) contact.reference_impulse.setZero();
        contact.impulse.setZero();
        contact.angular_impulse.setZero();
        contact.gap = contact.forced = contact.fall = contact.climb = 0;
    }
}

/// Threads own ascending blocks of the sorted pairs, so joining them in order keeps the contacts sorted.
void joinContacts(const BodyStorage& bodies, const MaterialTable& materials, const Executor& executor,
                  DetectionRound round, StepData& data) {
    std::size_t total = 0;
    for (const FoundContacts& part : data.thread_contacts) total += part.count;
    requireContacts(total);
    moveStaying(data, total);
    const auto fill = [&](const FoundContacts& part, std::size_t place) {
        for (const FoundContacts::Piece& piece : part.pieces) {
            const std::span<Contact> contacts = std::span(data.contacts).subspan(place, piece.count);
            place += piece.count;
            if (piece.stays) {
                if (round == DetectionRound::first) beginStep(data.has_history, contacts);
                continue;
            }
            for (std::size_t i = 0; i < contacts.size(); ++i) {
                const FoundContact& found = part.found[piece.from + i];
                contacts[i] = contactOf(found, materials.pair(bodies.material[found.a], bodies.material[found.b]));
            }
        }
    };
    executor.forBlocks(
        data.thread_contacts.size(),
        [&](std::size_t begin, std::size_t end, int) {
            std::size_t place = 0;
            for (std::size_t t = 0; t < begin; ++t) place += data.thread_contacts[t].count;
            for (std::size_t t = begin; t < end; place += data.thread_contacts[t++].count) {
                fill(data.thread_contacts[t], place);
            }
        },
        1);
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

void FoundContacts::clear() {
    found.clear();
    pieces.clear();
    count = 0;
}

void FoundContacts::add(std::size_t from, std::size_t contacts, bool stays) {
    if (contacts == 0) return;
    count += contacts;
    const auto size = static_cast<std::uint32_t>(contacts);
    if (!pieces.empty() && pieces.back().stays == stays && pieces.back().from + pieces.back().count == from) {
        pieces.back().count += size;
    } else {
        pieces.push_back({static_cast<std::uint32_t>(from), size, stays});
    }
}

void requireContacts(std::size_t count) {
    if (count <= most_contacts) return;
    throw InputError(fmt::format(
        "{} contacts in one time step; {} are the most: remove bodies, or part those that were put into each other",
        count, most_contacts));
}

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
