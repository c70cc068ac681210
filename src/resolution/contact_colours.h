/// @file The order of a parallel sweep: contacts by colours, no two pairs of a colour sharing a body that moves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// The two bodies of a contact, in the local numbering of a batch.
struct ContactEnds {
    std::uint32_t a, b;
    bool operator==(const ContactEnds&) const = default;
};

/// Contacts of the same two bodies stay together, in their order: a "pair". Pairs get the lowest colour that none of
/// their moving bodies has yet, in ascending order, so the colours depend on nothing but the contacts.
class ContactColours {
  public:
    /// Colours of a batch. @param ends [contacts] those of a pair next to each other @param moving bodies below this
    /// index move
    void colour(std::span<const ContactEnds> ends, std::size_t moving);

    /// [contacts] places in colour order: place k holds contact order()[k]
    std::span<const std::uint32_t> order() const { return order_; }
    std::size_t colours() const { return colour_begin_.size() - 1; }
    /// The pairs of colours below this may be worked on at the same time.
    std::size_t shared() const { return shared_; }
    /// Likewise of one colour.
    bool isShared(std::size_t colour) const { return colour < shared_; }
    std::size_t pairs(std::size_t colour) const { return colour_begin_[colour + 1] - colour_begin_[colour]; }
    /// First place of a pair of a colour; with pair = pairs(colour) the end of the last.
    std::size_t begin(std::size_t colour, std::size_t pair) const { return pair_begin_[colour_begin_[colour] + pair]; }

  private:
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> pair_begin_;    ///< [pairs + 1] places
    std::vector<std::uint32_t> colour_begin_;  ///< [colours + 1] pairs
    std::size_t shared_ = 0;                   ///< colours below this are free of common bodies

    std::vector<std::uint64_t> used_;        ///< [bodies] a bit per colour
    std::vector<std::uint8_t> colour_of_;    ///< [pairs]
    std::vector<std::uint32_t> first_;       ///< [pairs + 1] contacts
    std::vector<std::uint32_t> pair_order_;  ///< [pairs]
};

}  // namespace cairn
