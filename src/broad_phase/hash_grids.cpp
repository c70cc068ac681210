#include "broad_phase/hash_grids.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>

#include "broad_phase/neighbourhood.h"

namespace cairn {

namespace {

/// Blocks per work item. Items are dealt out in turn, which spreads dense regions over the workers.
constexpr std::size_t blocks_per_item = 4;
/// Below this many bodies one worker is faster than several.
constexpr std::size_t serial_slots = 256;

/// ⌊x · edge_inv⌋; std::floor is a function call on the baseline processor.
std::int64_t cellCoordinate(double x, double edge_inv) {
    const double scaled = x * edge_inv;
    const auto truncated = static_cast<std::int64_t>(scaled);
    return truncated - (static_cast<double>(truncated) > scaled ? 1 : 0);
}

/// Integer coordinates of a cell.
struct CellCoordinates {
    std::int64_t x;
    std::int64_t y;
    std::int64_t z;
};

CellCoordinates cellOf(const Vec3& point, double edge_inv) {
    return {cellCoordinate(point.x(), edge_inv), cellCoordinate(point.y(), edge_inv),
            cellCoordinate(point.z(), edge_inv)};
}

/// Calls work(position) for each set bit, ascending.
template <class Work>
void forEachPosition(std::uint64_t positions, const Work& work) {
    for (; positions != 0; positions &= positions - 1) work(static_cast<unsigned>(std::countr_zero(positions)));
}

}  // namespace

int HashGrids::level(BodyIndex body) const {
    const auto levels = levels_.ofBodies();
    return body < levels.size() ? std::max<int>(levels[body], -1) : -1;
}

std::uint64_t HashGrids::tests() const {
    std::uint64_t sum = 0;
    for (const PairBuffer& buffer : found_) sum += buffer.offered();
    return sum;
}

void HashGrids::findPairs(const BroadPhaseInput& input, const Executor& executor, std::vector<BodyPair>& pairs) {
    const std::size_t slots = input.kind.size();
    levels_.choose(input);
    enterBlocks(input);
    numberCells();
    placeEntries(input);

    const std::size_t workers = slots < serial_slots ? 1 : static_cast<std::size_t>(executor.threads());
    found_.resize(2 * workers);
    const auto search = [&](std::size_t worker, int) {
        const auto& blocks = table_.blocks();
        PairBuffer& in_cells = found_[worker];
        in_cells.clear();
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            if (b / blocks_per_item % workers == worker) searchBlock(blocks[b], in_cells);
        }
        PairBuffer& with_apart = found_[workers + worker];
        with_apart.clear();
        searchApart(input, slots * worker / workers, slots * (worker + 1) / workers, with_apart);
    };
    executor.forEachDynamic(workers, std::cref(search));
    rows_.sort(found_, slots, executor, pairs);
}

void HashGrids::enterBlocks(const BroadPhaseInput& input) {
    const auto level = levels_.ofBodies();
    const auto slots = static_cast<BodyIndex>(level.size());
    table_.reset();
    apart_.clear();
    address_.resize(slots);
    moved_.assign(levels_.levels(), 0);
    for (BodyIndex i = 0; i < slots; ++i) {
        const auto on_level = level[i];
        if (on_level == GridLevels::apart) apart_.push_back(i);
        if (on_level < 0) continue;
        const auto own_level = static_cast<std::uint8_t>(on_level);
        const CellCoordinates at = cellOf(input.bounds[i].lower, levels_.edgeInv(own_level));
        const std::uint32_t block = table_.enter({at.x >> 2, at.y >> 2, at.z >> 2, on_level});
        const auto position = static_cast<unsigned>((at.x & 3) + 4 * (at.y & 3) + 16 * (at.z & 3));
        table_.blocks()[block].occupied |= std::uint64_t{1} << position;
        const std::uint32_t moved = input.isStill(i) ? 0 : 1;
        table_.blocks()[block].moved |= std::uint64_t{moved} << position;
        moved_[own_level] += moved;
        address_[i] = {block, position};
    }
}

void HashGrids::numberCells() {
    std::uint32_t cells = 0;
    for (Block& block : table_.blocks()) {
        block.first_cell = cells;
        cells += static_cast<std::uint32_t>(std::popcount(block.occupied));
    }
    cells_.assign(cells, {0, 0, 0});
}

void HashGrids::placeEntries(const BroadPhaseInput& input) {
    const auto level = levels_.ofBodies();
    const auto slots = static_cast<BodyIndex>(level.size());
    const auto& blocks = table_.blocks();
    for (BodyIndex i = 0; i < slots; ++i) {
        if (level[i] < 0) continue;
        Address& address = address_[i];
        address.cell_or_position = blocks[address.block].cell(address.cell_or_position);
        // For now numbers of bodies, not offsets.
        Cell& cell = cells_[address.cell_or_position];
        ++(input.kind[i] == BodyKind::dynamic ? cell.fixed_begin : cell.end);
    }

    std::uint32_t next = 0;
    for (Cell& cell : cells_) {
        const std::uint32_t dynamic = cell.fixed_begin;
        const std::uint32_t fixed = cell.end;
        // Both ends move to their final values while the bodies are put down.
        cell = {next, next, next + dynamic};
        next += dynamic + fixed;
    }

    entries_.resize(next);
    for (BodyIndex i = 0; i < slots; ++i) {
        if (level[i] < 0) continue;
        Cell& cell = cells_[address_[i].cell_or_position];
        entries_[input.kind[i] == BodyKind::dynamic ? cell.fixed_begin++ : cell.end++] = {input.bounds[i], i,
                                                                                          input.isStill(i) ? 0U : 1U};
    }
}

std::span<const HashGrids::Cell> HashGrids::cellsOf(const Block& block) const {
    return std::span(cells_).subspan(block.first_cell, static_cast<std::size_t>(std::popcount(block.occupied)));
}

inline void HashGrids::testRow(const Entry& entry, const Range& others, PairBuffer& found) const {
    // Written always and kept only on a hit: cheaper than a branch that is taken at random.
    BodyPair* const out = found.reserve(others.end - others.begin);
    std::size_t count = 0;
    for (std::uint32_t j = others.begin; j < others.end; ++j) {
        const Entry& other = entries_[j];
        out[count].a = std::min(entry.body, other.body);
        out[count].b = std::max(entry.body, other.body);
        count += (entry.bounds.overlaps(other.bounds) ? 1U : 0U) & (entry.moved | other.moved);
    }
    found.commit(count);
}

void HashGrids::searchBlock(const Block& block, PairBuffer& found) const {
    const auto level = static_cast<std::size_t>(block.key.level);
    if (moved_[level] > 0) searchLevel(block, found);
    const auto moved_above = std::span(moved_).subspan(level + 1, levels_.levels() - level - 1);
    if (block.moved > 0 || std::ranges::any_of(moved_above, [](std::uint32_t moved) { return moved > 0; })) {
        searchCoarser(block, found);
    }
}

bool HashGrids::isStillAround(const Block& block, std::span<const Block* const> around) const {
    return block.moved == 0 &&
           std::ranges::none_of(around, [](const Block* other) { return other != nullptr && other->moved > 0; });
}

void HashGrids::searchLevel(const Block& block, PairBuffer& found) const {
    std::uint32_t needed = 0;
    forEachPosition(block.occupied, [&](unsigned position) { needed |= needed_blocks[position]; });
    std::array<const Block*, 27> around{};
    forEachPosition(needed, [&](unsigned slot) {
        const auto& [x, y, z, level] = block.key;
        around[slot] =
            slot == own_block ? &block : table_.find({x + slot % 3 - 1, y + slot / 3 % 3 - 1, z + slot / 9 - 1, level});
    });

    if (isStillAround(block, around)) return;
    const Cell* cell = &cells_[block.first_cell];
    forEachPosition(block.occupied, [&](unsigned position) {
        const bool moved = block.hasMoved(position);
        Neighbours neighbours;
        for (const RelativeCell& neighbour : half_neighbourhood[position]) {
            const Block* const other = around[neighbour.block];
            if (other != nullptr && other->has(neighbour.position) && (moved || other->hasMoved(neighbour.position))) {
                neighbours.add(cells_[other->cell(neighbour.position)]);
            }
        }
        if (moved || neighbours.all_count > 0) searchCell(*cell, neighbours, found);
        ++cell;
    });
}

void HashGrids::Neighbours::add(const Cell& cell) {
    if (all_count > 0 && all[all_count - 1].end == cell.begin) {
        all[all_count - 1].end = cell.end;
    } else {
        all[all_count++] = {cell.begin, cell.end};
    }
    if (cell.fixed_begin > cell.begin) dynamic[dynamic_count++] = {cell.begin, cell.fixed_begin};
}

void HashGrids::searchCell(const Cell& cell, const Neighbours& neighbours, PairBuffer& found) const {
    for (std::uint32_t i = cell.begin; i < cell.fixed_begin; ++i) {
        testRow(entries_[i], {i + 1, cell.end}, found);
        for (std::size_t n = 0; n < neighbours.all_count; ++n) testRow(entries_[i], neighbours.all[n], found);
    }
    for (std::uint32_t i = cell.fixed_begin; i < cell.end; ++i) {
        for (std::size_t n = 0; n < neighbours.dynamic_count; ++n) testRow(entries_[i], neighbours.dynamic[n], found);
    }
}

void HashGrids::searchCoarser(const Block& block, PairBuffer& found) const {
    const auto cells = cellsOf(block);
    Bounds around = entries_[cells.front().begin].bounds;
    for (std::uint32_t i = cells.front().begin + 1; i < cells.back().end; ++i) {
        around.lower = around.lower.cwiseMin(entries_[i].bounds.lower);
        around.upper = around.upper.cwiseMax(entries_[i].bounds.upper);
    }
    for (std::size_t level = static_cast<std::size_t>(block.key.level) + 1; level < levels_.levels(); ++level) {
        const CellCoordinates lower = cellOf(around.lower, levels_.edgeInv(level));
        const CellCoordinates high = cellOf(around.upper, levels_.edgeInv(level));
        const CellCoordinates low = {lower.x - 1, lower.y - 1, lower.z - 1};
        for (std::int64_t z = low.z >> 2; z <= high.z >> 2; ++z) {
            for (std::int64_t y = low.y >> 2; y <= high.y >> 2; ++y) {
                for (std::int64_t x = low.x >> 2; x <= high.x >> 2; ++x) {
                    const Block* const coarse = table_.find({x, y, z, static_cast<std::int64_t>(level)});
                    if (coarse == nullptr) continue;
                    const std::uint64_t positions =
                        positionsIn({low.x - 4 * x, high.x - 4 * x}, {low.y - 4 * y, high.y - 4 * y},
                                    {low.z - 4 * z, high.z - 4 * z});
                    searchCoarserBlock(block, around, *coarse, positions, found);
                }
            }
        }
    }
}

void HashGrids::searchCoarserBlock(const Block& block, const Bounds& around, const Block& coarse,
                                   std::uint64_t positions, PairBuffer& found) const {
    if (block.moved == 0 && coarse.moved == 0) return;
    const auto cells = cellsOf(block);
    const Range all = {cells.front().begin, cells.back().end};
    forEachPosition(coarse.occupied & positions, [&](unsigned position) {
        const Cell& other = cells_[coarse.cell(position)];
        for (std::uint32_t i = other.begin; i < other.end; ++i) {
            if (!entries_[i].bounds.overlaps(around) || (block.moved == 0 && entries_[i].moved == 0)) continue;
            if (i < other.fixed_begin) {
                testRow(entries_[i], all, found);
                continue;
            }
            for (const Cell& cell : cells) testRow(entries_[i], {cell.begin, cell.fixed_begin}, found);
        }
    });
}

void HashGrids::searchApart(const BroadPhaseInput& input, std::size_t begin, std::size_t end, PairBuffer& found) const {
    const auto level = levels_.ofBodies();
    for (const BodyIndex p : apart_) {
        const Bounds& bounds = input.bounds[p];
        const bool p_fixed = input.kind[p] == BodyKind::fixed;
        const bool p_still = input.isStill(p);
        BodyPair* const out = found.reserve(end - begin);
        std::size_t count = 0;
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            // Two bodies apart meet when it is the turn of the lower one.
            const bool once = level[i] >= 0 || (level[i] == GridLevels::apart && i > p);
            const bool movable = (!p_fixed || input.kind[i] == BodyKind::dynamic) && !(p_still && input.isStill(i));
            out[count] = {std::min(p, i), std::max(p, i)};
            count += once && movable && bounds.overlaps(input.bounds[i]) ? 1 : 0;
        }
        found.commit(count);
    }
}

}  // namespace cairn
