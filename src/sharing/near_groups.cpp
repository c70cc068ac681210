#include "sharing/near_groups.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "messages/packing.h"

namespace cairn {

namespace {

/// Bounds around nothing.
Bounds emptyBounds() {
    constexpr double far = std::numeric_limits<double>::infinity();
    return {Vec3::Constant(far), Vec3::Constant(-far)};
}

void include(Bounds& bounds, const Bounds& other) {
    bounds.lower = bounds.lower.cwiseMin(other.lower);
    bounds.upper = bounds.upper.cwiseMax(other.upper);
}

void packBounds(std::vector<std::byte>& message, const Bounds& bounds) {
    pack(message, bounds.lower);
    pack(message, bounds.upper);
}

Bounds unpackBounds(Unpacker& in) {
    const Vec3 lower = in.get<Vec3>();
    return {lower, in.get<Vec3>()};
}

}  // namespace

void NearGroups::find(const NearGroupsInput& input, const Executor& executor) {
    begin(input);
    searchAll(input);
    connect(input, executor);
    addBoxes(input);
}

bool NearGroups::meetOthers(const NearGroupsInput& input, const Executor& executor, Ranks& ranks) {
    begin(input);
    tellCovers(input, ranks);
    input.search.findPairs({.kind = kind_, .bounds = cover_, .still = others_}, executor, pairs_);
    const bool meets =
        std::ranges::any_of(pairs_, [&](const BodyPair& pair) { return (others_[pair.a] | others_[pair.b]) != 0; });
    const std::vector<std::uint8_t> all = gatherAll(ranks, static_cast<std::uint8_t>(meets ? 1 : 0));
    return std::ranges::find(all, 1) != all.end();
}

void NearGroups::findAcross(const NearGroupsInput& input, const Executor& executor, Ranks& ranks) {
    searchAll(input);
    connect(input, executor);
    addBoxes(input);
    connectAcross(ranks);
}

void NearGroups::begin(const NearGroupsInput& input) {
    const std::size_t slots = input.kind.size();
    slots_ = slots;
    behind_.clear();
    home_.resize(slots);
    parent_.resize(slots);
    std::iota(parent_.begin(), parent_.end(), 0);
    if (input.home.empty()) {
        std::iota(home_.begin(), home_.end(), 0);
    } else {
        std::ranges::copy(input.home, home_.begin());
    }
    kind_.assign(slots, BodyKind::hole);
    others_.assign(slots, 0);
    cover_.resize(slots);
    box_.resize(slots);
    for (std::size_t i = 0; i < slots; ++i) {
        if (input.kind[i] == BodyKind::dynamic) cover_[i] = input.cover[i];
    }
}

/// All bodies of this rank are searched, with those of others that were told.
void NearGroups::searchAll(const NearGroupsInput& input) {
    for (std::size_t i = 0; i < slots_; ++i) {
        if (input.kind[i] == BodyKind::dynamic) kind_[i] = BodyKind::dynamic;
    }
}

/// Lets every rank know the covers of the bodies that come near its own; these and those that it told of are searched.
void NearGroups::tellCovers(const NearGroupsInput& input, Ranks& ranks) {
    const auto own = static_cast<std::size_t>(ranks.rank());
    Bounds all = emptyBounds();
    for (BodyIndex i = 0; i < slots_; ++i) {
        if (input.kind[i] == BodyKind::dynamic) include(all, cover_[i]);
    }
    std::vector<std::byte> message;
    packBounds(message, all);
    std::vector<Bounds> reach;
    for (const auto& told : tellAll(ranks, message)) {
        Unpacker in(told);
        reach.push_back(unpackBounds(in));
    }
    Ranks::Messages out(reach.size());
    for (BodyIndex i = 0; i < slots_; ++i) {
        if (input.kind[i] != BodyKind::dynamic) continue;
        for (std::size_t to = 0; to < out.size(); ++to) {
            if (to == own || !cover_[i].overlaps(reach[to])) continue;
            pack(out[to], home_[i]);
            packBounds(out[to], cover_[i]);
            kind_[i] = BodyKind::dynamic;
        }
    }
    for (const auto& told : ranks.exchange(std::move(out))) {
        for (Unpacker in(told); !in.isAtEnd();) {
            const BodyIndex i = entryOf(in.get<BodyIndex>());
            cover_[i] = unpackBounds(in);
            kind_[i] = BodyKind::dynamic;
            others_[i] = 1;
        }
    }
}

/// Joins what is near on this rank, and notes the pairs with bodies of other ranks.
void NearGroups::connect(const NearGroupsInput& input, const Executor& executor) {
    input.search.findPairs({.kind = kind_, .bounds = cover_, .still = others_}, executor, pairs_);
    across_.clear();
    near_others_.clear();
    for (const BodyPair& pair : pairs_) {
        if ((others_[pair.a] | others_[pair.b]) == 0) {
            join(pair.a, pair.b);
        } else {
            across_.push_back(pair);
            near_others_.push_back(others_[pair.a] == 0 ? pair.a : pair.b);
        }
    }
    const auto joinOwn = [&](BodyIndex a, BodyIndex b) {
        if (input.kind[a] == BodyKind::dynamic && input.kind[b] == BodyKind::dynamic) join(a, b);
    };
    for (const Contact& contact : input.contacts) joinOwn(contact.a, contact.b);
    for (const BodyPair& pair : input.tied) joinOwn(pair.a, pair.b);
    std::ranges::sort(near_others_);
    near_others_.erase(std::unique(near_others_.begin(), near_others_.end()), near_others_.end());
}

void NearGroups::addBoxes(const NearGroupsInput& input) {
    for (BodyIndex i = 0; i < input.kind.size(); ++i) {
        if (input.kind[i] == BodyKind::dynamic) box_[i] = emptyBounds();
    }
    for (BodyIndex i = 0; i < input.kind.size(); ++i) {
        if (input.kind[i] != BodyKind::dynamic) continue;
        include(box_[representative(i)], {input.position[i], input.position[i]});
    }
}

/// Joins groups that ranks share: each tells which of its bodies are near those of others, with what else of its
/// groups they are, and the pairs.
void NearGroups::connectAcross(Ranks& ranks) {
    std::vector<std::byte> message;
    pack(message, static_cast<std::uint64_t>(near_others_.size()));
    for (const BodyIndex i : near_others_) {
        const BodyIndex group = representative(i);
        pack(message, home_[i]);
        pack(message, home_[group]);
        packBounds(message, box_[group]);
    }
    for (const BodyPair& pair : across_) {
        // The other rank tells it otherwise.
        if (others_[pair.a] == 0) pack(message, BodyPair{home_[pair.a], home_[pair.b]});
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
    const auto slots = std::span(home_).first(slots_);
    const auto slot = std::ranges::lower_bound(slots, home);
    if (slot != slots.end() && *slot == home) return static_cast<BodyIndex>(slot - slots.begin());
    const auto [place, is_new] = behind_.emplace(home, static_cast<BodyIndex>(home_.size()));
    if (is_new) {
        home_.push_back(home);
        parent_.push_back(place->second);
        kind_.push_back(BodyKind::hole);
        others_.push_back(1);
        cover_.push_back(emptyBounds());
        box_.push_back(emptyBounds());
    }
    return place->second;
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
