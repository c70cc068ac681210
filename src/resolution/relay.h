/// @file Several batches swept at once, each in a lane of its own.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "parallel/function_ref.h"
#include "resolution/sweeps.h"

namespace cairn {

/// Batches share no body that moves. So each lane of the vectors visits the contacts of another one, from body to body
/// and as often as if it were alone; when that is done the next batch takes its lane, so that none waits for the
/// others, however much larger they are or more sweeps they need. One object per thread: it owns its scratch memory.
class Relay {
  public:
    Relay();
    Relay(const Relay&) = delete;
    Relay& operator=(const Relay&) = delete;

    /// Sweeps batches until there are no more.
    /// @param prepare prepares the next batch, which has contacts and none of them framed; false = there is none
    /// @param end is called when a batch is done; each with the lane, below lane_count
    void run(FunctionRef<bool(std::size_t, Sweeps<OrderedSweeper>&)> prepare,
             FunctionRef<void(std::size_t, Sweeps<OrderedSweeper>&)> end);

  private:
    using Contact1 = BasicPgsContact<double>;

    /// Where a lane is in its batch.
    struct Lane {
        Contact1* contacts = nullptr;
        const ContactEnds* ends = nullptr;
        LocalBody* bodies = nullptr;
        std::ptrdiff_t next = 0;  ///< contact that is visited next
        std::ptrdiff_t step = 0;  ///< to the one after that: ±1, or 0 where there is no batch at present
        std::size_t count = 0;    ///< of its contacts
        std::size_t left = 0;     ///< of these on the way forth or back
    };

    bool take(FunctionRef<bool(std::size_t, Sweeps<OrderedSweeper>&)> prepare);
    void beginSweep(std::size_t lane);
    bool turn(std::size_t lane);
    void visitOne(Lane& lane, std::size_t visits);
    void visitAll(std::size_t visits);

    std::array<Lane, lane_count> lanes_;
    std::array<Sweeps<OrderedSweeper>, lane_count> sweeps_;
    std::vector<UnfilledContact> unfilled_;  ///< kept memory
    // What an empty lane visits: a contact that keeps its impulse, between bodies that nothing moves.
    Contact1 idle_contact_;
    ContactEnds idle_ends_{0, 1};
    std::vector<LocalBody> idle_bodies_;
};

}  // namespace cairn
