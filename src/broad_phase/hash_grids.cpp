#include "broad_phase/hash_grids.h"

#include <algorithm>
#include <array>
#include <functional>

namespace cairn {

namespace {

/// Cells per work item. Items are dealt out in turn, which spreads dense regions over the workers.
constexpr std::size_t cells_per_item = 64;
/// Below this many bodies one worker is faster than several.
constexpr std::size_t serial_limit = 256;

/// One half of the 26 neighbours: of each two that lie opposite, one.
constexpr std::array<std::array<std::int64_t, 3>, 13> half_neighbourhood = {{{1, 0, 0},
                                                                             {-1, 1, 0},
                                                                             {0, 1, 0},
                                                                             {1, 1, 0},
                                                                             {-1, -1, 1},
                                                                             {0, -1, 1},
                                                                             {1, -1, 1},
                                                                             {-1, 0, 1},
                                                                             {0, 0, 1},
                                                                             {1, 0, 1},
                                                                             {-1, 1, 1},
                                                                             {0, 1, 1},
                                                                             {1, 1, 1}}};

/// ⌊x · edge_inv⌋; std::floor is a function call on the baseline processor.
std::int64_t cellCoordinate(double x, double edge_inv) {
    const double scaled = x * edge_inv;
    const auto truncated = static_cast<std::int64_t>(scaled);
    return truncated - (static_cast<double>(truncated) > scaled ? 1 : 0);
}

CellKey cellOf(const Vec3& point, double edge_inv, std::int64_t level) {
    return {cellCoordinate(point.x(), edge_inv), cellCoordinate(point.y(), edge_inv),
            cellCoordinate(point.z(), edge_inv), level};
}

/// Bounds::overlaps without branches, since nobody can predict them.
bool overlap(const Bounds& p, const Bounds& q) {
    const auto inOrder = [](double a, double b) { return static_cast<unsigned>(a <= b); };
    return (inOrder(p.lower.x(), q.upper.x()) & inOrder(q.lower.x(), p.upper.x()) & inOrder(p.lower.y(), q.upper.y()) &
            inOrder(q.lower.y(), p.upper.y()) & inOrder(p.lower.z(), q.upper.z()) &
            inOrder(q.lower.z(), p.upper.z())) != 0;
}

}  // namespace

int HashGrids::level(BodyIndex body) const {
    const auto levels = levels_.ofBodies();
    return body < levels.size() ? std::max<int>(levels[body], -1) : -1;
}

void HashGrids::findPairs(const BroadPhaseInput& input, const Executor& executor, std::vector<BodyPair>& pairs) {
    const std::size_t slots = input.kind.size();
    levels_.choose(input);
    fillCells(input);

    const std::size_t workers = slots < serial_limit ? 1 : static_cast<std::size_t>(executor.threads());
    found_.resize(2 * workers);
    const auto search = [&](std::size_t worker, int) {
        PairBuffer& in_cells = found_[worker];
        in_cells.clear();
        for (std::size_t begin = worker * cells_per_item; begin < cells_.size(); begin += workers * cells_per_item) {
            searchCells(begin, std::min(begin + cells_per_item, cells_.size()), in_cells);
        }
        PairBuffer& with_apart = found_[workers + worker];
        with_apart.clear();
        searchApart(input, slots * worker / workers, slots * (worker + 1) / workers, with_apart);
    };
    executor.forEachDynamic(workers, std::cref(search));
    rows_.sort(found_, slots, executor, pairs);
}

void HashGrids::fillCells(const BroadPhaseInput& input) {
    const auto level = levels_.ofBodies();
    const auto slots = static_cast<BodyIndex>(level.size());
    table_.reset(slots);
    cells_.clear();
    apart_.clear();
    cell_of_body_.resize(slots);
    for (BodyIndex i = 0; i < slots; ++i) {
        cell_of_body_[i] = CellTable::none;
        if (level[i] == GridLevels::apart) apart_.push_back(i);
        if (level[i] < 0) continue;
        const auto own_level = static_cast<std::size_t>(level[i]);
        const std::uint32_t cell = table_.enter(cellOf(input.bounds[i].lower, levels_.edgeInv(own_level), level[i]));
        cell_of_body_[i] = cell;
        if (cell == cells_.size()) cells_.push_back({0, 0, 0});
        // For now numbers of bodies, not offsets.
        ++(input.kind[i] == BodyKind::dynamic ? cells_[cell].fixed_begin : cells_[cell].end);
    }

    std::uint32_t next = 0;
    for (Cell& cell : cells_) {
        const std::uint32_t dynamic = cell.fixed_begin;
        const std::uint32_t fixed = cell.end;
        // Both cursors move to their final values while the bodies are put down.
        cell = {next, next, next + dynamic};
        next += dynamic + fixed;
    }
    entries_.resize(next);
    for (BodyIndex i = 0; i < slots; ++i) {
        if (cell_of_body_[i] == CellTable::none) continue;
        Cell& cell = cells_[cell_of_body_[i]];
        const std::uint32_t place = input.kind[i] == BodyKind::dynamic ? cell.fixed_begin++ : cell.end++;
        entries_[place] = {input.bounds[i], i};
    }
}

void HashGrids::searchCells(std::size_t begin, std::size_t end, PairBuffer& found) const {
    for (std::size_t c = begin; c < end; ++c) {
        searchInside(cells_[c], found);
        const CellKey& key = table_.key(c);
        for (const auto& [dx, dy, dz] : half_neighbourhood) {
            const std::uint32_t other = table_.find({key.x + dx, key.y + dy, key.z + dz, key.level});
            if (other != CellTable::none) searchBetween(cells_[c], cells_[other], found);
        }
        if (static_cast<std::size_t>(key.level) + 1 < levels_.levels()) searchCoarser(c, found);
    }
}

void HashGrids::searchInside(const Cell& cell, PairBuffer& found) const {
    const auto entries = std::span(entries_);
    for (std::uint32_t i = cell.begin; i < cell.fixed_begin; ++i) {
        testRow(entries[i], entries.subspan(i + 1, cell.end - (i + 1)), found);
    }
}

void HashGrids::searchBetween(const Cell& first, const Cell& second, PairBuffer& found) const {
    const auto entries = std::span(entries_);
    const auto all = entries.subspan(second.begin, second.end - second.begin);
    const auto dynamic = entries.subspan(second.begin, second.fixed_begin - second.begin);
    for (std::uint32_t i = first.begin; i < first.fixed_begin; ++i) testRow(entries[i], all, found);
    for (std::uint32_t i = first.fixed_begin; i < first.end; ++i) testRow(entries[i], dynamic, found);
}

void HashGrids::searchCoarser(std::size_t cell, PairBuffer& found) const {
    const Cell& own = cells_[cell];
    Bounds around = entries_[own.begin].bounds;
    for (std::uint32_t i = own.begin + 1; i < own.end; ++i) {
        around.lower = around.lower.cwiseMin(entries_[i].bounds.lower);
        around.upper = around.upper.cwiseMax(entries_[i].bounds.upper);
    }
    for (std::size_t level = static_cast<std::size_t>(table_.key(cell).level) + 1; level < levels_.levels(); ++level) {
        const auto number = static_cast<std::int64_t>(level);
        const CellKey low = cellOf(around.lower, levels_.edgeInv(level), number);
        const CellKey high = cellOf(around.upper, levels_.edgeInv(level), number);
        for (std::int64_t z = low.z - 1; z <= high.z; ++z) {
            for (std::int64_t y = low.y - 1; y <= high.y; ++y) {
                for (std::int64_t x = low.x - 1; x <= high.x; ++x) {
                    const std::uint32_t other = table_.find({x, y, z, number});
                    if (other != CellTable::none) searchBetween(own, cells_[other], found);
                }
            }
        }
    }
}

void HashGrids::searchApart(const BroadPhaseInput& input, std::size_t begin, std::size_t end, PairBuffer& found) const {
    const auto level = levels_.ofBodies();
    for (const BodyIndex p : apart_) {
        const Bounds& bounds = input.bounds[p];
        const bool p_fixed = input.kind[p] == BodyKind::fixed;
        BodyPair* const out = found.reserve(end - begin);
        std::size_t count = 0;
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            // Two bodies apart meet when it is the turn of the lower one.
            const bool once = level[i] >= 0 || (level[i] == GridLevels::apart && i > p);
            const bool movable = !p_fixed || input.kind[i] == BodyKind::dynamic;
            out[count] = {std::min(p, i), std::max(p, i)};
            count += (once & movable & overlap(bounds, input.bounds[i])) ? 1 : 0;
        }
        found.commit(count);
    }
}

void HashGrids::testRow(const Entry& entry, std::span<const Entry> others, PairBuffer& found) {
    // Written always and kept only on a hit: cheaper than a branch that is taken at random.
    BodyPair* const out = found.reserve(others.size());
    std::size_t count = 0;
    for (const Entry& other : others) {
        out[count] = {std::min(entry.body, other.body), std::max(entry.body, other.body)};
        count += overlap(entry.bounds, other.bounds) ? 1 : 0;
    }
    found.commit(count);
}

}  // namespace cairn
