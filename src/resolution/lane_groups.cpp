#include "resolution/lane_groups.h"

#include <algorithm>
#include <numeric>

namespace cairn {

namespace {

/// Pairs with more contacts are put together as if they had so many.
constexpr std::size_t most_alike = 16;
constexpr std::size_t alike_sizes = most_alike + 1;

std::size_t difference(std::size_t a, std::size_t b) {
    return a > b ? a - b : b - a;
}

}  // namespace

void LaneGroups::clear(std::span<const ContactEnds> ends, std::size_t moving) {
    ends_ = ends;
    moving_ = moving;
    groups_.clear();
    set_begin_.assign(1, 0);
    shared_ = 0;
    contact_of_.clear();
    slot_of_.resize(ends.size());
}

void LaneGroups::byColours(std::span<const ContactEnds> ends, std::size_t moving) {
    clear(ends, moving);
    colours_.colour(ends, moving);
    shared_ = colours_.shared();
    for (std::size_t c = 0; c < colours_.colours(); ++c) {
        addColour(c);
        set_begin_.push_back(groups_.size());
    }
}

/// Groups of pairs with equally many contacts, as far as there are such.
void LaneGroups::addColour(std::size_t colour) {
    std::array<PairsOfLanes, alike_sizes> waiting;
    std::array<std::size_t, alike_sizes> waiting_count{};
    for (std::size_t p = 0; p < colours_.pairs(colour); ++p) {
        const std::size_t begin = colours_.begin(colour, p);
        const Pair pair{begin, colours_.begin(colour, p + 1) - begin};
        if (!colours_.isShared(colour)) {
            add({pair}, colours_.order());
            continue;
        }
        const std::size_t alike = std::min(pair.size, most_alike);
        waiting[alike][waiting_count[alike]++] = pair;
        if (waiting_count[alike] < lane_count) continue;
        add(waiting[alike], colours_.order());
        waiting_count[alike] = 0;
    }
    PairsOfLanes rest;
    std::size_t rest_count = 0;
    for (std::size_t alike = alike_sizes; alike-- > 0;) {
        for (std::size_t i = 0; i < waiting_count[alike]; ++i) {
            rest[rest_count++] = waiting[alike][i];
            if (rest_count < lane_count) continue;
            add(rest, colours_.order());
            rest.fill({});
            rest_count = 0;
        }
    }
    if (rest_count > 0) add(rest, colours_.order());
}

void LaneGroups::inOrder(std::span<const ContactEnds> ends, std::size_t moving) {
    clear(ends, moving);
    begun_.clear();
    unfilled_.clear();
    next_.assign(moving, 0);
    as_they_come_.resize(ends.size());
    std::iota(as_they_come_.begin(), as_they_come_.end(), 0);
    for (std::size_t i = 0; i < ends.size();) {
        Pair pair{i, 1};
        while (i + pair.size < ends.size() && ends[i + pair.size] == ends[i]) ++pair.size;
        begin(pair);
        i += pair.size;
    }
    for (const Begun& group : begun_) add(group.pairs, as_they_come_);
    set_begin_.push_back(groups_.size());
}

/// Gives a pair a place in a group after those of its bodies so far: in that whose largest pair has most nearly as many
/// contacts, and of these the first.
void LaneGroups::begin(const Pair& pair) {
    const ContactEnds& ends = ends_[pair.begin];
    std::uint32_t earliest = 0;
    for (const std::uint32_t body : {ends.a, ends.b}) {
        if (body < moving_) earliest = std::max(earliest, next_[body]);
    }
    auto best = unfilled_.end();
    std::size_t least = SIZE_MAX;
    for (auto it = std::ranges::lower_bound(unfilled_, earliest); it != unfilled_.end() && least > 0; ++it) {
        const std::size_t unlike = difference(begun_[*it].size, pair.size);
        if (unlike >= least) continue;
        least = unlike;
        best = it;
    }
    if (best == unfilled_.end()) {
        best = unfilled_.insert(best, static_cast<std::uint32_t>(begun_.size()));
        begun_.push_back({});
    }
    const std::uint32_t group = *best;
    Begun& begun = begun_[group];
    begun.pairs[begun.count++] = pair;
    begun.size = std::max(begun.size, pair.size);
    if (begun.count == lane_count) unfilled_.erase(best);
    for (const std::uint32_t body : {ends.a, ends.b}) {
        if (body < moving_) next_[body] = group + 1;
    }
}

/// @param pairs some of which are there @param order their places are those of it
void LaneGroups::add(const PairsOfLanes& pairs, std::span<const std::uint32_t> order) {
    LaneGroup group;
    group.begin = static_cast<std::uint32_t>(rows());
    const Pair& longest = *std::ranges::max_element(pairs, {}, &Pair::size);
    const std::size_t length = longest.size;
    group.end = group.begin + static_cast<std::uint32_t>(length);
    contact_of_.resize(contact_of_.size() + length * lane_count, no_contact);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        // An empty lane repeats another pair, which can be computed with.
        const Pair& pair = pairs[lane].size > 0 ? pairs[lane] : longest;
        const ContactEnds& ends = ends_[order[pair.begin]];
        group.a[lane] = ends.a;
        group.b[lane] = ends.b;
        if (pairs[lane].size == 0) continue;
        group.moves[lane] = static_cast<std::uint8_t>((ends.a < moving_ ? 1 : 0) | (ends.b < moving_ ? 2 : 0));
        for (std::size_t i = 0; i < pair.size; ++i) {
            const std::size_t slot = (group.begin + i) * lane_count + lane;
            contact_of_[slot] = order[pair.begin + i];
            slot_of_[order[pair.begin + i]] = static_cast<std::uint32_t>(slot);
        }
    }
    groups_.push_back(group);
}

}  // namespace cairn
