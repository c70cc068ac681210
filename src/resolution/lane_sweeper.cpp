#include "resolution/lane_sweeper.h"

#include <algorithm>

#include "math/arrays.h"
#include "resolution/contact_law.h"
#include "resolution/lane_contact.h"

namespace cairn {

namespace {

constexpr std::uint32_t empty_lane = UINT32_MAX;

/// Pairs with more contacts are put together as if they had so many.
constexpr std::size_t most_alike = 16;
constexpr std::size_t alike_sizes = most_alike + 1;

/// Fewest groups worth a thread of their own.
constexpr std::size_t group_grain = 24;

/// Groups of contacts worth a thread of their own in simple loops.
constexpr std::size_t wide_grain = loop_grain / lane_count;

/// Wide contacts whose changes are added up together: fixed, so that sums do not depend on the number of threads.
constexpr std::size_t sum_block = 64;

}  // namespace

template <class Number>
void LaneSweeper<Number>::beginColours(const PgsBatch& pgs, std::size_t contacts) {
    colours_.colour(std::span(pgs.local.ends).first(contacts), pgs.local.dynamic_bodies);
    arrange(pgs.local);
    beginGroups(pgs);
}

template <class Number>
void LaneSweeper<Number>::beginLanes(const PgsBatch& pgs, std::size_t contacts,
                                     std::span<const LaneRange, lanes> ranges) {
    const std::span<const ContactEnds> ends = std::span(pgs.local.ends).first(contacts);
    groups_.clear();
    contact_of_.clear();
    shared_ = 0;
    slot_of_.resize(ends.size());
    for (std::size_t i = own_order_.size(); i < ends.size(); ++i) own_order_.push_back(static_cast<std::uint32_t>(i));
    std::array<std::size_t, lanes> next;
    for (std::size_t lane = 0; lane < lanes; ++lane) next[lane] = ranges[lane].contact_begin;
    for (;;) {
        PairsOfLanes pairs;
        bool any = false;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::size_t begin = next[lane];
            std::size_t& end = next[lane];
            while (end < ranges[lane].contact_end && ends[end] == ends[begin]) ++end;
            pairs[lane] = {begin, end - begin};
            any = any || end > begin;
        }
        if (!any) break;
        addGroup(pairs, own_order_, pgs.local);
    }
    group_begin_.assign({0, groups_.size()});
    contacts_ = firstOf(contact_memory_, contact_of_.size() / lanes);
    beginGroups(pgs);
}

/// The contacts that empty lanes repeat: the first of the lane, or of another where it has none.
template <class Number>
auto LaneSweeper<Number>::substitutesOf(const Group& group) const -> std::array<std::uint32_t, lanes> {
    std::array<std::uint32_t, lanes> first;
    for (std::size_t lane = 0; lane < lanes; ++lane) first[lane] = contact_of_[group.begin * lanes + lane];
    const std::uint32_t any = *std::ranges::min_element(first);
    for (std::uint32_t& contact : first) contact = contact == empty_lane ? any : contact;
    return first;
}

template <class Number>
[[gnu::always_inline]] inline void LaneSweeper<Number>::beginGroup(const Group& group, const PgsBatch& pgs) {
    const PgsBody<Number> a = load<Number>(pgs.local.bodies, group.a);
    const PgsBody<Number> b = load<Number>(pgs.local.bodies, group.b);
    const std::array<std::uint32_t, lanes> substitute = substitutesOf(group);
    for (std::size_t i = group.begin; i < group.end; ++i) {
        BasicPgsContact<Number>& wide = contacts_[i];
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::uint32_t index = contact_of_[i * lanes + lane];
            const std::uint32_t source = index == empty_lane ? substitute[lane] : index;
            const Contact& contact = pgs.contacts[pgs.batch.contacts[source]];
            setLane(wide.normal, lane, contact.normal);
            setLane(wide.r_a, lane, contact.pointOn(contact.a) - pgs.bodies.position[contact.a]);
            setLane(wide.r_b, lane, contact.pointOn(contact.b) - pgs.bodies.position[contact.b]);
            setLane(wide.impulse, lane, index == empty_lane ? Vec3(Vec3::Zero()) : contact.last_impulse);
            setLane(wide.friction, lane, contact.static_friction);
        }
        BasicSymmetric3<Number> k;
        addCollisionMatrix(a.mass_inv, a.inertia_inv, wide.r_a, k);
        addCollisionMatrix(b.mass_inv, b.inertia_inv, wide.r_b, k);
        setInvertible(wide, k);
        const Number closing = wide.normal.dot(relativeVelocity(wide, a, b));
        const bool regular = isRegular(wide);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::uint32_t index = contact_of_[i * lanes + lane];
            if (index == empty_lane) {
                setMasses(wide, lane, PgsContact{});
                continue;
            }
            if (!regular) {
                PgsContact contact = laneOf(wide, lane);
                mendSingular(contact);
                setMasses(wide, lane, contact);
            }
            setLane(wide.target, lane,
                    ContactLaw::separatingSpeed(pgs.settings, pgs.contacts[pgs.batch.contacts[index]],
                                                laneOf(closing, lane)));
        }
        const auto pushes = (wide.normal.dot(wide.impulse) > 0) & (wide.normal_mass > 0);
        wide.impulse = where(pushes, wide.impulse, Triple<Number>());
    }
}

/// Fills the contacts, and applies the impulses that they begin with.
template <class Number>
void LaneSweeper<Number>::beginGroups(const PgsBatch& pgs) {
    pgs.executor.forBlocks(
        groups_.size(),
        [&](std::size_t begin, std::size_t end, int) {
            runOnLanes<Number>([&]() __attribute__((always_inline)) {
                for (std::size_t g = begin; g < end; ++g) beginGroup(groups_[g], pgs);
            });
        },
        group_grain);
    for (std::size_t c = 0; c < colours(); ++c) {
        visitGroups<Way::forth>(
            c, pgs,
            [](std::span<BasicPgsContact<Number>> contacts, PgsBody<Number> & a, PgsBody<Number> & b)
                __attribute__((always_inline)) {
                    for (const BasicPgsContact<Number>& contact : contacts) push(contact, contact.impulse, a, b);
                });
    }
}

/// Groups of pairs with equally many contacts, as far as there are such.
template <class Number>
void LaneSweeper<Number>::arrange(const LocalBatch& local) {
    groups_.clear();
    contact_of_.clear();
    group_begin_.assign(1, 0);
    slot_of_.resize(colours_.order().size());
    shared_ = colours_.shared();
    std::array<PairsOfLanes, alike_sizes> waiting;
    std::array<std::size_t, alike_sizes> waiting_count{};
    for (std::size_t c = 0; c < colours_.colours(); ++c) {
        for (std::size_t p = 0; p < colours_.pairs(c); ++p) {
            const Pair pair{colours_.begin(c, p), colours_.begin(c, p + 1) - colours_.begin(c, p)};
            if (!colours_.isShared(c)) {
                addGroup({pair}, colours_.order(), local);
                continue;
            }
            const std::size_t alike = std::min(pair.size, most_alike);
            waiting[alike][waiting_count[alike]++] = pair;
            if (waiting_count[alike] < lanes) continue;
            addGroup(waiting[alike], colours_.order(), local);
            waiting_count[alike] = 0;
        }
        PairsOfLanes rest;
        std::size_t rest_count = 0;
        for (std::size_t alike = alike_sizes; alike-- > 0; waiting_count[alike] = 0) {
            for (std::size_t i = 0; i < waiting_count[alike]; ++i) {
                rest[rest_count++] = waiting[alike][i];
                if (rest_count < lanes) continue;
                addGroup(rest, colours_.order(), local);
                rest.fill({});
                rest_count = 0;
            }
        }
        if (rest_count > 0) addGroup(rest, colours_.order(), local);
        group_begin_.push_back(groups_.size());
    }
    contacts_ = firstOf(contact_memory_, contact_of_.size() / lanes);
}

/// @param pairs some of which are there
template <class Number>
void LaneSweeper<Number>::addGroup(const PairsOfLanes& pairs, std::span<const std::uint32_t> order,
                                   const LocalBatch& local) {
    Group group;
    group.begin = static_cast<std::uint32_t>(contact_of_.size() / lanes);
    const Pair& longest = *std::ranges::max_element(pairs, {}, &Pair::size);
    const std::size_t length = longest.size;
    group.end = group.begin + static_cast<std::uint32_t>(length);
    contact_of_.resize(contact_of_.size() + length * lanes, empty_lane);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        // An empty lane repeats another pair, which can be computed with.
        const Pair& pair = pairs[lane].size > 0 ? pairs[lane] : longest;
        const ContactEnds& ends = local.ends[order[pair.begin]];
        group.a[lane] = ends.a;
        group.b[lane] = ends.b;
        if (pairs[lane].size == 0) continue;
        group.moves[lane] =
            static_cast<std::uint8_t>((local.isFixed(ends.a) ? 0 : 1) | (local.isFixed(ends.b) ? 0 : 2));
        for (std::size_t i = 0; i < pair.size; ++i) {
            const std::size_t slot = (group.begin + i) * lanes + lane;
            contact_of_[slot] = order[pair.begin + i];
            slot_of_[order[pair.begin + i]] = static_cast<std::uint32_t>(slot);
        }
    }
    groups_.push_back(group);
}

/// Calls visit(contacts, a, b) for every group of a colour, in ascending order or, where their order matters on the way
/// back, in descending order.
template <class Number>
template <typename LaneSweeper<Number>::Way way, class Visit>
void LaneSweeper<Number>::visitGroups(std::size_t colour, const PgsBatch& pgs, const Visit& visit) {
    const std::size_t first = group_begin_[colour];
    const std::size_t count = group_begin_[colour + 1] - first;
    std::vector<LocalBody>& bodies = pgs.local.bodies;
    const auto work = [&](std::size_t begin, std::size_t end, int) {
        runOnLanes<Number>([&]() __attribute__((always_inline)) {
            for (std::size_t n = begin; n < end; ++n) {
                const Group& group = groups_[way == Way::forth ? first + n : first + count - 1 - n];
                PgsBody<Number> a = load<Number>(bodies, group.a);
                PgsBody<Number> b = load<Number>(bodies, group.b);
                visit(contacts_.subspan(group.begin, group.end - group.begin), a, b);
                store(a, group.a, group.moves, 1, bodies);
                store(b, group.b, group.moves, 2, bodies);
            }
        });
    };
    if (colour < shared_) {
        pgs.executor.forBlocks(count, work, group_grain);
    } else {
        work(0, count, 0);
    }
}

template <class Number>
void LaneSweeper<Number>::sweepForth(const PgsBatch& pgs) {
    for (std::size_t c = 0; c < colours(); ++c) {
        visitGroups<Way::forth>(
            c, pgs,
            [](std::span<BasicPgsContact<Number>> contacts, PgsBody<Number> & a, PgsBody<Number> & b)
                __attribute__((always_inline)) {
                    for (BasicPgsContact<Number>& contact : contacts) visit(contact, a, b);
                });
    }
}

template <class Number>
void LaneSweeper<Number>::sweepBack(const PgsBatch& pgs) {
    for (std::size_t c = colours(); c-- > 0;) {
        visitGroups<Way::back>(
            c, pgs,
            [](std::span<BasicPgsContact<Number>> contacts, PgsBody<Number> & a, PgsBody<Number> & b)
                __attribute__((always_inline)) {
                    for (std::size_t i = contacts.size(); i-- > 0;) visit(contacts[i], a, b);
                });
    }
}

template <class Number>
void LaneSweeper<Number>::save(const PgsBatch& pgs) {
    resizeTightly(before_, contacts_.size());
    forEach(
        before_.size(), pgs.executor, [&](std::size_t i) { before_[i] = contacts_[i].impulse; }, wide_grain);
}

template <class Number>
SweepChange LaneSweeper<Number>::change(const PgsBatch& pgs) {
    sums_.resize((contacts_.size() + sum_block - 1) / sum_block);
    forEach(
        sums_.size(), pgs.executor,
        [&](std::size_t block) {
            sums_[block] = {};
            const std::size_t end = std::min(contacts_.size(), (block + 1) * sum_block);
            for (const SweepChange& lane : changeOf(block * sum_block, end)) sums_[block].add(lane);
        },
        1);
    SweepChange change;
    for (const SweepChange& part : sums_) change.add(part);
    return change;
}

template <class Number>
auto LaneSweeper<Number>::changeOfLanes() const -> std::array<SweepChange, lanes> {
    return changeOf(0, contacts_.size());
}

/// Of some wide contacts, lane by lane.
template <class Number>
auto LaneSweeper<Number>::changeOf(std::size_t begin, std::size_t end) const -> std::array<SweepChange, lanes> {
    std::array<SweepChange, lanes> change;
    runOnLanes<Number>([&]() __attribute__((always_inline)) {
        Number squared{};
        Number largest{};
        for (std::size_t i = begin; i < end; ++i) {
            const BasicPgsContact<Number>& contact = contacts_[i];
            const Triple<Number> difference = contact.impulse - before_[i];
            const Number weighted = difference.squaredNorm() / contact.normal_mass;
            const Number speed = (contact.k * difference).squaredNorm();
            squared += where(contact.normal_mass > 0, weighted, Number{});
            largest = where(speed > largest, speed, largest);
        }
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            change[lane] = {laneOf(squared, lane), std::sqrt(laneOf(largest, lane))};
        }
    });
    return change;
}

template <class Number>
void LaneSweeper<Number>::restart() {
    direction_.clear();
    resizeTightly(direction_, contacts_.size());
}

template <class Number>
void LaneSweeper<Number>::accelerate(double beta, const PgsBatch& pgs) {
    pgs.executor.forBlocks(
        contacts_.size(),
        [&](std::size_t begin, std::size_t end, int) {
            runOnLanes<Number>([&]() __attribute__((always_inline)) {
                const Number factor = beta + Number{};
                for (std::size_t i = begin; i < end; ++i) {
                    const Triple<Number> change = contacts_[i].impulse - before_[i];
                    const Triple<Number> step = factor * direction_[i];
                    contacts_[i].impulse += step;
                    direction_[i] = change + step;
                }
            });
        },
        wide_grain);
}

template <class Number>
void LaneSweeper<Number>::accelerateLanes(const std::array<double, lanes>& beta,
                                          const std::array<double, lanes>& advances) {
    const Number factor = collect<Number>([&](std::size_t lane) { return beta[lane]; });
    const auto mask = isNonzero(collect<Number>([&](std::size_t lane) { return advances[lane]; }));
    runOnLanes<Number>([&]() __attribute__((always_inline)) {
        for (std::size_t i = 0; i < direction_.size(); ++i) {
            const Triple<Number> change = contacts_[i].impulse - before_[i];
            const Triple<Number> step = factor * direction_[i];
            contacts_[i].impulse = where(mask, contacts_[i].impulse + step, contacts_[i].impulse);
            direction_[i] = change + step;
        }
    });
}

template <class Number>
void LaneSweeper<Number>::restartLane(std::size_t lane) {
    resizeTightly(direction_, contacts_.size());
    for (Triple<Number>& direction : direction_) setLane(direction, lane, Vec3::Zero());
}

template <class Number>
PgsContact LaneSweeper<Number>::contactAt(std::size_t contact, const PgsBatch& pgs) const {
    const std::uint32_t slot = slot_of_[contact];
    PgsContact s = laneOf(contacts_[slot / lanes], slot % lanes);
    s.a = pgs.local.ends[contact].a;
    s.b = pgs.local.ends[contact].b;
    return s;
}

template <class Number>
void LaneSweeper<Number>::setImpulse(std::size_t contact, const Triple1& impulse, LocalBatch& local) {
    const std::uint32_t slot = slot_of_[contact];
    BasicPgsContact<Number>& wide = contacts_[slot / lanes];
    const PgsContact s = laneOf(wide, slot % lanes);
    LocalBody& a = local.bodies[local.ends[contact].a];
    LocalBody& b = local.bodies[local.ends[contact].b];
    PgsBody<double> pgs_a = read(a);
    PgsBody<double> pgs_b = read(b);
    push(s, impulse - s.impulse, pgs_a, pgs_b);
    if (!local.isFixed(local.ends[contact].a)) write(pgs_a, a);
    if (!local.isFixed(local.ends[contact].b)) write(pgs_b, b);
    setLane(wide.impulse, slot % lanes, toVec3(impulse));
}

template <class Number>
bool LaneSweeper<Number>::releaseSliding(const PgsBatch& pgs, const LaneRange& range) {
    bool released = false;
    for (std::size_t i = range.contact_begin; i < range.contact_end; ++i) {
        const Contact& contact = pgs.contacts[pgs.batch.contacts[i]];
        if (!(contact.kinetic_friction < contact.static_friction)) continue;
        const PgsContact s = contactAt(i, pgs);
        const std::vector<LocalBody>& bodies = pgs.local.bodies;
        if (!slides(s, bodies[s.a], bodies[s.b], pgs.settings.resolution_threshold)) continue;
        setLane(contacts_[slot_of_[i] / lanes].friction, slot_of_[i] % lanes, contact.kinetic_friction);
        released = true;
    }
    return released;
}

template <class Number>
void LaneSweeper<Number>::finish(const PgsBatch& pgs) {
    forEach(slot_of_.size(), pgs.executor, [&](std::size_t i) { writeImpulse(i, pgs); });
}

template <class Number>
void LaneSweeper<Number>::finishLane(std::size_t lane, const LaneRange& range, const PgsBatch& pgs) {
    for (std::size_t i = range.contact_begin; i < range.contact_end; ++i) writeImpulse(i, pgs);
    for (Group& group : groups_) group.moves[lane] = 0;
}

template <class Number>
void LaneSweeper<Number>::writeImpulse(std::size_t contact, const PgsBatch& pgs) const {
    const BasicPgsContact<Number>& wide = contacts_[slot_of_[contact] / lanes];
    pgs.contacts[pgs.batch.contacts[contact]].impulse += laneOf(wide.impulse, slot_of_[contact] % lanes);
}

template class LaneSweeper<double>;
template class LaneSweeper<Lanes>;

}  // namespace cairn
