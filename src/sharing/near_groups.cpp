#include "sharing/near_groups.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "messages/packing.h"
#include "sharing/body_records.h"

namespace cairn {

void NearGroups::meet(std::span<const CoveredBody> own, std::span<const CoveredBody> others, BroadPhase& search,
                      const Executor& executor) {
    across_.clear();
    met_.clear();
    met_homes_.clear();
    if (own.empty() || others.empty()) return;
    cover_.clear();
    for (const auto bodies : {own, others}) {
        for (const CoveredBody& body : bodies) cover_.push_back(body.cover);
    }
    // So no pairs of two bodies of this rank are found, and none of two others.
    kind_.assign(own.size(), BodyKind::dynamic);
    kind_.resize(cover_.size(), BodyKind::fixed);
    still_.assign(own.size(), 1);
    still_.resize(cover_.size(), 0);
    search.findPairs({.kind = kind_, .bounds = cover_, .still = still_}, executor, pairs_);
    for (const BodyPair& pair : pairs_) {
        across_.push_back({own[pair.a].home, others[pair.b - own.size()].home});
        if (met_.empty() || met_.back() != pair.a) met_.push_back(pair.a);
    }
    for (const std::uint32_t i : met_) met_homes_.push_back(own[i].home);
}

void NearGroups::find(const NearGroupsInput& input) {
    own_ = input.bodies.size();
    behind_.clear();
    home_.clear();
    cover_.clear();
    for (const CoveredBody& body : input.bodies) {
        home_.push_back(body.home);
        cover_.push_back(body.cover);
    }
    parent_.resize(own_);
    std::iota(parent_.begin(), parent_.end(), 0);
    kind_.assign(own_, BodyKind::dynamic);
    input.search.findPairs({.kind = kind_, .bounds = cover_}, input.executor, pairs_);
    for (const BodyPair& pair : pairs_) join(pair.a, pair.b);
    for (const BodyPair& pair : input.joined) join(pair.a, pair.b);
    box_.assign(own_, emptyBounds());
    for (BodyIndex i = 0; i < own_; ++i) include(box_[representative(i)], {input.position[i], input.position[i]});
}

/// Each rank tells which of its bodies met those of others, with what else of its groups they are, and the pairs.
void NearGroups::joinAcross(Ranks& ranks) {
    std::vector<std::byte> message;
    pack(message, static_cast<std::uint64_t>(met_homes_.size()));
    for (const BodyIndex home : met_homes_) {
        const BodyIndex group = representative(entryOf(home));
        pack(message, home);
        pack(message, home_[group]);
        packBounds(message, box_[group]);
    }
    // The other rank finds each pair as well.
    for (const Across& pair : across_) {
        if (pair.own < pair.other) pack(message, BodyPair{pair.own, pair.other});
    }
    std::vector<std::pair<BodyIndex, Bounds>> boxes;
    for (const auto& told : tellAll(ranks, message)) {
        Unpacker in(told);
        for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
            const BodyIndex i = entryOf(in.get<BodyIndex>());
            const BodyIndex group = entryOf(in.get<BodyIndex>());
            boxes.emplace_back(group, unpackBounds(in));
            join(i, group);
        }
        while (!in.isAtEnd()) {
            const auto pair = in.get<BodyPair>();
            join(entryOf(pair.a), entryOf(pair.b));
        }
    }
    // All parts of these groups were told, those of this rank as well.
    for (const auto& [group, box] : boxes) box_[representative(group)] = emptyBounds();
    for (const auto& [group, box] : boxes) include(box_[representative(group)], box);
}

/// The entry of a body on any rank; one of which nothing was known is a group by itself.
BodyIndex NearGroups::entryOf(BodyIndex home) {
    const auto own = std::span(home_).first(own_);
    const auto place = std::ranges::lower_bound(own, home);
    if (place != own.end() && *place == home) return static_cast<BodyIndex>(place - own.begin());
    const auto [entry, is_new] = behind_.emplace(home, static_cast<BodyIndex>(home_.size()));
    if (is_new) {
        home_.push_back(home);
        parent_.push_back(entry->second);
        box_.push_back(emptyBounds());
    }
    return entry->second;
}

BodyIndex NearGroups::representative(BodyIndex i) {
    while (parent_[i] != i) {
        parent_[i] = parent_[parent_[i]];
        i = parent_[i];
    }
    return i;
}

/// The lower of two representatives stays one, so that a group is named by its lowest body.
void NearGroups::join(BodyIndex a, BodyIndex b) {
    const BodyIndex p = representative(a);
    const BodyIndex q = representative(b);
    if (home_[p] < home_[q]) {
        parent_[q] = p;
    } else {
        parent_[p] = q;
    }
}

}  // namespace cairn
