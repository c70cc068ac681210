/// @file The blocks of cells in which there are bodies, of all levels, found by a hash of their coordinates.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace cairn {

/// Names a block of 4 × 4 × 4 cells: its level and its integer coordinates in units of four cell edges.
struct BlockKey {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;
    std::int64_t level = 0;

    friend bool operator==(const BlockKey&, const BlockKey&) = default;

    std::uint64_t hash() const {
        // Odd multipliers per coordinate, then a fold so that the low bits depend on all of them.
        std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u +
                          static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu +
                          static_cast<std::uint64_t>(z) * 0x165667b19e3779f9u +
                          static_cast<std::uint64_t>(level) * 0xd6e8feb86659fd93u;
        h ^= h >> 32;
        h *= 0xff51afd7ed558ccdu;
        return h ^ (h >> 32);
    }
};

/// Cells of a block, of which only those with bodies exist: they are numbered block by block, and within a block by
/// their position x + 4 y + 16 z.
struct Block {
    BlockKey key;
    std::uint64_t occupied = 0;    ///< bit per position
    std::uint64_t moved = 0;       ///< bit per position: it has a body that is not still
    std::uint32_t first_cell = 0;  ///< number of the cell at the lowest occupied position

    bool has(unsigned position) const { return (occupied >> position & 1) != 0; }
    bool hasMoved(unsigned position) const { return (moved >> position & 1) != 0; }
    /// @pre has(position)
    std::uint32_t cell(unsigned position) const {
        const std::uint64_t below = occupied & ((std::uint64_t{1} << position) - 1);
        return first_cell + static_cast<std::uint32_t>(std::popcount(below));
    }
};

/// Blocks are numbered in the order in which they are first entered. Lookups compare whole keys, so equal hashes only
/// cost time. Open addressing with linear probing, at most half full.
class BlockTable {
  public:
    static constexpr std::uint32_t none = UINT32_MAX;

    /// Forgets all blocks, but expects about as many again.
    void reset();
    /// Number of the block, which is added if it is new.
    std::uint32_t enter(const BlockKey& key);
    /// The block or null.
    const Block* find(const BlockKey& key) const {
        const std::uint64_t hash = key.hash();
        const auto tag = static_cast<std::uint32_t>(hash >> 32);
        for (std::size_t place = hash & mask_;; place = (place + 1) & mask_) {
            const Place& at = places_[place];
            if (at.block == none) return nullptr;
            if (at.tag == tag && blocks_[at.block].key == key) return &blocks_[at.block];
        }
    }

    std::vector<Block>& blocks() { return blocks_; }
    const std::vector<Block>& blocks() const { return blocks_; }

  private:
    struct Place {
        std::uint32_t tag = 0;
        std::uint32_t block = none;
    };

    void resize(std::size_t places);

    std::vector<Place> places_;
    std::vector<Block> blocks_;
    std::size_t mask_ = 0;
};

}  // namespace cairn
