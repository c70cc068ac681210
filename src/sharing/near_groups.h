/// @file Groups of bodies that may touch soon, also of bodies that different ranks have.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "broad_phase/broad_phase.h"
#include "cairn/ranks.h"
#include "parallel/executor.h"
#include "sharing/realms.h"

namespace cairn {

/// What ranks call a body, its slot of the whole world, and where it stays until groups are found anew [m, W].
struct CoveredBody {
    BodyIndex home;
    Bounds cover;
};

/// What groups are found of. The search has time now: it is used here.
struct NearGroupsInput {
    std::span<const CoveredBody> bodies;  ///< of this rank, ascending by home
    std::span<const Vec3> position;       ///< of the same [m, W]
    std::span<const BodyPair> joined;     ///< indices of those that stay in one group, wherever they are
    BroadPhase& search;
    const Executor& executor;
};

/// Bodies whose covers overlap or that are joined, and all that are so with them. Bodies of different groups cannot
/// meet while all stay within their covers. Keeps its memory.
class NearGroups {
  public:
    /// Finds the pairs of bodies of two ranks whose covers overlap. @param own of this rank @param others of all others
    void meet(std::span<const CoveredBody> own, std::span<const CoveredBody> others, BroadPhase& search,
              const Executor& executor);
    /// The bodies of this rank in these pairs: indices of what was told to meet(), ascending, each once.
    std::span<const std::uint32_t> met() const { return met_; }

    /// Groups of bodies of this rank.
    void find(const NearGroupsInput& input);
    /// Joins groups of all ranks by the pairs that meet() found; to be called by all of them.
    /// @pre find() was told of all bodies of groups that met() is in
    void joinAcross(Ranks& ranks);

    /// The group of a body that find() was told of. @param i index there
    BodyIndex groupOf(BodyIndex i) { return representative(i); }
    /// The home of its lowest body, which names a group on all ranks. @param group as groupOf() tells
    BodyIndex nameOf(BodyIndex group) const { return home_[group]; }
    /// The middle of the box around the centres of a group. @param group as groupOf() tells [m, W]
    Vec3 middleOf(BodyIndex group) const { return 0.5 * (box_[group].lower + box_[group].upper); }

  private:
    BodyIndex entryOf(BodyIndex home);
    BodyIndex representative(BodyIndex i);
    void join(BodyIndex a, BodyIndex b);

    // Bodies of other ranks stand behind those of this one.
    std::vector<BodyIndex> home_;    ///< [entries]
    std::vector<BodyIndex> parent_;  ///< [entries]
    std::vector<Bounds> box_;        ///< [entries] of groups, around the centres of their bodies [m, W]
    std::size_t own_ = 0;
    std::unordered_map<BodyIndex, BodyIndex> behind_;  ///< entries of bodies of other ranks, by home

    /// A body of this rank and one of another.
    struct Across {
        BodyIndex own, other;  ///< homes
    };
    std::vector<Across> across_;
    std::vector<std::uint32_t> met_;
    std::vector<BodyIndex> met_homes_;

    // For the search.
    std::vector<BodyKind> kind_;
    std::vector<std::uint8_t> still_;
    std::vector<Bounds> cover_;
    std::vector<BodyPair> pairs_;
};

}  // namespace cairn
