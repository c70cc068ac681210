/// @file Sweeps that visit contacts one after the other.
#pragma once

#include <span>
#include <vector>

#include "resolution/pgs_batch.h"
#include "resolution/pgs_contact.h"

namespace cairn {

/// A contact of which is not computed yet what visits need.
struct UnfilledContact {
    const Contact* source;
    const LocalBody* a;  ///< its bodies
    const LocalBody* b;
    BasicPgsContact<double>* contact;  ///< where it is to be
};

/// Computes that for contacts of any batches, in lanes. @param position [slots] of the bodies [m, W]
void fillContacts(std::span<const UnfilledContact> contacts, std::span<const Vec3> position,
                  const ResolutionSettings& settings);

/// For contacts of a batch that no joint holds and that do not resist rolling, which are visited in their order, from
/// body to body. Keeps its memory between batches.
class OrderedSweeper {
  public:
    /// Whether direct steps may replace impulses.
    static constexpr bool steps_directly = true;

    /// Takes over the first contacts of a batch.
    void prepare(const PgsBatch& pgs, std::size_t contacts);
    /// Appends them to those that are to be filled before start(). @pre nothing of the batch moves until then
    void listUnfilled(const PgsBatch& pgs, std::vector<UnfilledContact>& unfilled);
    /// Fills them.
    void fill(const PgsBatch& pgs);
    /// Applies the impulses that the contacts begin with.
    void start(const PgsBatch& pgs);
    void sweepForth(const PgsBatch& pgs);
    void sweepBack(const PgsBatch& pgs);
    /// Remembers the impulses before a sweep.
    void save(const PgsBatch& pgs);
    /// Gives the contacts that slide their kinetic friction. @return whether any has another one now
    bool releaseSliding(const PgsBatch& pgs);

    /// What changed since save().
    SweepChange change(const PgsBatch& pgs) const;
    /// Adds β times the last direction to the impulses; the new direction is the change since save() plus that.
    void accelerate(double beta, const PgsBatch& pgs);
    /// Forgets the last direction.
    void restart();
    /// Writes the impulses to the contacts.
    void finish(const PgsBatch& pgs) const;

    std::span<BasicPgsContact<double>> contacts() { return contacts_; }
    /// A contact, with its bodies. @param contact its place in the batch
    PgsContact contactAt(std::size_t contact, const PgsBatch& pgs) const;
    /// Replaces an accumulated impulse, with what it does to the velocities. @param impulse [N·s, W]
    void setImpulse(std::size_t contact, const Triple1& impulse, LocalBatch& local);

  private:
    template <class Visit>
    void visitPairs(bool back, LocalBatch& local, const Visit& visit);

    std::vector<BasicPgsContact<double>> contacts_;
    std::vector<Triple1> before_;            ///< [contacts_] impulses at the beginning of the sweep [N·s]
    std::vector<Triple1> direction_;         ///< [contacts_] [N·s]
    std::vector<UnfilledContact> unfilled_;  ///< kept memory
};

}  // namespace cairn
