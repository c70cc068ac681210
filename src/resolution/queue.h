/// @file The list of closing contacts of Algorithm 9, in three forms with one interface. @source thesis §3.8
///
/// All read δ from the solver's array, are told by refresh(i) that δ[i] has changed (once all changes are
/// made; repeating it is harmless), and give the next contact to resolve by next(). A contact is in the queue iff δ <
/// threshold (so a NaN never is). The smallest δ wins; of equal ones the lower index, which makes ArrayQueue and
/// TournamentQueue give the same order, bit for bit.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace cairn {

/// "No contact".
inline constexpr std::uint32_t no_contact = UINT32_MAX;

/// A contact and its δ, in the order in which contacts are resolved.
struct QueueEntry {
    double delta = std::numeric_limits<double>::infinity();  ///< [m/s]
    std::uint32_t contact = no_contact;

    friend bool operator<(const QueueEntry& x, const QueueEntry& y) {
        return x.delta < y.delta || (x.delta == y.delta && x.contact < y.contact);
    }
};

/// The closing contacts, unsorted: insertion at the end, removal by moving the last one, both in constant time.
/// @source thesis Figures 24 and 25
class ClosingList {
  public:
    /// Empties the list. @param delta [m/s] per contact, must outlive the use @param threshold closing below it [m/s]
    void reset(std::span<const double> delta, double threshold);

    /// @return true if the contact is in the list now
    bool refresh(std::uint32_t contact) {
        const double delta = delta_[contact];
        std::uint32_t& place = place_[contact];
        if (delta < threshold_) {
            if (place == no_contact) {
                place = static_cast<std::uint32_t>(entries_.size());
                entries_.push_back({delta, contact});
            } else {
                entries_[place].delta = delta;
            }
            return true;
        }
        if (place != no_contact) remove(place);
        return false;
    }

    std::span<const QueueEntry> entries() const { return entries_; }

  private:
    void remove(std::uint32_t& place) {
        entries_[place] = entries_.back();
        place_[entries_[place].contact] = place;
        place = no_contact;
        entries_.pop_back();
    }

    std::span<const double> delta_;
    double threshold_ = 0;
    std::vector<QueueEntry> entries_;
    std::vector<std::uint32_t> place_;  ///< [contacts] index in entries_ or no_contact
};

/// For few contacts: a linear search, left out when an updated contact closes at least as fast as the one before.
class ArrayQueue {
  public:
    void reset(std::span<const double> delta, double threshold);
    void refresh(std::uint32_t contact) {
        if (list_.refresh(contact)) updated_ = std::min(updated_, QueueEntry{delta_[contact], contact});
    }
    std::uint32_t next();

  private:
    ClosingList list_;
    std::span<const double> delta_;
    QueueEntry updated_;  ///< first of those refreshed since the last next()
    QueueEntry last_;     ///< what next() gave last: everything not refreshed since comes after it
};

/// The comparison of §5.4: whichever contact stands first in the list.
class FirstEntryQueue {
  public:
    void reset(std::span<const double> delta, double threshold) { list_.reset(delta, threshold); }
    void refresh(std::uint32_t contact) { list_.refresh(contact); }
    std::uint32_t next() const { return list_.entries().empty() ? no_contact : list_.entries().front().contact; }

  private:
    ClosingList list_;
};

/// For many contacts: a tournament tree over all contacts. Every node holds the winner of `fan_out` neighbours of the
/// level below; the winner of the root is next. Unlike in a heap nothing moves: a changed δ that neither was nor
/// becomes the winner of its first node, the usual case, costs two comparisons.
class TournamentQueue {
  public:
    void reset(std::span<const double> delta, double threshold);
    void refresh(std::uint32_t contact) {
        const double delta = delta_[contact];
        const QueueEntry entry = delta < threshold_ ? QueueEntry{delta, contact} : QueueEntry{};
        QueueEntry& node = nodes_[contact / fan_out];
        if (entry < node) {
            node = entry;
        } else if (node.contact == contact) {
            node = winnerOfContacts(contact / fan_out);
        } else {
            return;
        }
        replay(entry, contact);
    }
    std::uint32_t next() const { return nodes_.back().contact; }

  private:
    static constexpr std::size_t fan_out = 8;  // eight δ fill one cache line

    QueueEntry winnerOfContacts(std::size_t node) const;
    void replay(const QueueEntry& entry, std::uint32_t contact);

    std::span<const double> delta_;
    double threshold_ = 0;
    std::vector<QueueEntry> nodes_;         ///< all levels from the lowest up; the last node is the root
    std::vector<std::size_t> level_begin_;  ///< [levels + 1] offsets into nodes_
};

}  // namespace cairn
