#include "cairn/ranks.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <string>
#include <utility>

#include "cairn/types.h"

namespace cairn {

Ranks::Messages Ranks::exchange(Messages out) {
    const auto own = static_cast<std::size_t>(rank_);
    Messages in(out.size());
    in[own] = std::move(out[own]);
    out[own].clear();
    ++traffic_.rounds;
    for (const std::vector<std::byte>& message : out) {
        traffic_.messages += message.empty() ? 0 : 1;
        traffic_.bytes += static_cast<std::int64_t>(message.size());
    }
    const auto begin = std::chrono::steady_clock::now();
    deliver(out, in);
    traffic_.waiting += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return in;
}

void Ranks::setPatience(double seconds) {
    if (!(seconds > 0)) throw InputError(fmt::format("a patience of {} s; it must be above 0", seconds));
    patience_ = seconds;
}

void Ranks::tellLate(const std::vector<int>& late) const {
    throw RankLateError(fmt::format("rank {} waited {} s for {} {}, in round {}, and gave up", rank_, patience_,
                                    late.size() == 1 ? "rank" : "ranks", fmt::join(late, ", "), traffic_.rounds));
}

PartitionKind partitionNamed(std::string_view name) {
    using enum PartitionKind;
    constexpr std::array<std::pair<std::string_view, PartitionKind>, 5> names{
        {{"boxes", boxes}, {"x", x}, {"y", y}, {"z", z}, {"hash", hash}}};
    for (const auto& [known, kind] : names) {
        if (name == known) return kind;
    }
    throw InputError(fmt::format("partition '{}' is unknown; there are boxes, x, y, z and hash", name));
}

}  // namespace cairn
