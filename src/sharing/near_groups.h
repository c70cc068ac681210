/// @file Groups of bodies that may touch soon, also of bodies that different ranks have.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "body/contact.h"
#include "broad_phase/broad_phase.h"
#include "cairn/ranks.h"

namespace cairn {

/// What groups are found of; one entry per slot of this rank.
struct NearGroupsInput {
    std::span<const BodyKind> kind;     ///< dynamic for the bodies of this rank, hole or fixed for all others
    std::span<const Bounds> cover;      ///< of the bodies of this rank: where they stay until groups are found anew
    std::span<const Vec3> position;     ///< of the same [m, W]
    std::span<const Contact> contacts;  ///< of the last step; two bodies that touched stay in one group
    std::span<const BodyPair> tied;     ///< bodies that belong together, wherever they are
    BroadPhase& search;                 ///< that has time now: it is used here
    /// Which slot of the whole world each stands for, ascending: what ranks call the body; empty = the same.
    std::span<const BodyIndex> home{};
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

    /// The group of a body of this rank.
    BodyIndex groupOf(BodyIndex i) { return representative(i); }
    /// The home of its lowest body, which names a group on all ranks. @param group as groupOf() tells
    BodyIndex nameOf(BodyIndex group) const { return home_[group]; }
    /// The middle of the box around the centres of a group. @param group as groupOf() tells [m, W]
    Vec3 middleOf(BodyIndex group) const { return 0.5 * (box_[group].lower + box_[group].upper); }

  private:
    void begin(const NearGroupsInput& input);
    void searchAll(const NearGroupsInput& input);
    void tellCovers(const NearGroupsInput& input, Ranks& ranks);
    void connect(const NearGroupsInput& input, const Executor& executor);
    void addBoxes(const NearGroupsInput& input);
    void connectAcross(Ranks& ranks);
    BodyIndex entryOf(BodyIndex home);
    BodyIndex representative(BodyIndex i);
    void join(BodyIndex a, BodyIndex b);

    // Bodies of other ranks that have no slot here stand behind the slots.
    std::vector<BodyIndex> home_;       ///< [entries]
    std::vector<BodyIndex> parent_;     ///< [entries]
    std::vector<BodyKind> kind_;        ///< [entries] dynamic for those that are searched
    std::vector<std::uint8_t> others_;  ///< [entries] 1 = of another rank
    std::vector<Bounds> cover_;         ///< [entries]
    std::vector<Bounds> box_;           ///< [entries] of groups, around the centres of their bodies [m, W]
    std::size_t slots_ = 0;
    std::unordered_map<BodyIndex, BodyIndex> behind_;  ///< entries behind the slots, by home
    std::vector<BodyPair> pairs_;
    std::vector<BodyPair> across_;        ///< pairs with a body of another rank
    std::vector<BodyIndex> near_others_;  ///< bodies of this rank in such pairs
};

}  // namespace cairn
