/// @file The list of closing contacts of Algorithm 9, in three forms with one interface. @source thesis §3.8
///
/// All have one interface:
/// - reset(lists, delta, threshold) empties the queue. `lists` are the contacts of each body, `delta` [m/s] is the
///   solver's array of δ, of which none is ever a NaN; both must outlive the use. A contact closes iff δ < threshold.
/// - insert(contact, body) adds a contact, once for each of its bodies that contacts can change.
/// - bodyChanged(body) tells that the δ of all contacts of a body may have changed; only once all changes are made.
/// - contactOpened(contact) tells that δ of a closing contact has grown to the threshold or more for another reason.
/// - next() gives the closing contact to resolve next, or no_contact.
/// The smallest δ wins; of equal ones the lower index, which makes ArrayQueue and TournamentQueue give the same order,
/// bit for bit.
///
/// The switch point (QueueConstants::queue_switch): ns per resolution with ArrayQueue / TournamentQueue, one thread
/// of an AMD EPYC, g++ 12, lattices of balls (about ten contacts a body) and of boxes (twenty-four), six resolutions
/// per contact:
///   contacts  20       64       90–96     150–160   340       1250      2400
///   balls     85/89    105/108  112/108   129/111   260/151   449/197   832/221
///   boxes     82/83    126/121  141/122   165/125   323/145   624/184   909/187
/// Both cost the same up to about 64; from there on the linear search grows with the contacts. Measured
/// before frames were built when first needed and both queues became cheaper.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "resolution/contact_lists.h"

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
    void reset(const ContactLists& lists, std::span<const double> delta, double threshold);
    void insert(std::uint32_t contact, std::uint32_t) { refresh(contact); }
    void bodyChanged(std::uint32_t body) {
        for (const std::uint32_t i : (*lists_)[body]) refresh(i);
    }
    void contactOpened(std::uint32_t contact) { refresh(contact); }
    std::uint32_t next();

  private:
    void refresh(std::uint32_t contact) {
        if (list_.refresh(contact)) updated_ = std::min(updated_, QueueEntry{delta_[contact], contact});
    }

    ClosingList list_;
    const ContactLists* lists_ = nullptr;
    std::span<const double> delta_;
    QueueEntry updated_;  ///< first of those refreshed since the last next()
    QueueEntry last_;     ///< what next() gave last: everything not refreshed since comes after it
};

/// The comparison of §5.4, which leaves open which closing contact comes next: the one that began to close last. The
/// contacts form a chain, the latest at its end, so that everything takes constant time.
class LatestFirstQueue {
  public:
    void reset(const ContactLists& lists, std::span<const double> delta, double threshold);
    void insert(std::uint32_t contact, std::uint32_t) { refresh(contact); }
    void bodyChanged(std::uint32_t body) {
        for (const std::uint32_t i : (*lists_)[body]) refresh(i);
    }
    void contactOpened(std::uint32_t contact) { refresh(contact); }
    std::uint32_t next() const { return latest_; }

  private:
    /// The neighbours of a contact in the chain.
    struct Link {
        std::uint32_t earlier = no_contact;
        std::uint32_t later = no_contact;
        bool closes = false;
    };

    void refresh(std::uint32_t contact);
    void append(std::uint32_t contact);
    void remove(std::uint32_t contact);

    const ContactLists* lists_ = nullptr;
    std::span<const double> delta_;
    double threshold_ = 0;
    std::vector<Link> links_;  ///< [contacts]
    std::uint32_t latest_ = no_contact;
};

/// For many contacts: a tree over the bodies. Each body notes the smallest δ of its contacts as it was when the body
/// was refreshed last, and every node of the tree holds the smallest note of `fan_out` neighbours of the level below.
///
/// A resolution changes all contacts of two bodies: only these two are refreshed, which changes two notes and the few
/// nodes above them. The notes of their neighbours may then be out of date, but never so that a contact is missed: a
/// contact's δ is changed by its two bodies only, and is no smaller than the note of the one that changed it last. So
/// the smallest note is no larger than the smallest δ. If it is the δ of the contact that it was taken from, that
/// contact is the one to resolve next; if not, the body is refreshed, and the search goes on.
class TournamentQueue {
  public:
    static constexpr std::size_t fan_out = 8;

    void reset(const ContactLists& lists, std::span<const double> delta, double threshold);
    void insert(std::uint32_t contact, std::uint32_t body);
    void bodyChanged(std::uint32_t body);
    void contactOpened(std::uint32_t) {}  // its bodies' notes are too small now, which next() finds out
    std::uint32_t next();

  private:
    void arrange();
    void carryUp(std::uint32_t body, double smallest);
    std::uint32_t searchFamily(std::size_t level, std::size_t family, double smallest);

    const ContactLists* lists_ = nullptr;
    std::span<const double> delta_;
    double threshold_ = 0;
    std::vector<std::uint32_t> noted_;      ///< [bodies] the contact whose δ was noted; of equal ones the lowest
    std::vector<double> nodes_;             ///< levels from the notes up, each filled up with +∞ to full families
    std::vector<std::size_t> level_begin_;  ///< [levels] offsets into nodes_; the last level is one family
    std::vector<std::uint32_t> outdated_;   ///< bodies that next() found to be out of date
    double smallest_ = 0;                   ///< of all nodes
    bool arranged_ = false;                 ///< all nodes above the notes belong to them
};

}  // namespace cairn
