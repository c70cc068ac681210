/// @file The cells of all levels in which there are bodies, found by a hash of their coordinates.
#pragma once

#include <cstdint>
#include <vector>

namespace cairn {

/// Names a cell: its level and its integer coordinates in units of the level's edge.
struct CellKey {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;
    std::int64_t level = 0;

    friend bool operator==(const CellKey&, const CellKey&) = default;

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

/// Cells are numbered in the order in which they are first entered. Lookups compare whole keys, so equal hashes only
/// cost time. Open addressing with linear probing, at most half full.
class CellTable {
  public:
    static constexpr std::uint32_t none = UINT32_MAX;

    /// Forgets all cells. @param entries upper limit for the number of cells to come
    void reset(std::size_t entries);
    /// Number of the cell, which is added if it is new.
    std::uint32_t enter(const CellKey& key);
    /// Number of the cell or `none`.
    std::uint32_t find(const CellKey& key) const {
        const std::uint64_t hash = key.hash();
        const auto tag = static_cast<std::uint32_t>(hash >> 32);
        for (std::size_t place = hash & mask_;; place = (place + 1) & mask_) {
            const Place& at = places_[place];
            if (at.cell == none) return none;
            if (at.tag == tag && keys_[at.cell] == key) return at.cell;
        }
    }

    std::size_t size() const { return keys_.size(); }
    const CellKey& key(std::size_t cell) const { return keys_[cell]; }

  private:
    struct Place {
        std::uint32_t tag = 0;
        std::uint32_t cell = none;
    };

    std::vector<Place> places_;
    std::vector<CellKey> keys_;  ///< per cell
    std::size_t mask_ = 0;
};

}  // namespace cairn
