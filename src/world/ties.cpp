#include "world/ties.h"

#include <numeric>

namespace cairn {

template <class Tie>
void TiesOfBodies::fill(std::span<const Tie> ties, std::size_t slots, Lists& lists) {
    lists.begin.clear();
    lists.ties.clear();
    if (ties.empty()) return;
    // One place too many in front: filling moves each begin on to where the next body's would be.
    lists.begin.assign(slots + 2, 0);
    const auto forEnds = [&](const auto& visit) {
        for (std::uint32_t t = 0; t < ties.size(); ++t) {
            if (!ties[t].present) continue;
            // The world as an end is beyond all slots.
            for (const BodyIndex body : {ties[t].a, ties[t].b}) {
                if (body < slots) visit(body, t);
            }
        }
    };
    forEnds([&](BodyIndex body, std::uint32_t) { ++lists.begin[body + 2]; });
    std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
    lists.ties.resize(lists.begin.back());
    forEnds([&](BodyIndex body, std::uint32_t tie) { lists.ties[lists.begin[body + 1]++] = tie; });
    lists.begin.pop_back();
}

void TiesOfBodies::list(std::span<const Spring> springs, std::span<const Joint> joints, std::size_t slots) {
    if (known_) return;
    fill(springs, slots, springs_);
    fill(joints, slots, joints_);
    known_ = true;
}

}  // namespace cairn
