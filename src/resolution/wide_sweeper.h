/// @file Sweeps that visit four contacts at once, on all threads.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "resolution/contact_colours.h"
#include "resolution/sweeper.h"
#include "resolution/swept_contact.h"

namespace cairn {

/// For batches with many contacts, without joints and rolling friction: contacts are visited colour by colour. The
/// pairs of a colour share no body that moves, so that threads take their parts of it, and of each part four pairs are
/// worked on at once.
class WideSweeper final : public Sweeper {
  public:
    void begin(const SweptBatch& swept) override;
    std::size_t size() const override { return slot_of_.size(); }
    void sweep(const SweptBatch& swept) override;
    void note(const SweptBatch& swept) override;
    SweepChange change(const SweptBatch& swept) override;
    void accelerate(double beta, const SweptBatch& swept) override;
    void restart() override;
    bool releaseSliding(const SweptBatch& swept) override;
    void finish(const SweptBatch& swept) override;

  private:
    /// Contacts of one pair of bodies, as places of the colours.
    struct Pair {
        std::size_t begin = 0;
        std::size_t size = 0;
    };

    /// Up to four pairs of a colour; lanes without a pair stand for nothing that moves.
    struct Group {
        std::array<std::uint32_t, lane_count> a{};     ///< local indices of the bodies
        std::array<std::uint32_t, lane_count> b{};     ///< likewise
        std::array<std::uint8_t, lane_count> moves{};  ///< bit 0: A moves, bit 1: B moves
        std::uint32_t begin = 0;                       ///< its contacts in contacts_: as many as the largest pair has
        std::uint32_t end = 0;
    };

    void arrange(const LocalBatch& local);
    void addGroup(std::span<const Pair> pairs, const LocalBatch& local);
    void beginGroup(const Group& group, const SweptBatch& swept);
    template <class Visit>
    void visitGroups(std::size_t colour, const SweptBatch& swept, const Visit& visit);
    SweepChange changeOfBlock(std::size_t block) const;
    SweptContact contactAt(std::size_t slot) const;

    ContactColours colours_;
    std::vector<Group> groups_;              ///< by colours
    std::vector<std::size_t> group_begin_;   ///< [colours + 1] into groups_
    std::vector<WideContact> contacts_;      ///< by groups
    std::vector<std::uint32_t> contact_of_;  ///< [4 · contacts_] the batch's contact in each lane, or none
    std::vector<std::uint32_t> slot_of_;     ///< [contacts] where each contact of the batch is in contact_of_
    std::vector<Lanes3> before_;             ///< [contacts_] impulses at the beginning of the sweep [N·s]
    std::vector<Lanes3> direction_;          ///< [contacts_] [N·s]
    std::vector<SweepChange> sums_;          ///< [blocks]
};

}  // namespace cairn
