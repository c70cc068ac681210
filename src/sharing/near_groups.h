/// @file Groups of bodies that may touch soon, also of bodies that different ranks have.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/contact.h"
#include "broad_phase/hash_grids.h"
#include "cairn/ranks.h"

namespace cairn {

/// What groups are found of; one entry per slot.
struct NearGroupsInput {
    std::span<const BodyKind> kind;     ///< dynamic for the bodies of this rank, hole or fixed for all others
    std::span<const Bounds> cover;      ///< of the bodies of this rank: where they stay until groups are found anew
    std::span<const Vec3> position;     ///< of the same [m, W]
    std::span<const Contact> contacts;  ///< of the last step; two bodies that touched stay in one group
    std::span<const BodyPair> tied;     ///< bodies that belong together, wherever they are
};

/// Bodies whose covers overlap, that touched or are tied, and all that are so with them. Fixed bodies connect nobody.
/// Bodies of different groups cannot meet while all stay within their covers. Keeps its memory.
class NearGroups {
  public:
    /// Of a world that this rank has as a whole.
    void find(const NearGroupsInput& input, const Executor& executor);
    /// Of a world that ranks share; to be called by all of them, after meetOthers(), which need not have found any.
    void findAcross(const NearGroupsInput& input, const Executor& executor, Ranks& ranks);
    /// Lets ranks know each other's bodies where these come near. @return whether bodies of any two ranks are in one
    /// group; if not, no rank needs to know its groups
    bool meetOthers(const NearGroupsInput& input, const Executor& executor, Ranks& ranks);

    /// The lowest body of the group of a body of this rank, which names the group on all ranks.
    BodyIndex groupOf(BodyIndex i) { return representative(i); }
    /// The middle of the box around the centres of a group. @param group as groupOf() tells [m, W]
    Vec3 middleOf(BodyIndex group) const { return 0.5 * (box_[group].lower + box_[group].upper); }

  private:
    void begin(const NearGroupsInput& input);
    void searchAll(const NearGroupsInput& input);
    void tellCovers(const NearGroupsInput& input, Ranks& ranks);
    void connect(const NearGroupsInput& input, const Executor& executor);
    void addBoxes(const NearGroupsInput& input);
    void connectAcross(Ranks& ranks);
    BodyIndex representative(BodyIndex i);
    void join(BodyIndex a, BodyIndex b);

    HashGrids search_;
    std::vector<BodyIndex> parent_;     ///< [slots]
    std::vector<BodyKind> kind_;        ///< [slots] dynamic for those that are searched
    std::vector<std::uint8_t> others_;  ///< [slots] 1 = of another rank
    std::vector<Bounds> cover_;         ///< [slots]
    std::vector<Bounds> box_;           ///< [slots] of groups, around the centres of their bodies [m, W]
    std::vector<BodyPair> pairs_;
    std::vector<BodyPair> across_;        ///< pairs with a body of another rank
    std::vector<BodyIndex> near_others_;  ///< bodies of this rank in such pairs
};

}  // namespace cairn
