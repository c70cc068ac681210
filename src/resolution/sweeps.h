/// @file Projected Gauss–Seidel, accelerated by nonlinear conjugate gradients.
#pragma once

#include <optional>
#include <vector>

#include "resolution/batch_plan.h"
#include "resolution/body_direction.h"
#include "resolution/direct_step.h"
#include "resolution/framed_contacts.h"
#include "resolution/lane_sweeper.h"
#include "resolution/ordered_sweeper.h"

namespace cairn {

/// Sweeps over the contacts of a batch, forth and back, with accumulated impulses that begin where the last step ended,
/// and accelerates the sweeps. Sweeping back as well as forth keeps the contacts of a body alike, so that resting piles
/// do not creep, and makes a sweep a symmetric preconditioner. One object per thread: it owns its scratch memory.
/// @tparam Sweeper an OrderedSweeper, or a LaneSweeper for a batch that is large enough to fill lanes
template <class Sweeper>
class Sweeps {
  public:
    /// @return contacts visited
    std::int64_t resolve(const BatchView& batch, const BatchKind& kind, std::span<Contact> contacts,
                         const BodyState& bodies, const ResolutionSettings& settings, const Executor& executor);

    // The same in parts, for who visits the contacts of its sweeper(), if there are no
    // others: prepare(), the sweeper's start, then
    // beginSweep(), visits forth and back, and endSweep(), until it is done, and finish(). All that is passed must
    // outlive them.
    void prepare(const BatchView& batch, const BatchKind& kind, std::span<Contact> contacts, const BodyState& bodies,
                 const ResolutionSettings& settings, const Executor& executor);
    void beginSweep();
    /// Finds what the sweep changed, and decides how to go on.
    void endSweep();
    bool isDone() const { return done_; }
    /// @return contacts visited
    std::int64_t finish();
    Sweeper& sweeper() { return sweeper_; }
    const PgsBatch& pgs() const { return *pgs_; }

    /// How many sweeps the last batch took.
    std::uint32_t sweeps() const { return sweeps_; }

  private:
    void gather(const BatchView& batch, const BatchKind& kind, std::span<const Contact> contacts,
                const BodyState& bodies);
    bool rolls() const { return unframed_ > plain_; }
    void judge(const SweepChange& change);
    bool endPass();
    bool takeDirectStep();
    void revert();
    void accelerate(double beta);

    std::optional<PgsBatch> pgs_;
    BatchView batch_;           ///< with the contacts that resist rolling after the others, and the framed ones last
    bool framed_kind_ = false;  ///< it may have framed contacts: it has joints
    LocalBatch local_;
    Sweeper sweeper_;
    RollingSweeper rolling_;
    FramedContacts framed_;
    BodyDirection direction_;
    DirectStep direct_;
    std::vector<std::uint32_t> contacts_;  ///< those of batch_
    std::size_t plain_ = 0;                ///< contacts_ below this are the sweeper's
    std::size_t unframed_ = 0;             ///< and those from there to this resist rolling; the others are framed
    std::vector<PgsContact> gathered_;     ///< for direct steps
    SweepPlan plan_;
    SweepProgress progress_;
    std::uint32_t sweeps_ = 0;
    std::int64_t visits_ = 0;
    bool done_ = true;
    bool measured_ = false;           ///< what the sweep at hand changes is found
    bool bounds_changed_ = false;     ///< of joints, before it
    bool two_frictions_ = false;      ///< and who slides does not have its kinetic friction yet
    bool may_step_directly_ = false;  ///< direct steps are allowed
    bool stepped_directly_ = false;   ///< the impulses were changed by a direct step, which the next sweep judges
    std::vector<Triple1> kept_;       ///< [contacts] impulses before a direct step [N·s]
};

extern template class Sweeps<OrderedSweeper>;
extern template class Sweeps<LaneSweeper>;

}  // namespace cairn
