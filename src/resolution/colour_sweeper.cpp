#include "resolution/colour_sweeper.h"

#include <algorithm>

#include "math/arrays.h"
#include "resolution/fill_contact.h"
#include "resolution/release_sliding.h"

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

void ColourSweeper::prepare(const PgsBatch& pgs, std::size_t contacts) {
    groups_.clear();
    contact_of_.clear();
    slot_of_.resize(contacts);
    colours_.colour(std::span(pgs.local.ends).first(contacts), pgs.local.dynamic_bodies);
    arrange(pgs.local);
    contacts_ = firstOf(contact_memory_, contact_of_.size() / lane_count);
}

void ColourSweeper::start(const PgsBatch& pgs) {
    pgs.executor.forBlocks(
        groups_.size(),
        [&](std::size_t begin, std::size_t end, int) {
            runOnLanes<Lanes>([&]() __attribute__((always_inline)) {
                for (std::size_t g = begin; g < end; ++g) fill(groups_[g], pgs);
            });
        },
        group_grain);
    for (std::size_t c = 0; c < colours(); ++c) {
        visitGroups<Way::forth>(
            c, pgs,
            [](std::span<WideContact> contacts, PgsBody<Lanes> & a, PgsBody<Lanes> & b) __attribute__((always_inline)) {
                for (const WideContact& contact : contacts) push(contact, contact.impulse, a, b);
            });
    }
}

/// Empty lanes repeat the first contact of the lane, or of another where it has none.
[[gnu::always_inline]] inline void ColourSweeper::fill(const Group& group, const PgsBatch& pgs) {
    const PgsBody<Lanes> a = load(pgs.local.bodies, group.a);
    const PgsBody<Lanes> b = load(pgs.local.bodies, group.b);
    const std::uint32_t* const first = &contact_of_[group.begin * lane_count];
    const std::uint32_t any = *std::min_element(first, first + lane_count);
    for (std::size_t i = group.begin; i < group.end; ++i) {
        Sources sources;
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
            const std::uint32_t index = contact_of_[i * lane_count + lane];
            sources.fills[lane] = index != empty_lane;
            const std::uint32_t substitute = first[lane] == empty_lane ? any : first[lane];
            sources.contacts[lane] = &pgs.contacts[pgs.batch.contacts[index == empty_lane ? substitute : index]];
        }
        fillContact(contacts_[i], a, b, sources, pgs.bodies.position, pgs.settings);
    }
}

/// Groups of pairs with equally many contacts, as far as there are such.
void ColourSweeper::arrange(const LocalBatch& local) {
    group_begin_.assign(1, 0);
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
            if (waiting_count[alike] < lane_count) continue;
            addGroup(waiting[alike], colours_.order(), local);
            waiting_count[alike] = 0;
        }
        PairsOfLanes rest;
        std::size_t rest_count = 0;
        for (std::size_t alike = alike_sizes; alike-- > 0; waiting_count[alike] = 0) {
            for (std::size_t i = 0; i < waiting_count[alike]; ++i) {
                rest[rest_count++] = waiting[alike][i];
                if (rest_count < lane_count) continue;
                addGroup(rest, colours_.order(), local);
                rest.fill({});
                rest_count = 0;
            }
        }
        if (rest_count > 0) addGroup(rest, colours_.order(), local);
        group_begin_.push_back(groups_.size());
    }
}

/// @param pairs some of which are there
void ColourSweeper::addGroup(const PairsOfLanes& pairs, std::span<const std::uint32_t> order, const LocalBatch& local) {
    Group group;
    group.begin = static_cast<std::uint32_t>(contact_of_.size() / lane_count);
    const Pair& longest = *std::ranges::max_element(pairs, {}, &Pair::size);
    const std::size_t length = longest.size;
    group.end = group.begin + static_cast<std::uint32_t>(length);
    contact_of_.resize(contact_of_.size() + length * lane_count, empty_lane);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        // An empty lane repeats another pair, which can be computed with.
        const Pair& pair = pairs[lane].size > 0 ? pairs[lane] : longest;
        const ContactEnds& ends = local.ends[order[pair.begin]];
        group.a[lane] = ends.a;
        group.b[lane] = ends.b;
        if (pairs[lane].size == 0) continue;
        group.moves[lane] =
            static_cast<std::uint8_t>((local.isFixed(ends.a) ? 0 : 1) | (local.isFixed(ends.b) ? 0 : 2));
        for (std::size_t i = 0; i < pair.size; ++i) {
            const std::size_t slot = (group.begin + i) * lane_count + lane;
            contact_of_[slot] = order[pair.begin + i];
            slot_of_[order[pair.begin + i]] = static_cast<std::uint32_t>(slot);
        }
    }
    groups_.push_back(group);
}

/// Calls visit(contacts, a, b) for every group of a colour, in ascending order or, where their order matters on the way
/// back, in descending order.
template <ColourSweeper::Way way, class Visit>
void ColourSweeper::visitGroups(std::size_t colour, const PgsBatch& pgs, const Visit& visit) {
    const std::size_t first = group_begin_[colour];
    const std::size_t count = group_begin_[colour + 1] - first;
    std::vector<LocalBody>& bodies = pgs.local.bodies;
    const auto work = [&](std::size_t begin, std::size_t end, int) {
        runOnLanes<Lanes>([&]() __attribute__((always_inline)) {
            for (std::size_t n = begin; n < end; ++n) {
                const Group& group = groups_[way == Way::forth ? first + n : first + count - 1 - n];
                PgsBody<Lanes> a = load(bodies, group.a);
                PgsBody<Lanes> b = load(bodies, group.b);
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

void ColourSweeper::sweepForth(const PgsBatch& pgs) {
    for (std::size_t c = 0; c < colours(); ++c) {
        visitGroups<Way::forth>(
            c, pgs,
            [](std::span<WideContact> contacts, PgsBody<Lanes> & a, PgsBody<Lanes> & b) __attribute__((always_inline)) {
                for (WideContact& contact : contacts) visit(contact, a, b);
            });
    }
}

void ColourSweeper::sweepBack(const PgsBatch& pgs) {
    for (std::size_t c = colours(); c-- > 0;) {
        visitGroups<Way::back>(
            c, pgs,
            [](std::span<WideContact> contacts, PgsBody<Lanes> & a, PgsBody<Lanes> & b) __attribute__((always_inline)) {
                for (std::size_t i = contacts.size(); i-- > 0;) visit(contacts[i], a, b);
            });
    }
}

void ColourSweeper::save(const PgsBatch& pgs) {
    resizeTightly(before_, contacts_.size());
    forEach(
        before_.size(), pgs.executor, [&](std::size_t i) { before_[i] = contacts_[i].impulse; }, wide_grain);
}

SweepChange ColourSweeper::change(const PgsBatch& pgs) {
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

/// Of some wide contacts, lane by lane.
std::array<SweepChange, lane_count> ColourSweeper::changeOf(std::size_t begin, std::size_t end) const {
    std::array<SweepChange, lane_count> change;
    runOnLanes<Lanes>([&]() __attribute__((always_inline)) {
        Lanes squared{};
        Lanes largest{};
        for (std::size_t i = begin; i < end; ++i) {
            const WideContact& contact = contacts_[i];
            const Triple<Lanes> difference = contact.impulse - before_[i];
            const Lanes weighted = difference.squaredNorm() / contact.normal_mass;
            const Lanes speed = (contact.k * difference).squaredNorm();
            squared += where(contact.normal_mass > 0, weighted, Lanes{});
            largest = where(speed > largest, speed, largest);
        }
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
            change[lane] = {laneOf(squared, lane), std::sqrt(laneOf(largest, lane))};
        }
    });
    return change;
}

void ColourSweeper::restart() {
    direction_.clear();
    resizeTightly(direction_, contacts_.size());
}

void ColourSweeper::accelerate(double beta, const PgsBatch& pgs) {
    pgs.executor.forBlocks(
        contacts_.size(),
        [&](std::size_t begin, std::size_t end, int) {
            runOnLanes<Lanes>([&]() __attribute__((always_inline)) {
                const Lanes factor = beta + Lanes{};
                for (std::size_t i = begin; i < end; ++i) {
                    const Triple<Lanes> change = contacts_[i].impulse - before_[i];
                    const Triple<Lanes> step = factor * direction_[i];
                    contacts_[i].impulse += step;
                    direction_[i] = change + step;
                }
            });
        },
        wide_grain);
}

PgsContact ColourSweeper::contactAt(std::size_t contact, const PgsBatch& pgs) const {
    const std::uint32_t slot = slot_of_[contact];
    PgsContact s = laneOf(contacts_[slot / lane_count], slot % lane_count);
    s.a = pgs.local.ends[contact].a;
    s.b = pgs.local.ends[contact].b;
    return s;
}

bool ColourSweeper::releaseSliding(const PgsBatch& pgs) {
    const auto at = [&](std::size_t i) { return contactAt(i, pgs); };
    return releaseSlidingOf(pgs, slot_of_.size(), at, [&](std::size_t i, double friction) {
        setLane(contacts_[slot_of_[i] / lane_count].friction, slot_of_[i] % lane_count, friction);
    });
}

void ColourSweeper::finish(const PgsBatch& pgs) {
    forEach(slot_of_.size(), pgs.executor, [&](std::size_t i) { writeImpulse(i, pgs); });
}

void ColourSweeper::writeImpulse(std::size_t contact, const PgsBatch& pgs) const {
    const WideContact& wide = contacts_[slot_of_[contact] / lane_count];
    pgs.contacts[pgs.batch.contacts[contact]].impulse += laneOf(wide.impulse, slot_of_[contact] % lane_count);
}

}  // namespace cairn
