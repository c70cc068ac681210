#include "broad_phase/block_table.h"

#include <algorithm>

namespace cairn {

void BlockTable::reset() {
    const std::size_t places = std::bit_ceil(std::max<std::size_t>(2 * blocks_.size(), 64));
    blocks_.clear();
    resize(places);
}

std::uint32_t BlockTable::enter(const BlockKey& key) {
    const std::uint64_t hash = key.hash();
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t place = hash & mask_;; place = (place + 1) & mask_) {
        Place& at = places_[place];
        if (at.block != none) {
            if (at.tag == tag && blocks_[at.block].key == key) return at.block;
            continue;
        }
        const auto number = static_cast<std::uint32_t>(blocks_.size());
        at = {tag, number};
        blocks_.push_back({.key = key});
        if (2 * blocks_.size() > places_.size()) resize(2 * places_.size());
        return number;
    }
}

void BlockTable::resize(std::size_t places) {
    places_.assign(places, Place{});
    mask_ = places - 1;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const std::uint64_t hash = blocks_[b].key.hash();
        std::size_t place = hash & mask_;
        while (places_[place].block != none) place = (place + 1) & mask_;
        places_[place] = {static_cast<std::uint32_t>(hash >> 32), static_cast<std::uint32_t>(b)};
    }
}

}  // namespace cairn
