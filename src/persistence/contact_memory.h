/// @file Carries the impulses of contacts from one step to the next, so that a resolution can begin where the last one
/// ended (warm starting).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "body/body_storage.h"
#include "body/contact.h"
#include "parallel/executor.h"

namespace cairn {

/// Remembers where contacts were on their two bodies and which impulse they ended with. Contacts are recognised by
/// their place on either body, which survives a change of the reference face better than feature numbers do.
class ContactMemory {
  public:
    /// Gives every contact the impulse that the nearest remembered contact of its pair ended with, or zero.
    /// @param known [slots] 1 = contacts of two such bodies have their impulses of the last step already; or empty
    /// @param contacts sorted by (a, b)
    void recall(const BodyStorage& bodies, std::span<const std::uint8_t> known, std::span<Contact> contacts,
                const Executor& executor);
    /// Replaces the memory. @param contacts those of the last recall(), with the impulses they ended with
    /// @param unmoved [slots] 1 = the body has been where it is since the last store()
    void store(const BodyStorage& bodies, std::span<const std::uint8_t> unmoved, std::span<const Contact> contacts,
               const Executor& executor);
    /// Forgets the contacts of a slot, whose body is removed.
    void forget(BodyIndex body);
    void clear() { entries_.clear(); }

    /// A contact of the last step.
    struct Entry {
        BodyIndex a, b;
        Vec3 place_a;            ///< [m, frame of A]
        Vec3 place_b;            ///< [m, frame of B]
        Vec3 impulse;            ///< on A [N·s, W]
        Vec3 reference_impulse;  ///< Contact::reference_impulse
    };
    std::span<const Entry> entries() const { return entries_; }
    /// Takes over a memory that was saved. @param entries sorted by (a, b)
    void restore(std::vector<Entry> entries) { entries_ = std::move(entries); }

  private:
    static void recallPair(const BodyStorage& bodies, std::span<Contact> contacts, std::span<const Entry> candidates);
    std::span<const Entry> entriesOf(const Contact& contact, std::size_t& cursor) const;
    bool beginsAt(std::size_t place, const Contact& contact) const;

    std::vector<Entry> entries_;      ///< sorted by (a, b)
    std::vector<std::uint8_t> same_;  ///< [contacts] 1 = the entry in its place is of the same contact, which is still
};

}  // namespace cairn
