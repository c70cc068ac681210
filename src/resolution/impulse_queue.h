/// @file The thesis's resolution: always the contact that closes fastest, then shock propagation.
/// @source thesis §3.6–3.8, Algorithms 8, 9, 10 and 11
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "resolution/contact_law.h"
#include "resolution/impulse.h"
#include "resolution/local_batch.h"
#include "resolution/normal_rows.h"
#include "resolution/queue.h"
#include "resolution/resolution.h"

namespace cairn {

/// A loop that would never end (settings without a limit, contacts that keep waking each other) ends here; it counts as
/// having reached the limit.
inline constexpr std::int64_t iteration_cap = 10'000'000;

/// Limit of iterations for a number of contacts. @param multiple of the contacts; 0 = unlimited (iteration_cap)
/// @return 1 to iteration_cap
std::int64_t iterationLimit(double multiple, std::size_t contacts);

/// What a run of Algorithm 9 did.
struct RunOutcome {
    std::int64_t iterations = 0;
    bool still_closing = false;  ///< the limit was reached with contacts left in the queue
};

/// One batch under resolution. Shock propagation runs on the same object, with masses changed in `batch`.
class QueueSolver {
  public:
    /// @param queue_switch QueueConstants::queue_switch
    explicit QueueSolver(std::size_t queue_switch) : queue_switch_(queue_switch) {}
    /// Initialises all contacts (lines 2–4 of Algorithm 9).
    void begin(const BatchView& view, std::span<const Contact> contacts, const BodyState& bodies,
               const ResolutionSettings& settings);
    /// Resolves closing contacts until there are none or the limit is reached (lines 5–24 of Algorithm 9).
    /// @param members local indices, ascending; all other contacts are left alone @param iterations_per_contact limit
    /// as a multiple of the members; 0 = unlimited
    RunOutcome run(std::span<const std::uint32_t> members, double iterations_per_contact);

    LocalBatch batch;
    NormalRows rows;

  private:
    template <class Queue>
    RunOutcome runWith(Queue& queue, std::span<const std::uint32_t> members, std::int64_t limit);
    template <class Queue>
    void pushJointed(Queue& queue, std::uint32_t contact, const Vec3& j);
    template <class Queue>
    void resolveByLaw(Queue& queue, std::uint32_t contact, const Vec3& velocity);
    template <class Queue>
    void jointedChanged(Queue& queue, std::uint32_t contact);
    template <class Queue>
    void freeChanged(Queue& queue, std::uint32_t contact, const ContactChange& change);
    template <class Queue>
    std::int64_t resolve(Queue& queue, std::uint32_t contact);

    std::size_t queue_switch_;
    ResolutionSettings settings_;
    ContactLaw law_;
    double threshold_ = 0;  ///< thr_res < 0 [m/s] (3.4.3)
    /// [contacts + 1] δ = ϑA0 − ϑB0 of the members [m/s]; all else has +∞, which updates keep. The last is NormalRows'.
    std::vector<double> delta_;
    ArrayQueue array_queue_;
    TournamentQueue tournament_queue_;
    LatestFirstQueue latest_first_queue_;
};

}  // namespace cairn
