#include "messages/sums.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "messages/packing.h"

namespace cairn {

namespace {

constexpr std::array counts = {&Statistics::contacts,
                               &Statistics::penetrating_contacts,
                               &Statistics::corrected_contacts,
                               &Statistics::uncorrected_contacts,
                               &Statistics::displaced_bodies,
                               &Statistics::global_iterations,
                               &Statistics::shock_iterations,
                               &Statistics::shock_batches,
                               &Statistics::batches,
                               &Statistics::asleep,
                               &Statistics::woken};

}  // namespace

void addRank(Statistics& sum, const Statistics& other) {
    for (const auto count : counts) sum.*count += other.*count;
    sum.largest_batch = std::max(sum.largest_batch, other.largest_batch);
    sum.largest_overlap = std::max(sum.largest_overlap, other.largest_overlap);
    for (std::size_t i = 0; i < stage_count; ++i) sum.stage_ms[i] = std::max(sum.stage_ms[i], other.stage_ms[i]);
    sum.diagnostics = other.diagnostics;
}

Statistics sumOverRanks(Ranks& ranks, const Statistics& own) {
    std::vector<std::byte> message;
    for (const auto count : counts) pack(message, own.*count);
    pack(message, own.largest_batch);
    pack(message, own.largest_overlap);
    pack(message, own.stage_ms);
    Statistics sum;
    for (const auto& told : tellAll(ranks, message)) {
        Unpacker in(told);
        Statistics other;
        for (const auto count : counts) other.*count = in.get<std::int64_t>();
        other.largest_batch = in.get<std::int64_t>();
        other.largest_overlap = in.get<double>();
        other.stage_ms = in.get<std::array<double, stage_count>>();
        addRank(sum, other);
    }
    sum.diagnostics = own.diagnostics;
    return sum;
}

std::uint64_t sumOverRanks(Ranks& ranks, std::uint64_t own) {
    std::uint64_t sum = 0;
    for (const std::uint64_t one : gatherAll(ranks, own)) sum += one;
    return sum;
}

}  // namespace cairn
