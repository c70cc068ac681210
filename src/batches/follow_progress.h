/// @file Whether it is of use to go on with what the resolution left closing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "batches/batches.h"
#include "math/groups.h"
#include "parallel/function_ref.h"

namespace cairn {

/// How much is left closing among bodies that were resolved together in a step, round after round. What presses bodies
/// between others that nothing can stop has no solution, and what closes too far may be handed from pair to pair
/// without end: where rounds do not halve the sum, nobody goes on with it in this step.
class FollowProgress {
  public:
    /// Begins a step, or a part of it: nobody was resolved together with anybody. @param kind must live as long
    void begin(std::span<const BodyKind> kind);
    /// The bodies of each of these groups are resolved together.
    void join(std::span<const BatchView> groups);
    /// Takes the contacts out of those left closing that it is no use to go on with.
    /// @param left indices of contacts @param added those that came since the last round: where they strike, it is
    /// measured anew @param amountOf how far a contact of the first is left closing [any unit], ≥ 0
    void giveUp(std::vector<std::uint32_t>& left, std::span<const std::uint32_t> added,
                std::span<const Contact> contacts, FunctionRef<double(std::uint32_t)> amountOf);

  private:
    /// What is known of bodies that were resolved together.
    struct Chain {
        double amount = 0;    ///< that is left closing in this round
        double helped = 0;    ///< the same of the last round that helped; 0 = of none
        int useless = 0;      ///< rounds since
        bool struck = false;  ///< since the last round
    };

    BodyIndex rootOf(const Contact& contact);
    void join(BodyIndex a, BodyIndex b);

    std::span<const BodyKind> kind_;
    Groups bodies_;                   ///< chains, each named by its root
    std::vector<Chain> chains_;       ///< [slots] of roots
    std::vector<BodyIndex> members_;  ///< of chains that are not of one body with nothing left, maybe several times
    std::vector<BodyIndex> roots_;    ///< of what is left, ascending
};

}  // namespace cairn
