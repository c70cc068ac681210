/// @file Contacts of jointed bodies, whose impulses change all that is tied together: they work with frames and one at
/// a time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "resolution/pgs_batch.h"
#include "resolution/rolling_contact.h"

namespace cairn {

/// The framed contacts of one batch during its sweeps. Keeps its memory between batches.
class FramedContacts {
  public:
    /// Takes over some contacts of a batch, and applies the impulses that they begin with.
    /// @param first, end their places in the batch
    void begin(const PgsBatch& pgs, std::uint32_t first, std::uint32_t end);
    std::size_t size() const { return contacts_.size(); }
    void sweepForth(LocalBatch& local);
    void sweepBack(LocalBatch& local);
    /// Remembers the impulses before a sweep.
    void save();
    /// What changed since save().
    SweepChange change() const;
    /// Adds β times the last direction to the impulses; the new direction is the change since save() plus that.
    void accelerate(double beta);
    /// Forgets the last direction.
    void restart();
    /// Gives the contacts that slide their kinetic friction. @return whether any has another one now
    bool releaseSliding(const PgsBatch& pgs);
    /// Writes the impulses to the contacts, and finds those of the joints.
    void finish(const PgsBatch& pgs);

  private:
    /// A contact, of which only some resist rolling.
    struct Framed : ContactEnds, BasicRollingContact<double> {
        std::uint32_t source = 0;       ///< index of its Contact
        BasicWrench<double> before;     ///< what it has accumulated at the beginning of the sweep
        BasicWrench<double> direction;  ///< last direction of the conjugate gradients
    };

    void beginContact(Framed& framed, ContactFrame& frame, const PgsBatch& pgs);
    void beginRolling(Framed& framed, const ContactFrame& frame, const LocalBatch& local);
    template <class Work>
    void withSelf(std::size_t i, const Work& work);

    std::vector<Framed> contacts_;
    std::vector<ContactFrame> frames_;  ///< [contacts_]
};

}  // namespace cairn
