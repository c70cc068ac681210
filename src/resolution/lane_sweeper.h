/// @file Sweeps that visit contacts four at once, on all threads.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "resolution/lane_groups.h"
#include "resolution/pgs_batch.h"
#include "resolution/rolling_contact.h"

namespace cairn {

/// For contacts of a batch that no joint holds. They are visited by groups of pairs that fill the lanes; threads take
/// their parts of those groups that share no body that moves. Every lane is computed as if it were alone. Keeps its
/// memory between batches.
/// @tparam Wide a WideContact, or a WideRollingContact for those that resist rolling
template <class Wide>
class BasicLaneSweeper {
  public:
    /// Chains, which direct steps are for, are swept in their order.
    static constexpr bool steps_directly = false;

    /// Takes over some contacts of a batch, which are visited in their order unless pgs.order is by_colours.
    /// @param first place of the first one in the batch
    void prepare(const PgsBatch& pgs, std::size_t contacts, std::size_t first = 0);
    /// Computes what visits need of them.
    void fill(const PgsBatch& pgs);
    /// Applies the impulses that they begin with.
    void start(const PgsBatch& pgs);
    void sweepForth(const PgsBatch& pgs);
    void sweepBack(const PgsBatch& pgs);
    /// Remembers the impulses before a sweep.
    void save(const PgsBatch& pgs);
    /// Gives the contacts that slide their kinetic friction. @return whether any has another one now
    bool releaseSliding(const PgsBatch& pgs);

    /// What changed since save(). The same on any number of threads.
    SweepChange change(const PgsBatch& pgs);
    /// Adds β times the last direction to the impulses; the new direction is the change since save() plus that.
    void accelerate(double beta, const PgsBatch& pgs);
    /// Forgets the last direction.
    void restart();
    /// Writes the impulses to the contacts.
    void finish(const PgsBatch& pgs);

  private:
    enum class Way : std::uint8_t { forth, back };
    using Accumulated = typename Wide::Accumulated;

    [[gnu::always_inline]] inline void fillGroup(const LaneGroup& group, const PgsBatch& pgs);
    template <Way way, class Visit>
    void visitGroups(std::size_t set, const PgsBatch& pgs, const Visit& visit);
    std::array<SweepChange, lane_count> changeOf(std::size_t begin, std::size_t end);
    PgsContact contactAt(std::size_t contact, const PgsBatch& pgs) const;
    void writeImpulse(std::size_t contact, const PgsBatch& pgs) const;

    std::size_t first_ = 0;
    LaneGroups groups_;
    std::span<Wide> contacts_;            ///< [rows of groups_]
    std::vector<Wide> contact_memory_;    ///< contacts_ and more
    std::vector<Accumulated> before_;     ///< [contacts_] impulses at the beginning of the sweep
    std::vector<Accumulated> direction_;  ///< [contacts_]
    std::vector<double> squared_;         ///< [slots of groups_] what the sweep changed, as in SweepChange
    std::vector<SweepChange> sums_;       ///< [blocks] likewise
};

extern template class BasicLaneSweeper<WideContact>;
extern template class BasicLaneSweeper<WideRollingContact>;

using LaneSweeper = BasicLaneSweeper<WideContact>;
using RollingSweeper = BasicLaneSweeper<WideRollingContact>;

}  // namespace cairn
