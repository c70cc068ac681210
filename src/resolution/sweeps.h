/// @file Projected Gauss–Seidel, accelerated by nonlinear conjugate gradients.
#pragma once

#include <array>
#include <vector>

#include "resolution/batch_plan.h"
#include "resolution/body_direction.h"
#include "resolution/direct_step.h"
#include "resolution/framed_contacts.h"
#include "resolution/lane_sweeper.h"

namespace cairn {

/// Sweeps over the contacts of batches, forth and back, with accumulated impulses that begin where the last step ended,
/// and accelerates the sweeps. Sweeping back as well as forth keeps the contacts of a body alike, so that resting piles
/// do not creep, and makes a sweep a symmetric preconditioner.
///
/// Batches share no body that moves. So several small ones are solved together, each in a lane of the vectors: every
/// lane visits the contacts of its batch from body to body, as if it were alone, and stops when that batch is done. A
/// large one gets all lanes, and all threads, by colours. One object per thread: it owns its scratch memory.
/// @tparam Number a double for one batch at a time, or Lanes
template <class Number>
class Sweeps {
  public:
    static constexpr std::size_t lanes = lanes_in<Number>;

    /// @param batches at most one per lane; one alone where it is framed or by colours @param kinds of them
    /// @return contacts visited
    std::int64_t resolve(std::span<const BatchView> batches, std::span<const BatchKind> kinds,
                         std::span<Contact> contacts, const BodyState& bodies, const ResolutionSettings& settings,
                         const Executor& executor);

    /// How many sweeps a batch of the last call took.
    std::uint32_t sweepsOf(std::size_t batch) const { return courses_[batch].sweeps; }

  private:
    /// A batch that is solved.
    struct Course {
        SweepPlan plan;
        SweepProgress progress;
        LaneRange range;
        std::uint32_t sweeps = 0;
        bool active = false;
        bool two_frictions = false;      ///< and who slides does not have its kinetic friction yet
        bool may_step_directly = false;  ///< direct steps are allowed
        bool stepped_directly = false;   ///< the impulses were changed by a direct step, which the next sweep judges
        bool advances = false;           ///< is accelerated before its next sweep
        bool starts = false;             ///< and has no last direction
        double beta = 0;                 ///< how much of the last direction is added
        std::vector<Triple1> kept;       ///< [contacts] impulses before a direct step [N·s]
    };

    void gather(std::span<const BatchView> batches, std::span<const BatchKind> kinds, std::span<const Contact> contacts,
                const BodyState& bodies, const ResolutionSettings& settings);
    void begin(const PgsBatch& pgs, const BatchKind& kind);
    std::int64_t sweepAll(const PgsBatch& pgs);
    void sweepOnce(const PgsBatch& pgs, bool measured);
    void judge(std::size_t n, bool bounds_changed, const PgsBatch& pgs);
    bool endPass(std::size_t n, const PgsBatch& pgs);
    bool takeDirectStep(Course& course, const PgsBatch& pgs);
    void accelerate(const PgsBatch& pgs);
    void revert(const Course& course);

    LocalBatch local_;
    LaneSweeper<Number> sweeper_;
    FramedContacts framed_;
    BodyDirection direction_;
    DirectStep direct_;
    std::vector<BodyIndex> bodies_;               ///< of all batches, batch after batch
    std::vector<std::uint32_t> contacts_;         ///< likewise, then the framed ones
    std::vector<std::uint32_t> framed_contacts_;  ///< the latter
    std::size_t plain_ = 0;                       ///< contacts_ below this are in lanes
    std::vector<PgsContact> gathered_;            ///< of one batch, for direct steps
    std::array<Course, lanes> courses_;
    std::array<SweepChange, lanes> changes_;  ///< by the last sweep
    bool coloured_ = false;                   ///< one batch has all lanes
};

extern template class Sweeps<double>;
extern template class Sweeps<Lanes>;

}  // namespace cairn
