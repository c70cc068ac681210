/// @file Contacts that work with frames and one at a time: those of jointed bodies, whose impulses change all that is
/// tied together, and those that resist rolling.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "resolution/pgs_batch.h"
#include "resolution/pgs_contact.h"

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
    SweepChange change(const LocalBatch& local) const;
    /// Adds β times the last direction to the impulses; the new direction is the change since save() plus that.
    void accelerate(double beta);
    /// Forgets the last direction.
    void restart();
    /// Gives the contacts that slide their kinetic friction. @return whether any has another one now
    bool releaseSliding(const PgsBatch& pgs);
    /// Writes the impulses to the contacts, and finds those of the joints.
    void finish(const PgsBatch& pgs);

  private:
    /// A contact, and the angular impulse if it resists rolling.
    struct Framed : PgsContact {
        std::uint32_t source = 0;               ///< index of its Contact
        Triple1 before;                         ///< impulse at the beginning of the sweep [N·s]
        Triple1 direction;                      ///< last direction of the conjugate gradients [N·s]
        Vec3 turning = Vec3::Zero();            ///< accumulated angular impulse on A, contact coordinates [N·m·s]
        Vec3 turning_before = Vec3::Zero();     ///< at the beginning of the sweep [N·m·s]
        Vec3 turning_direction = Vec3::Zero();  ///< last direction of the conjugate gradients [N·m·s]
    };

    void beginContact(Framed& framed, ContactFrame& frame, const PgsBatch& pgs);
    void visit(std::size_t i, LocalBatch& local);
    void visitRolling(std::size_t i, LocalBatch& local);

    std::vector<Framed> contacts_;
    std::vector<ContactFrame> frames_;  ///< [contacts_]
};

}  // namespace cairn
