/// @file Sweeps that visit contacts four at once, on all threads.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "resolution/contact_colours.h"
#include "resolution/pgs_batch.h"
#include "resolution/pgs_contact.h"

namespace cairn {

/// For the contacts of a batch without joints and rolling friction. They are visited colour by colour: the pairs of a
/// colour share no body that moves, so that threads take their parts of it, and pairs of each part fill the lanes.
/// Every lane is computed as if it were alone. Keeps its memory between batches.
class ColourSweeper {
  public:
    /// Chains, which direct steps are for, are swept in their order.
    static constexpr bool steps_directly = false;

    /// Takes over the first contacts of a batch.
    void prepare(const PgsBatch& pgs, std::size_t contacts);
    /// Computes what visits need of them, and applies the impulses that they begin with.
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
    /// Contacts of one pair of bodies, as places of an order.
    struct Pair {
        std::size_t begin = 0;
        std::size_t size = 0;  ///< 0 = there is none
    };

    /// Pairs that are worked on at once; lanes without a pair stand for nothing that moves.
    struct Group {
        std::array<std::uint32_t, lane_count> a{};     ///< local indices of the bodies
        std::array<std::uint32_t, lane_count> b{};     ///< likewise
        std::array<std::uint8_t, lane_count> moves{};  ///< bit 0: A moves, bit 1: B moves
        std::uint32_t begin = 0;                       ///< its contacts in contacts_: as many as the largest pair has
        std::uint32_t end = 0;
    };

    enum class Way : std::uint8_t { forth, back };
    using PairsOfLanes = std::array<Pair, lane_count>;

    void arrange(const LocalBatch& local);
    void addGroup(const PairsOfLanes& pairs, std::span<const std::uint32_t> order, const LocalBatch& local);
    [[gnu::always_inline]] inline void fill(const Group& group, const PgsBatch& pgs);
    template <Way way, class Visit>
    void visitGroups(std::size_t colour, const PgsBatch& pgs, const Visit& visit);
    std::size_t colours() const { return group_begin_.size() - 1; }
    std::array<SweepChange, lane_count> changeOf(std::size_t begin, std::size_t end) const;
    PgsContact contactAt(std::size_t contact, const PgsBatch& pgs) const;
    void writeImpulse(std::size_t contact, const PgsBatch& pgs) const;

    ContactColours colours_;
    std::vector<Group> groups_;                ///< by colours
    std::vector<std::size_t> group_begin_;     ///< [colours + 1] into groups_
    std::size_t shared_ = 0;                   ///< the groups of colours below this share no body that moves
    std::span<WideContact> contacts_;          ///< by groups
    std::vector<WideContact> contact_memory_;  ///< contacts_ and more
    std::vector<std::uint32_t> contact_of_;    ///< [lane_count · contacts_] the batch's contact in each lane, or none
    std::vector<std::uint32_t> slot_of_;       ///< [contacts] where each contact of the batch is in contact_of_
    std::vector<Triple<Lanes>> before_;        ///< [contacts_] impulses at the beginning of the sweep [N·s]
    std::vector<Triple<Lanes>> direction_;     ///< [contacts_] [N·s]
    std::vector<SweepChange> sums_;            ///< [blocks]
};

}  // namespace cairn
