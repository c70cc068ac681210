/// @file Sweeps that visit contacts one at a time or four at once, on one or on all threads.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "resolution/contact_colours.h"
#include "resolution/pgs_batch.h"
#include "resolution/pgs_contact.h"

namespace cairn {

/// What a lane holds of several batches that are solved together.
struct LaneRange {
    std::size_t body_begin = 0;  ///< of those that move
    std::size_t body_end = 0;
    std::size_t contact_begin = 0;
    std::size_t contact_end = 0;
};

/// For contacts without joints and rolling friction. One batch is visited colour by colour: the pairs of a colour share
/// no body that moves, so that threads take their parts of it, and pairs of each part fill the lanes. Of several
/// batches each fills a lane, and its contacts are visited from body to body. Every lane is computed as if it were
/// alone, so that the number of lanes changes no result. Keeps its memory between batches.
/// @tparam Number a double, or Lanes
template <class Number>
class LaneSweeper {
  public:
    static constexpr std::size_t lanes = lanes_in<Number>;

    /// Takes over the first contacts of a batch, and applies the impulses that they begin with.
    void beginColours(const PgsBatch& pgs, std::size_t contacts);
    /// The same for several batches, one after the other in what is solved.
    void beginLanes(const PgsBatch& pgs, std::size_t contacts, std::span<const LaneRange, lanes> ranges);
    void sweepForth(const PgsBatch& pgs);
    void sweepBack(const PgsBatch& pgs);
    /// Remembers the impulses before a sweep.
    void save(const PgsBatch& pgs);
    /// Gives the contacts that slide their kinetic friction. @return whether any has another one now
    bool releaseSliding(const PgsBatch& pgs, const LaneRange& range);

    /// What changed since save(). The same on any number of threads.
    SweepChange change(const PgsBatch& pgs);
    /// Adds β times the last direction to the impulses; the new direction is the change since save() plus that.
    void accelerate(double beta, const PgsBatch& pgs);
    /// Forgets the last direction.
    void restart();
    /// Writes the impulses to the contacts.
    void finish(const PgsBatch& pgs);

    // The same for each lane by itself.
    std::array<SweepChange, lanes> changeOfLanes() const;
    /// @param advances 1 in the lanes that are meant, else 0
    void accelerateLanes(const std::array<double, lanes>& beta, const std::array<double, lanes>& advances);
    void restartLane(std::size_t lane);
    /// Further sweeps leave what is in the lane alone.
    void finishLane(std::size_t lane, const LaneRange& range, const PgsBatch& pgs);

    /// A contact, with its bodies. @param contact its place in the batch
    PgsContact contactAt(std::size_t contact, const PgsBatch& pgs) const;
    /// Replaces an accumulated impulse, with what it does to the velocities. @param impulse [N·s, W]
    void setImpulse(std::size_t contact, const Triple1& impulse, LocalBatch& local);

  private:
    /// Contacts of one pair of bodies, as places of an order.
    struct Pair {
        std::size_t begin = 0;
        std::size_t size = 0;  ///< 0 = there is none
    };

    /// Pairs that are worked on at once; lanes without a pair stand for nothing that moves.
    struct Group {
        std::array<std::uint32_t, lanes> a{};     ///< local indices of the bodies
        std::array<std::uint32_t, lanes> b{};     ///< likewise
        std::array<std::uint8_t, lanes> moves{};  ///< bit 0: A moves, bit 1: B moves
        std::uint32_t begin = 0;                  ///< its contacts in contacts_: as many as the largest pair has
        std::uint32_t end = 0;
    };

    enum class Way : std::uint8_t { forth, back };
    using PairsOfLanes = std::array<Pair, lanes>;

    void arrange(const LocalBatch& local);
    void addGroup(const PairsOfLanes& pairs, std::span<const std::uint32_t> order, const LocalBatch& local);
    void beginGroups(const PgsBatch& pgs);
    std::array<std::uint32_t, lanes> substitutesOf(const Group& group) const;
    [[gnu::always_inline]] inline void beginGroup(const Group& group, const PgsBatch& pgs);
    template <Way way, class Visit>
    void visitGroups(std::size_t colour, const PgsBatch& pgs, const Visit& visit);
    std::size_t colours() const { return group_begin_.size() - 1; }
    std::array<SweepChange, lanes> changeOf(std::size_t begin, std::size_t end) const;
    void writeImpulse(std::size_t contact, const PgsBatch& pgs) const;

    ContactColours colours_;
    std::vector<Group> groups_;                    ///< by colours
    std::vector<std::size_t> group_begin_;         ///< [colours + 1] into groups_
    std::size_t shared_ = 0;                       ///< the groups of colours below this share no body that moves
    std::vector<std::uint32_t> own_order_;         ///< [contacts] their indices, for several batches
    std::span<BasicPgsContact<Number>> contacts_;  ///< by groups
    std::vector<BasicPgsContact<Number>> contact_memory_;  ///< contacts_ and more
    std::vector<std::uint32_t> contact_of_;  ///< [lanes · contacts_] the batch's contact in each lane, or none
    std::vector<std::uint32_t> slot_of_;     ///< [contacts] where each contact of the batch is in contact_of_
    std::vector<Triple<Number>> before_;     ///< [contacts_] impulses at the beginning of the sweep [N·s]
    std::vector<Triple<Number>> direction_;  ///< [contacts_] [N·s]
    std::vector<SweepChange> sums_;          ///< [blocks]
};

extern template class LaneSweeper<double>;
extern template class LaneSweeper<Lanes>;

}  // namespace cairn
