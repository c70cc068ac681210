#include "broad_phase/cell_table.h"

#include <algorithm>
#include <bit>

namespace cairn {

void CellTable::reset(std::size_t entries) {
    keys_.clear();
    places_.assign(std::bit_ceil(std::max<std::size_t>(2 * entries, 16)), Place{});
    mask_ = places_.size() - 1;
}

std::uint32_t CellTable::enter(const CellKey& key) {
    const std::uint64_t hash = key.hash();
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t place = hash & mask_;; place = (place + 1) & mask_) {
        Place& at = places_[place];
        if (at.cell == none) {
            at = {tag, static_cast<std::uint32_t>(keys_.size())};
            keys_.push_back(key);
            return at.cell;
        }
        if (at.tag == tag && keys_[at.cell] == key) return at.cell;
    }
}

}  // namespace cairn
