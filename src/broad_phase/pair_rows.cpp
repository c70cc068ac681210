#include "broad_phase/pair_rows.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>

#include "math/arrays.h"

namespace cairn {

namespace {

/// Rows up to this length are sorted by insertion.
constexpr std::ptrdiff_t short_row = 24;
/// Below this many pairs waking other threads costs more than they save.
constexpr std::size_t serial_pairs = 32768;

void sortRow(BodyPair* begin, BodyPair* end) {
    const auto byPartner = [](const BodyPair& p, const BodyPair& q) { return p.b < q.b; };
    if (end - begin > short_row) {
        // The rows of infinite and oversized bodies are long, but arrive in order.
        if (!std::is_sorted(begin, end, byPartner)) std::sort(begin, end, byPartner);
        return;
    }
    for (BodyPair* next = begin; next < end; ++next) {
        const BodyPair pair = *next;
        BodyPair* place = next;
        for (; place > begin && pair.b < (place - 1)->b; --place) *place = *(place - 1);
        *place = pair;
    }
}

}  // namespace

void PairBuffer::grow(std::size_t needed) {
    resizeTightly(storage_, std::max(needed, std::size_t{64}));
    storage_.resize(storage_.capacity());
}

void PairRows::sort(std::span<const PairBuffer> parts, std::size_t slots, const Executor& executor,
                    std::vector<BodyPair>& pairs) {
    std::size_t total = 0;
    for (const PairBuffer& part : parts) total += part.pairs().size();
    const Executor alone;
    const Executor& workers = total < serial_pairs ? alone : executor;

    count(parts, slots, workers);
    resizeTightly(pairs, placeRows(parts.size(), slots));

    const auto scatter = [&](std::size_t part, int) {
        auto& cursor = cursor_[part];
        for (const BodyPair& pair : parts[part].pairs()) pairs[cursor[pair.a]++] = pair;
    };
    workers.forEachDynamic(parts.size(), std::cref(scatter));

    const auto sortRows = [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t a = begin; a < end; ++a) {
            sortRow(pairs.data() + row_begin_[a], pairs.data() + row_begin_[a + 1]);
        }
    };
    workers.forBlocks(slots, std::cref(sortRows));
}

void PairRows::count(std::span<const PairBuffer> parts, std::size_t slots, const Executor& executor) {
    if (cursor_.size() < parts.size()) cursor_.resize(parts.size());
    const auto countPart = [&](std::size_t part, int) {
        auto& counts = cursor_[part];
        counts.assign(slots, 0);
        for (const BodyPair& pair : parts[part].pairs()) ++counts[pair.a];
    };
    executor.forEachDynamic(parts.size(), std::cref(countPart));
}

std::size_t PairRows::placeRows(std::size_t parts, std::size_t slots) {
    row_begin_.resize(slots + 1);
    std::uint64_t total = 0;
    for (std::size_t a = 0; a < slots; ++a) {
        row_begin_[a] = static_cast<std::uint32_t>(total);
        for (std::size_t part = 0; part < parts; ++part) {
            const std::uint32_t in_part = cursor_[part][a];
            cursor_[part][a] = static_cast<std::uint32_t>(total);
            total += in_part;
        }
    }
    if (total > std::numeric_limits<std::uint32_t>::max()) {
        throw std::length_error("broad phase: more than 4294967295 overlapping pairs; spread the bodies out");
    }
    row_begin_[slots] = static_cast<std::uint32_t>(total);
    return total;
}

}  // namespace cairn
