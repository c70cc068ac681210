/// @file Pairs of bodies that are near each other, kept until a body leaves the place that they were found for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/contact.h"
#include "broad_phase/broad_phase.h"

namespace cairn {

/// Two bodies near each other and their contacts, which stand side by side. It lives as long as the bounds that the two
/// were searched with overlap.
struct ContactPair : BodyPair {
    std::uint32_t first = 0;         ///< index of the first contact of the last detection
    std::uint32_t count = untested;  ///< number of contacts
    bool ahead = false;              ///< the contacts depend on velocities: a body of the pair was looked ahead for

    /// Stands for the number before the first test.
    static constexpr std::uint32_t untested = UINT32_MAX;

    bool isTested() const { return count != untested; }
    bool touches() const { return count != 0 && isTested(); }
    /// Its own. @param contacts of the last detection
    std::span<const Contact> contactsIn(std::span<const Contact> contacts) const {
        return touches() ? contacts.subspan(first, count) : std::span<const Contact>();
    }
};

/// What the list depends on; one entry per slot.
struct NeighbourListInput {
    std::span<const BodyKind> kind;
    std::span<const Bounds> bounds;       ///< [m, W] grown by the contact margin
    std::span<const Vec3> v;              ///< [m/s, W]
    std::span<const std::uint8_t> still;  ///< 1 = it did not move in the last time step
};

/// Searches with bounds that are larger than needed: by a part of the body's size on all sides, and by its way in the
/// time that follows. As long as all bodies stay within these, no pair can be missing, and nothing has to be searched.
/// Which pairs really overlap is left to the caller, so that nothing depends on when was searched last.
/// @source Verlet: Computer "experiments" on classical fluids, Physical Review 159 (1967), doi:10.1103/PhysRev.159.98:
///         lists of neighbours that last for several time steps
class NeighbourList {
  public:
    /// Brings the pairs up to date.
    void update(const NeighbourListInput& input, BroadPhase& broad_phase, const Executor& executor);
    /// To be called when all bodies are others: the next update begins anew, with the memory of this one and with the
    /// pairs of the contacts. @param contacts sorted by (a, b)
    void begin(std::span<const Contact> contacts);
    /// To be called when some bodies are others: drops their pairs.
    /// @param others [slots] 1 = its body is another, or gone
    void drop(std::span<const std::uint8_t> others);
    /// To be called when some bodies left and others came, which the next update searches.
    /// @param left [slots] 1 = the slot's body left @param pairs sorted, none of bodies that left; out: kept memory
    void replace(std::span<const std::uint8_t> left, std::vector<ContactPair>& pairs);
    /// To be called when bodies stand in other slots. @pre no pair is of a slot that is gone
    void rearrange(const SlotMove& move);
    /// Sorted by (a, b), each once; among them all pairs (a < b, not both fixed) whose bounds overlap. New ones
    /// are untested.
    std::span<ContactPair> pairs() { return pairs_; }
    std::span<const ContactPair> pairs() const { return pairs_; }

  private:
    bool findLeft(const NeighbourListInput& input, const Executor& executor);
    void cover(const NeighbourListInput& input, bool all, const Executor& executor);
    void dropLeft();

    std::vector<ContactPair> pairs_;
    std::vector<Bounds> covered_;      ///< [slots] bounds of the last search [m, W]
    std::vector<BodyKind> kind_;       ///< [slots] at the last search
    std::vector<std::uint8_t> stays_;  ///< [slots] 1 = within covered_
    bool searched_ = false;            ///< by the last update
    std::vector<BodyPair> new_pairs_;  ///< those with a body whose covered_ is new
};

}  // namespace cairn
