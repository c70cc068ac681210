/// @file Sweeps that visit one contact at a time.
#pragma once

#include <span>
#include <vector>

#include "resolution/sweeper.h"
#include "resolution/swept_contact.h"

namespace cairn {

/// For batches with joints or rolling friction, and for those without many contacts: contacts are visited from body to
/// body, which carries impulses farther in a sweep than any other order.
class PlainSweeper final : public Sweeper {
  public:
    void begin(const SweptBatch& swept) override;
    std::size_t size() const override { return contacts_.size(); }
    void sweep(const SweptBatch& swept) override;
    void note(const SweptBatch& swept) override;
    SweepChange change(const SweptBatch& swept) override;
    void accelerate(double beta, const SweptBatch& swept) override;
    void restart() override;
    bool releaseSliding(const SweptBatch& swept) override;
    void finish(const SweptBatch& swept) override;

    /// In the batch's order.
    std::span<const SweptContact> contacts() const { return contacts_; }
    /// Replaces an accumulated impulse, with what it does to the velocities. @param impulse [N·s, W]
    void setImpulse(std::size_t contact, const Triple1& impulse, LocalBatch& local);

  private:
    /// The angular impulse of a contact that resists rolling; contact coordinates.
    struct Rolling {
        Vec3 impulse = Vec3::Zero();    ///< accumulated, on A [N·m·s]
        Vec3 direction = Vec3::Zero();  ///< last direction of the conjugate gradients [N·m·s]
        Vec3 before = Vec3::Zero();     ///< at the beginning of the sweep [N·m·s]
    };

    void beginContact(std::size_t i, const SweptBatch& swept);
    template <class Visit>
    void visitPair(std::size_t pair, LocalBatch& local, const Visit& visit);
    void visitFramed(std::size_t i, LocalBatch& local);
    void visitRolling(SweptContact& contact, const ContactFrame& frame, LocalBatch& local);
    void addRollingChange(const LocalBatch& local, SweepChange& change) const;
    void settleFrames(const SweptBatch& swept);

    bool framed_ = false;                  ///< the batch has frames of the contacts
    std::span<SweptContact> contacts_;     ///< in the batch's order
    std::vector<std::size_t> pair_begin_;  ///< [pairs + 1] contacts next to each other that have the same bodies
    std::vector<Rolling> rolling_;         ///< as LocalBatch::rolling
    std::span<Triple1> before_;            ///< [contacts] impulses at the beginning of the sweep [N·s]
    std::vector<Triple1> direction_;       ///< [contacts] [N·s]
    std::vector<SweptContact> memory_;     ///< contacts_ and more
    std::vector<Triple1> memory_before_;   ///< before_ and more
};

}  // namespace cairn
