/// @file Hierarchical hash grids: cost linear in the number of bodies, whatever their sizes and places.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "broad_phase/block_table.h"
#include "broad_phase/broad_phase.h"
#include "broad_phase/grid_levels.h"
#include "broad_phase/pair_rows.h"

namespace cairn {

/// Every body lies in one cell of one level: the cell of the lower corner of its bounds. With cell(x) = ⌊x / edge⌋,
/// which never decreases with x even when rounded, and cell(upper) ≤ cell(lower) + 1, bodies 1 and 2 of a level can
/// only overlap if |cell(lower₁) − cell(lower₂)| ≤ 1, and a body 1 of a finer level can only overlap a body 2 if
/// cell(lower₁) − 1 ≤ cell(lower₂) ≤ cell(upper₁), all in the cells of the coarser level 2. So each cell is compared
/// with one half of its neighbours and with the few cells of coarser levels around it; every pair comes up once.
///
/// Two bodies that are both still are not compared: blocks and cells without a moved body in or around them are passed
/// over.
///
/// The hash finds blocks of 4 × 4 × 4 cells, so that most steps to a neighbour need no hash and neighbours lie close
/// in memory. The bodies of a cell are stored side by side, dynamic ones first, so that fixed ones never meet each
/// other.
class HashGrids final : public BroadPhase {
  public:
    void findPairs(const BroadPhaseInput& input, const Executor& executor, std::vector<BodyPair>& pairs) override;
    int level(BodyIndex body) const override;
    /// Tests of two bounds in the last step: the part of the cost that grows worse than linearly in bad grids.
    std::uint64_t tests() const;

  private:
    /// A body as the search sees it.
    struct Entry {
        Bounds bounds;  ///< [m, W]
        BodyIndex body;
        std::uint32_t moved;  ///< 1 = it is not still
    };
    /// Bodies of a cell in entries_: dynamic ones in [begin, fixed_begin), fixed ones in [fixed_begin, end).
    struct Cell {
        std::uint32_t begin;
        std::uint32_t fixed_begin;
        std::uint32_t end;
    };
    /// Entries [begin, end).
    struct Range {
        std::uint32_t begin;
        std::uint32_t end;
    };
    /// The entries that a cell is compared with, neighbours that lie side by side in memory in one range.
    struct Neighbours {
        std::array<Range, 13> all;
        std::array<Range, 13> dynamic;
        std::size_t all_count = 0;
        std::size_t dynamic_count = 0;

        void add(const Cell& cell);
    };
    /// Where a body lies.
    struct Address {
        std::uint32_t block;
        std::uint32_t cell_or_position;  ///< position in the block until cells are numbered, then the cell's number
    };

    void enterBlocks(const BroadPhaseInput& input);
    void numberCells();
    void placeEntries(const BroadPhaseInput& input);
    void searchBlock(const Block& block, PairBuffer& found) const;
    bool isStillAround(const Block& block, std::span<const Block* const> around) const;
    void searchLevel(const Block& block, PairBuffer& found) const;
    void searchCell(const Cell& cell, const Neighbours& neighbours, PairBuffer& found) const;
    void searchCoarser(const Block& block, PairBuffer& found) const;
    void searchCoarserBlock(const Block& block, const Bounds& around, const Block& coarse, std::uint64_t positions,
                            PairBuffer& found) const;
    void searchApart(const BroadPhaseInput& input, std::size_t begin, std::size_t end, PairBuffer& found) const;
    std::span<const Cell> cellsOf(const Block& block) const;
    void testRow(const Entry& entry, const Range& others, PairBuffer& found) const;

    GridLevels levels_;
    BlockTable table_;
    std::vector<Cell> cells_;           ///< numbered as Block describes
    std::vector<Address> address_;      ///< per slot
    std::vector<Entry> entries_;        ///< grouped by cell
    std::vector<BodyIndex> apart_;      ///< bodies outside the hierarchy, ascending
    std::vector<PairBuffer> found_;     ///< [2 · workers] of the cells, then of the bodies apart
    std::vector<std::uint32_t> moved_;  ///< [levels] bodies that are not still
    PairRows rows_;
};

}  // namespace cairn
