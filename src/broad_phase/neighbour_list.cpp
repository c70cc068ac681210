#include "broad_phase/neighbour_list.h"

#include <algorithm>

#include "math/arrays.h"

namespace cairn {

namespace {

/// Covered bounds are larger by this part of the body's smallest extent, on all sides …
constexpr double slack = 0.15;
/// … and by its way in the time that follows [s].
constexpr double time_ahead = 1.0 / 60;

/// Of a body that moves on.
Bounds boundsAhead(const Bounds& bounds, const Vec3& way) {
    Bounds ahead = bounds.grown(slack * (bounds.upper - bounds.lower).minCoeff());
    ahead.lower += way.cwiseMin(0);
    ahead.upper += way.cwiseMax(0);
    return ahead;
}

/// Adds sorted pairs to sorted pairs, from behind, so that nothing is written over before its turn.
void merge(std::span<const BodyPair> added, std::vector<ContactPair>& pairs) {
    std::size_t left = pairs.size();
    resizeTightly(pairs, pairs.size() + added.size());
    for (std::size_t place = pairs.size(); !added.empty(); --place) {
        if (left > 0 && added.back() < pairs[left - 1]) {
            pairs[place - 1] = pairs[--left];
        } else {
            pairs[place - 1] = {added.back()};
            added = added.first(added.size() - 1);
        }
    }
}

}  // namespace

void NeighbourList::update(const NeighbourListInput& input, BroadPhase& broad_phase, const Executor& executor) {
    const bool searched_before = searched_;
    searched_ = findLeft(input, executor);
    if (!searched_) return;
    cover(input, !searched_before, executor);
    broad_phase.findPairs({.kind = input.kind, .bounds = covered_, .still = stays_}, executor, new_pairs_);
    dropLeft();
    merge(new_pairs_, pairs_);
}

void NeighbourList::begin(std::span<const Contact> contacts) {
    pairs_.clear();
    for (std::uint32_t i = 0; i < contacts.size(); ++i) {
        const BodyPair pair{contacts[i].a, contacts[i].b};
        if (pairs_.empty() || pairs_.back() != pair) appendTightly(pairs_, {pair, i, 0});
        ++pairs_.back().count;
    }
    kind_.clear();
}

void NeighbourList::drop(std::span<const std::uint8_t> others) {
    for (std::size_t i = 0; i < std::min(others.size(), kind_.size()); ++i) {
        if (others[i] != 0) kind_[i] = BodyKind::hole;
    }
    std::erase_if(pairs_, [&](const ContactPair& pair) { return (others[pair.a] | others[pair.b]) != 0; });
}

void NeighbourList::replace(std::span<const std::uint8_t> left, std::vector<ContactPair>& pairs) {
    for (std::size_t i = 0; i < std::min(left.size(), kind_.size()); ++i) {
        if (left[i] != 0) kind_[i] = BodyKind::hole;
    }
    pairs_.swap(pairs);
}

void NeighbourList::rearrange(const SlotMove& move) {
    for (ContactPair& pair : pairs_) {
        pair.a = move(pair.a);
        pair.b = move(pair.b);
    }
    cairn::rearrange(covered_, move, {});
    cairn::rearrange(kind_, move, BodyKind::hole);
}

/// Drops the pairs that were searched again and not found; of those that were found only the new ones remain in
/// new_pairs_.
void NeighbourList::dropLeft() {
    std::size_t next = 0;
    std::size_t kept = 0;
    std::erase_if(pairs_, [&](const ContactPair& pair) {
        if ((stays_[pair.a] & stays_[pair.b]) != 0) return false;
        while (next < new_pairs_.size() && new_pairs_[next] < pair) new_pairs_[kept++] = new_pairs_[next++];
        const bool found = next < new_pairs_.size() && new_pairs_[next] == pair;
        if (found) ++next;
        return !found;
    });
    const auto rest = std::move(new_pairs_.begin() + static_cast<std::ptrdiff_t>(next), new_pairs_.end(),
                                new_pairs_.begin() + static_cast<std::ptrdiff_t>(kept));
    new_pairs_.erase(rest, new_pairs_.end());
}

/// @return whether a body has left the bounds that it was searched with
bool NeighbourList::findLeft(const NeighbourListInput& input, const Executor& executor) {
    const std::size_t slots = input.kind.size();
    covered_.resize(slots);
    kind_.resize(slots, BodyKind::hole);
    stays_.resize(slots);
    executor.forBlocks(slots, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const bool stays =
                kind_[i] == input.kind[i] && (kind_[i] == BodyKind::hole || covered_[i].contains(input.bounds[i]));
            stays_[i] = stays ? 1 : 0;
        }
    });
    return std::ranges::find(stays_, 0) != stays_.end();
}

/// Gives new bounds to all that moves, so that the next search is not due soon, or only to those that left theirs:
/// where somebody does in every update, as among very many bodies, more would not help.
void NeighbourList::cover(const NeighbourListInput& input, bool all, const Executor& executor) {
    executor.forBlocks(input.kind.size(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const bool moves = input.still[i] == 0 && input.kind[i] != BodyKind::hole;
            if (stays_[i] != 0 && !(all && moves)) continue;
            stays_[i] = 0;
            kind_[i] = input.kind[i];
            if (kind_[i] == BodyKind::hole) continue;
            const Vec3 way = time_ahead * input.v[i];
            covered_[i] =
                kind_[i] == BodyKind::fixed && way.isZero(0) ? input.bounds[i] : boundsAhead(input.bounds[i], way);
        }
    });
}

}  // namespace cairn
