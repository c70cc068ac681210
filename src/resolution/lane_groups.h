/// @file Which pairs of bodies of a batch the lanes of vectors work on at once, and in which order.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "math/lanes.h"
#include "resolution/contact_colours.h"

namespace cairn {

using BodyIndices = std::array<std::uint32_t, lane_count>;

/// Pairs that are worked on at once, none of which shares a body that moves with another. Lanes without a pair stand
/// for nothing that moves.
struct LaneGroup {
    BodyIndices a{};                               ///< local indices of the bodies
    BodyIndices b{};                               ///< likewise
    std::array<std::uint8_t, lane_count> moves{};  ///< bit 0: A moves, bit 1: B moves
    std::uint32_t begin = 0;                       ///< its rows, a contact for each lane: as many as the largest pair
    std::uint32_t end = 0;                         ///< has contacts
};

/// Keeps its memory between batches.
class LaneGroups {
  public:
    static constexpr std::uint32_t no_contact = UINT32_MAX;

    /// Pairs of a colour may be worked on at the same time, so that threads may divide it. @param ends [contacts] those
    /// of a pair next to each other @param moving bodies below this index move
    void byColours(std::span<const ContactEnds> ends, std::size_t moving);
    /// Each pair comes after all earlier ones that it shares a moving body with, and before all later ones, so that
    /// sweeps in this order give the same as sweeps from pair to pair, for one thread.
    void inOrder(std::span<const ContactEnds> ends, std::size_t moving);

    /// Sets of groups that follow each other.
    std::size_t sets() const { return set_begin_.size() - 1; }
    std::span<const LaneGroup> set(std::size_t set) const {
        return std::span(groups_).subspan(set_begin_[set], set_begin_[set + 1] - set_begin_[set]);
    }
    /// Whether its groups may be worked on at the same time.
    bool isShared(std::size_t set) const { return set < shared_; }
    std::span<const LaneGroup> groups() const { return groups_; }

    std::size_t rows() const { return contact_of_.size() / lane_count; }
    /// The contacts in the lanes of a row, or no_contact.
    std::span<const std::uint32_t, lane_count> contactsOf(std::size_t row) const {
        return std::span<const std::uint32_t, lane_count>(&contact_of_[row * lane_count], lane_count);
    }
    /// [contacts] row · lane_count + lane of each
    std::span<const std::uint32_t> slots() const { return slot_of_; }

  private:
    /// Contacts of one pair of bodies, as places of an order.
    struct Pair {
        std::size_t begin = 0;
        std::size_t size = 0;  ///< 0 = there is none
    };
    using PairsOfLanes = std::array<Pair, lane_count>;
    /// A group that is not complete.
    struct Begun {
        PairsOfLanes pairs;
        std::size_t count = 0;
        std::size_t size = 0;  ///< of its largest pair
    };

    void clear(std::span<const ContactEnds> ends, std::size_t moving);
    void add(const PairsOfLanes& pairs, std::span<const std::uint32_t> order);
    void addColour(std::size_t colour);
    void begin(const Pair& pair);

    std::span<const ContactEnds> ends_;  ///< during a call
    std::size_t moving_ = 0;             ///< likewise
    ContactColours colours_;
    std::vector<LaneGroup> groups_;
    std::vector<std::size_t> set_begin_ = {0};  ///< [sets + 1] into groups_
    std::size_t shared_ = 0;                    ///< sets below this are shared
    std::vector<std::uint32_t> contact_of_;     ///< [rows · lane_count]
    std::vector<std::uint32_t> slot_of_;        ///< [contacts]
    std::vector<Begun> begun_;                  ///< groups in order
    std::vector<std::uint32_t> unfilled_;       ///< those of begun_ with an empty lane, ascending
    std::vector<std::uint32_t> next_;           ///< [moving bodies] the first group in which it may come again
    std::vector<std::uint32_t> as_they_come_;   ///< [contacts] 0, 1, …
};

}  // namespace cairn
