/// @file The list of closing contacts of Algorithm 9, in three forms with one interface. @source thesis §3.8
///
/// All read δ from the solver's array, are told by refresh() which δ have changed (once all changes are made; telling
/// twice is harmless), and give the next contact to resolve by next(). A contact is in the queue iff δ < threshold.
/// The smallest δ wins; of equal ones the lower index, which makes ArrayQueue and TournamentQueue give the same order,
/// bit for bit.
///
/// The switch point (ResolutionSettings::queue_switch): ns per resolution with ArrayQueue / TournamentQueue, one thread
/// of an AMD EPYC, g++ 12, lattices of balls (about ten contacts a body) and of boxes (twenty-four), six resolutions
/// per contact:
///   contacts  20       64       90–96     150–160   340       1250      2400
///   balls     85/89    105/108  112/108   129/111   260/151   449/197   832/221
///   boxes     82/83    126/121  141/122   165/125   323/145   624/184   909/187
/// Both cost the same up to about 64, the default; from there on the linear search grows with the contacts.
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
    void refresh(std::span<const std::uint32_t> contacts) {
        for (const std::uint32_t i : contacts) {
            if (list_.refresh(i)) updated_ = std::min(updated_, QueueEntry{delta_[i], i});
        }
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
    void refresh(std::span<const std::uint32_t> contacts) {
        for (const std::uint32_t i : contacts) list_.refresh(i);
    }
    std::uint32_t next() const { return list_.entries().empty() ? no_contact : list_.entries().front().contact; }

  private:
    ClosingList list_;
};

/// For many contacts: a tree in which every node holds the smallest δ of `fan_out` neighbours of the level below, or +∞
/// if none is below the threshold. Unlike in a heap nothing moves, and the contacts of a body, being neighbours, share
/// nodes: a resolution looks once at each node it affects, whose eight children fill one cache line.
class TournamentQueue {
  public:
    static constexpr std::size_t fan_out = 8;

    /// @pre the size of delta is a multiple of fan_out, and no δ is ever a NaN
    void reset(std::span<const double> delta, double threshold);
    void refresh(std::span<const std::uint32_t> contacts);
    std::uint32_t next();

  private:
    void carryUp();

    std::span<const double> delta_;
    double threshold_ = 0;
    std::vector<double> nodes_;             ///< levels from the lowest up, each filled up with +∞ to full families
    std::vector<std::size_t> level_begin_;  ///< [levels] offsets into nodes_; the last level is one family
    std::vector<std::uint32_t> changed_;    ///< nodes of one level whose value is new, each run of equals once
};

}  // namespace cairn
