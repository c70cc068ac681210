/// The part of PairTable that follows bodies which come, go and stand in other slots.
#include "math/arrays.h"
#include "pairs/pair_table.h"

namespace cairn {

void PairTable::adopt(std::span<const Contact> contacts) {
    ++layout_;
    neighbours_.begin(contacts);
    known_ = false;
    bounds_.clear();
}

void PairTable::change(const PairChange& change, std::vector<Contact>& contacts) {
    ++layout_;
    changed_pairs_.clear();
    changed_contacts_.clear();
    auto next = change.contacts.begin();
    const auto addCameBefore = [&](const BodyPair& end) {
        while (next != change.contacts.end() && BodyPair{next->a, next->b} < end) {
            ContactPair pair{{next->a, next->b}, static_cast<std::uint32_t>(changed_contacts_.size()), 0};
            for (; next != change.contacts.end() && next->a == pair.a && next->b == pair.b; ++next, ++pair.count) {
                changed_contacts_.push_back(*next);
            }
            changed_pairs_.push_back(pair);
        }
    };
    for (ContactPair pair : pairs()) {
        if ((change.left[pair.a] | change.left[pair.b]) != 0) continue;
        addCameBefore(pair);
        if (pair.touches()) {
            const auto first = contacts.begin() + pair.first;
            pair.first = static_cast<std::uint32_t>(changed_contacts_.size());
            changed_contacts_.insert(changed_contacts_.end(), first, first + pair.count);
        }
        changed_pairs_.push_back(pair);
    }
    addCameBefore({UINT32_MAX, UINT32_MAX});
    neighbours_.replace(change.left, changed_pairs_);
    contacts.swap(changed_contacts_);
    came_.insert(came_.end(), change.came.begin(), change.came.end());
}

void PairTable::rearrange(const SlotMove& move) {
    ++layout_;
    neighbours_.rearrange(move);
    cairn::rearrange(ahead_, move, {});
    cairn::rearrange(unmoved_, move, 0);
    cairn::rearrange(bounds_, move, {});
    for (BodyIndex& body : came_) body = move(body);
    std::erase(came_, no_slot);
}

}  // namespace cairn
