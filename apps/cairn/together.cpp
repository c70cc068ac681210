#include "together.h"

#include <algorithm>
#include <cstring>

namespace cairn::cli {

namespace {

Ranks::Messages tell(Ranks& ranks, const void* bytes, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(bytes);
    return ranks.exchange(
        Ranks::Messages(static_cast<std::size_t>(ranks.size()), std::vector<std::byte>(first, first + size)));
}

/// One value of every rank.
template <class Value>
std::vector<Value> gather(Ranks& ranks, const Value& own) {
    std::vector<Value> all;
    for (const std::vector<std::byte>& told : tell(ranks, &own, sizeof(own))) {
        std::memcpy(&all.emplace_back(), told.data(), sizeof(own));
    }
    return all;
}

}  // namespace

bool Together::anywhere(bool here) {
    if (ranks_ == nullptr) return here;
    const std::vector<char> all = gather(*ranks_, static_cast<char>(here ? 1 : 0));
    return std::ranges::find(all, 1) != all.end();
}

std::optional<std::string> Together::firstOf(const std::optional<std::string>& own) {
    if (ranks_ == nullptr) return own;
    const std::string text = own.value_or("");
    for (const std::vector<std::byte>& told : tell(*ranks_, text.data(), text.size())) {
        if (!told.empty()) return std::string(reinterpret_cast<const char*>(told.data()), told.size());
    }
    return std::nullopt;
}

Statistics Together::total(const Statistics& own, double mean_overlap) {
    if (ranks_ == nullptr) return own;
    Statistics sum = sumOverRanks(*ranks_, own);
    sum.mean_overlap = mean_overlap;
    return sum;
}

std::uint64_t Together::numberOfFirst(std::uint64_t own) {
    return ranks_ == nullptr ? own : gather(*ranks_, own).front();
}

std::uint64_t Together::hash(const World& world) {
    return world.isDivided() ? sumOverRanks(*ranks_, world.stateHash()) : world.stateHash();
}

std::optional<RanksReport> Together::report() {
    if (ranks_ == nullptr) return std::nullopt;
    const Traffic own = ranks_->traffic();
    RanksReport report{.count = ranks_->size(), .sum = {.rounds = own.rounds}, .least_waiting = own.waiting};
    for (const Traffic& one : gather(*ranks_, own)) {
        report.sum.messages += one.messages;
        report.sum.bytes += one.bytes;
        report.sum.waiting += one.waiting;
        report.most_waiting = std::max(report.most_waiting, one.waiting);
        report.least_waiting = std::min(report.least_waiting, one.waiting);
    }
    return report;
}

}  // namespace cairn::cli
