#include "batches/follow_progress.h"

#include <algorithm>
#include <utility>

namespace cairn {

namespace {

/// A round helps a chain if it leaves at most this part of what the last one left that helped. After so many that did
/// not it is given up.
constexpr double worthwhile = 0.5;
constexpr int most_useless = 6;

}  // namespace

void FollowProgress::begin(std::span<const BodyKind> kind) {
    kind_ = kind;
    for (const BodyIndex i : members_) {
        bodies_.part(i);
        chains_[i] = {};
    }
    members_.clear();
    if (kind.size() <= chains_.size()) return;
    bodies_.grow(kind.size());
    chains_.resize(kind.size());
}

void FollowProgress::join(std::span<const BatchView> groups) {
    for (const BatchView& group : groups) {
        for (const BodyIndex i : group.bodies) join(group.bodies.front(), i);
    }
}

void FollowProgress::giveUp(std::vector<std::uint32_t>& left, std::span<const std::uint32_t> added,
                            std::span<const Contact> contacts, FunctionRef<double(std::uint32_t)> amountOf) {
    if (left.empty()) return;
    const auto joinBodies = [&](std::uint32_t i) {
        const auto& [a, b] = std::pair(contacts[i].a, contacts[i].b);
        if (kind_[a] == BodyKind::dynamic && kind_[b] == BodyKind::dynamic) join(a, b);
    };
    const auto chainOf = [&](std::uint32_t i) -> Chain& { return chains_[rootOf(contacts[i])]; };
    std::ranges::for_each(left, joinBodies);
    std::ranges::for_each(added, joinBodies);
    roots_.clear();
    for (const std::uint32_t i : left) roots_.push_back(rootOf(contacts[i]));
    std::ranges::sort(roots_);
    roots_.erase(std::unique(roots_.begin(), roots_.end()), roots_.end());
    members_.insert(members_.end(), roots_.begin(), roots_.end());
    for (const BodyIndex root : roots_) {
        chains_[root].amount = 0;
        chains_[root].struck = false;
    }
    for (const std::uint32_t i : left) chainOf(i).amount += amountOf(i);
    for (const std::uint32_t i : added) chainOf(i).struck = true;
    for (const BodyIndex root : roots_) {
        Chain& chain = chains_[root];
        if (chain.struck || chain.helped == 0 || chain.amount <= worthwhile * chain.helped) {
            chain.helped = chain.amount;
            chain.useless = 0;
        } else {
            ++chain.useless;
        }
    }
    std::erase_if(left, [&](std::uint32_t i) { return chainOf(i).useless >= most_useless; });
}

/// Of the body that moves.
BodyIndex FollowProgress::rootOf(const Contact& contact) {
    return bodies_.find(kind_[contact.a] == BodyKind::dynamic ? contact.a : contact.b);
}

void FollowProgress::join(BodyIndex a, BodyIndex b) {
    const auto [low, high] = std::minmax({bodies_.find(a), bodies_.find(b)});
    if (low == high) return;
    members_.insert(members_.end(), {low, high});
    bodies_.join(low, high);
    Chain& chain = chains_[low];
    const Chain& other = chains_[high];
    if (other.helped == 0) return;
    chain.useless = chain.helped == 0 ? other.useless : std::min(chain.useless, other.useless);
    chain.helped += other.helped;
}

}  // namespace cairn
