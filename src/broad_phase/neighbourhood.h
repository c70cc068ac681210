/// @file Where the neighbours of a cell are: tables over the 64 positions of cells in a block of 4 × 4 × 4.
#pragma once

#include <array>
#include <cstdint>

namespace cairn {

/// A cell relative to a block: which of the 3 × 3 × 3 blocks around it (13 is the block itself), and where in that.
struct RelativeCell {
    std::uint8_t block = 0;
    std::uint8_t position = 0;
};

/// Per position, one half of the 26 neighbours: of each two that lie opposite to each other, one.
using HalfNeighbourhood = std::array<std::array<RelativeCell, 13>, 64>;

constexpr std::uint8_t own_block = 13;

consteval HalfNeighbourhood makeHalfNeighbourhood() {
    HalfNeighbourhood table{};
    for (int position = 0; position < 64; ++position) {
        std::size_t next = 0;
        // Steps 14 … 26 of the 27, counted through x, y, z ∈ {−1, 0, 1}: those after the cell itself.
        for (int step = 14; step < 27; ++step) {
            const int x = position % 4 + step % 3 - 1;
            const int y = position / 4 % 4 + step / 3 % 3 - 1;
            const int z = position / 16 + step / 9 - 1;
            const int block = (x + 4) / 4 + 3 * ((y + 4) / 4) + 9 * ((z + 4) / 4);
            const int inside = (x + 4) % 4 + 4 * ((y + 4) % 4) + 16 * ((z + 4) % 4);
            table[static_cast<std::size_t>(position)][next++] = {static_cast<std::uint8_t>(block),
                                                                 static_cast<std::uint8_t>(inside)};
        }
    }
    return table;
}

inline constexpr HalfNeighbourhood half_neighbourhood = makeHalfNeighbourhood();

/// Per position, a bit for each of the 27 blocks in which half_neighbourhood has a cell.
consteval std::array<std::uint32_t, 64> makeNeededBlocks() {
    std::array<std::uint32_t, 64> needed{};
    for (std::size_t position = 0; position < 64; ++position) {
        for (const RelativeCell& cell : half_neighbourhood[position]) needed[position] |= 1u << cell.block;
    }
    return needed;
}

inline constexpr std::array<std::uint32_t, 64> needed_blocks = makeNeededBlocks();

/// Coordinates of cells in a block, both limits included; they may lie outside of 0 … 3.
struct PositionRange {
    std::int64_t low = 0;
    std::int64_t high = 0;
};

/// A bit for each position whose coordinates lie in the three ranges.
constexpr std::uint64_t positionsIn(const PositionRange& x, const PositionRange& y, const PositionRange& z) {
    const auto contains = [](const PositionRange& range, std::int64_t i) { return range.low <= i && i <= range.high; };
    std::uint64_t row = 0;
    for (int i = 0; i < 4; ++i) row |= std::uint64_t{contains(x, i)} << i;
    std::uint64_t layer = 0;
    for (int i = 0; i < 4; ++i) layer |= contains(y, i) ? row << (4 * i) : 0;
    std::uint64_t block = 0;
    for (int i = 0; i < 4; ++i) block |= contains(z, i) ? layer << (16 * i) : 0;
    return block;
}

}  // namespace cairn
