#include "resolution/lane_sweeper.h"

#include <algorithm>
#include <type_traits>

#include "math/arrays.h"
#include "resolution/contact_visit.h"
#include "resolution/fill_contact.h"
#include "resolution/release_sliding.h"

namespace cairn {

namespace {

/// Fewest groups worth a thread of their own.
constexpr std::size_t group_grain = 24;

/// Groups of contacts worth a thread of their own in simple loops.
constexpr std::size_t wide_grain = loop_grain / lane_count;

/// Wide contacts whose changes are added up together: fixed, so that sums do not depend on the number of threads.
constexpr std::size_t sum_block = 64;

}  // namespace

template <class Wide>
void BasicLaneSweeper<Wide>::prepare(const PgsBatch& pgs, std::size_t contacts, std::size_t first) {
    first_ = first;
    const auto ends = std::span<const ContactEnds>(pgs.local.ends).subspan(first, contacts);
    if (pgs.order == SweepOrder::by_colours) {
        groups_.byColours(ends, pgs.local.dynamic_bodies);
    } else {
        groups_.inOrder(ends, pgs.local.dynamic_bodies);
    }
    contacts_ = firstOf(contact_memory_, groups_.rows());
}

template <class Wide>
void BasicLaneSweeper<Wide>::fill(const PgsBatch& pgs) {
    pgs.executor.forBlocks(
        groups_.groups().size(),
        [&](std::size_t begin, std::size_t end, int) {
            runOnLanes<Lanes>([&]() __attribute__((always_inline)) {
                for (std::size_t g = begin; g < end; ++g) fillGroup(groups_.groups()[g], pgs);
            });
        },
        group_grain);
}

template <class Wide>
void BasicLaneSweeper<Wide>::start(const PgsBatch& pgs) {
    for (std::size_t set = 0; set < groups_.sets(); ++set) {
        visitGroups<Way::forth>(
            set, pgs,
            [](std::span<Wide> contacts, PgsBody<Lanes> & a, PgsBody<Lanes> & b) __attribute__((always_inline)) {
                for (const Wide& contact : contacts) push(contact, contact.impulse, a, b);
            });
    }
}

/// Empty lanes repeat the first contact of the lane, or of another where it has none.
template <class Wide>
[[gnu::always_inline]] inline void BasicLaneSweeper<Wide>::fillGroup(const LaneGroup& group, const PgsBatch& pgs) {
    const PgsBody<Lanes> a = load(pgs.local.bodies, group.a);
    const PgsBody<Lanes> b = load(pgs.local.bodies, group.b);
    const auto first = groups_.contactsOf(group.begin);
    const std::uint32_t any = *std::ranges::min_element(first);
    for (std::size_t i = group.begin; i < group.end; ++i) {
        Sources sources;
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
            const std::uint32_t index = groups_.contactsOf(i)[lane];
            sources.fills[lane] = index != LaneGroups::no_contact;
            const std::uint32_t substitute = first[lane] == LaneGroups::no_contact ? any : first[lane];
            sources.contacts[lane] =
                &pgs.contacts[pgs.batch.contacts[first_ + (sources.fills[lane] ? index : substitute)]];
        }
        fillContact(contacts_[i], a, b, sources, pgs.bodies.position, pgs.settings);
    }
}

/// Calls visit(contacts, a, b) for every group of a set, in ascending order or, on the way back, in descending order.
template <class Wide>
template <typename BasicLaneSweeper<Wide>::Way way, class Visit>
void BasicLaneSweeper<Wide>::visitGroups(std::size_t set, const PgsBatch& pgs, const Visit& visit) {
    const std::span<const LaneGroup> groups = groups_.set(set);
    std::vector<LocalBody>& bodies = pgs.local.bodies;
    const auto work = [&](std::size_t begin, std::size_t end, int) {
        runOnLanes<Lanes>([&]() __attribute__((always_inline)) {
            for (std::size_t n = begin; n < end; ++n) {
                const LaneGroup& group = groups[way == Way::forth ? n : groups.size() - 1 - n];
                PgsBody<Lanes> a = load(bodies, group.a);
                PgsBody<Lanes> b = load(bodies, group.b);
                visit(contacts_.subspan(group.begin, group.end - group.begin), a, b);
                store(a, group.a, group.moves, 1, bodies);
                store(b, group.b, group.moves, 2, bodies);
            }
        });
    };
    if (groups_.isShared(set)) {
        pgs.executor.forBlocks(groups.size(), work, group_grain);
    } else {
        work(0, groups.size(), 0);
    }
}

template <class Wide>
void BasicLaneSweeper<Wide>::sweepForth(const PgsBatch& pgs) {
    for (std::size_t set = 0; set < groups_.sets(); ++set) {
        visitGroups<Way::forth>(
            set, pgs,
            [](std::span<Wide> contacts, PgsBody<Lanes> & a, PgsBody<Lanes> & b) __attribute__((always_inline)) {
                for (Wide& contact : contacts) visit(contact, FreePair<Lanes>{a, b});
            });
    }
}

template <class Wide>
void BasicLaneSweeper<Wide>::sweepBack(const PgsBatch& pgs) {
    for (std::size_t set = groups_.sets(); set-- > 0;) {
        visitGroups<Way::back>(
            set, pgs,
            [](std::span<Wide> contacts, PgsBody<Lanes> & a, PgsBody<Lanes> & b) __attribute__((always_inline)) {
                for (std::size_t i = contacts.size(); i-- > 0;) visitBack(contacts[i], FreePair<Lanes>{a, b});
            });
    }
}

template <class Wide>
void BasicLaneSweeper<Wide>::save(const PgsBatch& pgs) {
    resizeTightly(before_, contacts_.size());
    forEach(
        before_.size(), pgs.executor, [&](std::size_t i) { before_[i] = contacts_[i].accumulated(); }, wide_grain);
}

template <class Wide>
SweepChange BasicLaneSweeper<Wide>::change(const PgsBatch& pgs) {
    resizeTightly(squared_, contacts_.size() * lane_count);
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
    if (pgs.order == SweepOrder::by_colours) return change;
    // Added up as by who visits one contact after the other.
    change.squared = 0;
    for (const std::uint32_t slot : groups_.slots()) change.squared += squared_[slot];
    return change;
}

/// Of some wide contacts, lane by lane. Notes each one's.
template <class Wide>
std::array<SweepChange, lane_count> BasicLaneSweeper<Wide>::changeOf(std::size_t begin, std::size_t end) {
    std::array<SweepChange, lane_count> change;
    runOnLanes<Lanes>([&]() __attribute__((always_inline)) {
        Lanes squared{};
        Lanes largest{};
        for (std::size_t i = begin; i < end; ++i) {
            const Wide& contact = contacts_[i];
            const BasicChange<Lanes> by = changeBy(contact, contact.accumulated() - before_[i]);
            const Lanes speed = by.squared_speed;
            const Lanes counted = where(contact.normal_mass > 0, by.squared, Lanes{});
            squared += counted;
            for (std::size_t lane = 0; lane < lane_count; ++lane) squared_[i * lane_count + lane] = counted[lane];
            largest = where(speed > largest, speed, largest);
        }
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
            change[lane] = {laneOf(squared, lane), std::sqrt(laneOf(largest, lane))};
        }
    });
    return change;
}

template <class Wide>
void BasicLaneSweeper<Wide>::restart() {
    direction_.clear();
    resizeTightly(direction_, contacts_.size());
}

template <class Wide>
void BasicLaneSweeper<Wide>::accelerate(double beta, const PgsBatch& pgs) {
    pgs.executor.forBlocks(
        contacts_.size(),
        [&](std::size_t begin, std::size_t end, int) {
            runOnLanes<Lanes>([&]() __attribute__((always_inline)) {
                const Lanes factor = beta + Lanes{};
                for (std::size_t i = begin; i < end; ++i) {
                    const Accumulated change = contacts_[i].accumulated() - before_[i];
                    const Accumulated step = factor * direction_[i];
                    contacts_[i].add(step);
                    direction_[i] = change + step;
                }
            });
        },
        wide_grain);
}

template <class Wide>
PgsContact BasicLaneSweeper<Wide>::contactAt(std::size_t contact, const PgsBatch& pgs) const {
    const std::uint32_t slot = groups_.slots()[contact];
    PgsContact s = laneOf(contacts_[slot / lane_count], slot % lane_count);
    s.a = pgs.local.ends[first_ + contact].a;
    s.b = pgs.local.ends[first_ + contact].b;
    return s;
}

template <class Wide>
bool BasicLaneSweeper<Wide>::releaseSliding(const PgsBatch& pgs) {
    const auto at = [&](std::size_t i) { return contactAt(i, pgs); };
    const std::span<const std::uint32_t> slots = groups_.slots();
    return releaseSlidingOf(pgs, first_, slots.size(), at, [&](std::size_t i, double friction) {
        setLane(contacts_[slots[i] / lane_count].friction, slots[i] % lane_count, friction);
    });
}

template <class Wide>
void BasicLaneSweeper<Wide>::finish(const PgsBatch& pgs) {
    forEach(groups_.slots().size(), pgs.executor, [&](std::size_t i) { writeImpulse(i, pgs); });
}

template <class Wide>
void BasicLaneSweeper<Wide>::writeImpulse(std::size_t contact, const PgsBatch& pgs) const {
    const std::uint32_t slot = groups_.slots()[contact];
    const Wide& wide = contacts_[slot / lane_count];
    Contact& to = pgs.contacts[pgs.batch.contacts[first_ + contact]];
    to.impulse += laneOf(wide.impulse, slot % lane_count);
    if constexpr (std::is_same_v<Wide, WideRollingContact>)
        to.angular_impulse += laneOf(wide.turning, slot % lane_count);
}

template class BasicLaneSweeper<WideContact>;
template class BasicLaneSweeper<WideRollingContact>;

}  // namespace cairn
