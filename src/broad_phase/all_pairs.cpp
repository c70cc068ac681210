#include "broad_phase/all_pairs.h"

#include <algorithm>
#include <functional>

namespace cairn {

namespace {

/// Bodies per work item: small, since low bodies have many more partners above them than high ones.
constexpr std::size_t block_size = 64;

bool mayCollide(const BroadPhaseInput& input, BodyIndex a, BodyIndex b) {
    if (input.kind[a] == BodyKind::hole || input.kind[b] == BodyKind::hole) return false;
    if (input.kind[a] == BodyKind::fixed && input.kind[b] == BodyKind::fixed) return false;
    if (input.isStill(a) && input.isStill(b)) return false;
    return input.bounds[a].overlaps(input.bounds[b]);
}

}  // namespace

void AllPairs::findPairs(const BroadPhaseInput& input, const Executor& executor, std::vector<BodyPair>& pairs) {
    const auto slots = static_cast<BodyIndex>(input.kind.size());
    const std::size_t blocks = (slots + block_size - 1) / block_size;
    if (blocks_.size() < blocks) blocks_.resize(blocks);

    const auto search = [&](std::size_t block, int) {
        PairBuffer& found = blocks_[block];
        found.clear();
        const auto end = static_cast<BodyIndex>(std::min<std::size_t>(slots, (block + 1) * block_size));
        for (auto a = static_cast<BodyIndex>(block * block_size); a < end; ++a) {
            for (BodyIndex b = a + 1; b < slots; ++b) {
                if (!mayCollide(input, a, b)) continue;
                *found.reserve(1) = {a, b};
                found.commit(1);
            }
        }
    };
    executor.forEachDynamic(blocks, std::cref(search));

    // Blocks ascend by a and each block is sorted, so the result is.
    pairs.clear();
    for (std::size_t block = 0; block < blocks; ++block) {
        const auto found = blocks_[block].pairs();
        pairs.insert(pairs.end(), found.begin(), found.end());
    }
}

}  // namespace cairn
