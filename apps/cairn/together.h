/// @file What the ranks of a run agree on; alone, a run agrees with itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cairn/scene.h"

namespace cairn::cli {

/// What the ranks of a run told each other, and how long they waited.
struct RanksReport {
    int count = 0;
    Traffic sum;               ///< messages and bytes of all, rounds of one, waiting of all
    double most_waiting = 0;   ///< of one rank [s]
    double least_waiting = 0;  ///< likewise: of the slowest rank [s]
};

/// The ranks of a run as one of them sees it. Its calls are made by all of them, in the same order.
class Together {
  public:
    /// @param ranks null = the run is on one
    explicit Together(Ranks* ranks) : ranks_(ranks) {}

    bool isShared() const { return ranks_ != nullptr; }
    std::size_t rank() const { return ranks_ == nullptr ? 0 : static_cast<std::size_t>(ranks_->rank()); }
    std::size_t size() const { return ranks_ == nullptr ? 1 : static_cast<std::size_t>(ranks_->size()); }
    /// Whether this rank has the outputs and prints.
    bool isFirst() const { return ranks_ == nullptr || ranks_->rank() == 0; }
    /// Whether any rank says so.
    bool anywhere(bool here);
    /// What the lowest rank that has something to say says.
    std::optional<std::string> firstOf(const std::optional<std::string>& own);
    /// What all counted in the same steps, up to now. @param own of this rank @param mean_overlap of the whole world
    /// [m]
    Statistics total(const Statistics& own, double mean_overlap);
    /// The number that the first rank gives.
    std::uint64_t numberOfFirst(std::uint64_t own);
    /// The sum of what all give.
    std::uint64_t sum(std::uint64_t own) { return ranks_ == nullptr ? own : sumOverRanks(*ranks_, own); }
    /// World::stateHash() of the whole world.
    std::uint64_t hash(const World& world);
    /// None for a run on one rank.
    std::optional<RanksReport> report();

  private:
    Ranks* ranks_;
};

}  // namespace cairn::cli
