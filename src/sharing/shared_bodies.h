/// @file The bodies of a world that several ranks share: each that can move is on one of them, together with all that
/// it may touch, so that every rank steps its bodies as if there were no others.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "body/body_storage.h"
#include "body/contact.h"
#include "cairn/ranks.h"
#include "joints/joint.h"
#include "messages/packing.h"
#include "pairs/pair_table.h"
#include "regions/regions.h"
#include "sharing/near_groups.h"

namespace cairn {

/// What of a world is dealt out to the ranks.
struct DealtOut {
    BodyStorage& bodies;
    PairTable& pairs;
    std::vector<Contact>& contacts;  ///< of the last step, sorted by (a, b)
    std::span<Joint> joints;
    std::span<Vec3> begun;           ///< [slots] positions at the beginning of the step, or empty [m, W]
    std::span<const BodyPair> tied;  ///< bodies that belong together, wherever they are
    const DetectionRange& range;     ///< of the detection that follows
    double fastest;                  ///< of the bodies here: a struck one is looked ahead for so far [m/s]
    std::int64_t step;               ///< number of the time step
    const Executor& executor;
};

/// Which bodies this rank has. All ranks know all slots, so that every order is the same on all of them; a body that
/// can move is present on one rank, its slot is a hole on the others. Fixed bodies are present on all. A world is whole
/// or divided: whole, every rank has all bodies, and as all do the same with them all stay alike.
///
/// Bodies go in groups (NearGroups): whose detection may find a contact are on the same rank before it looks. So a step
/// needs no message after that, and every batch is where all its bodies are.
class SharedBodies {
  public:
    /// @param ranks must outlive it @throws InputError for a partition that does not fit
    SharedBodies(Ranks& ranks, const Partition& partition);

    Ranks& ranks() const { return ranks_; }
    bool isWhole() const { return whole_; }
    /// The largest of DealtOut::fastest that ranks told at the last settle() [m/s].
    double fastest() const { return fastest_; }
    /// Whether a body of a divided world counts in a sum over all ranks: of fixed bodies the first rank tells, but of
    /// one that a fault fixed in this step only the rank that has it knows.
    bool isCounted(BodyIndex i) const { return kind_[i] == BodyKind::dynamic || ranks_.rank() == 0; }

    /// Whether a rank tells of a slot what all that have no such body must know: of divided worlds each slot is told by
    /// one rank, by the first where the body is on all or there is none.
    bool isTold(const BodyStorage& bodies, BodyIndex i) const {
        if (kind_[i] != BodyKind::dynamic) return ranks_.rank() == 0;
        return bodies.kind[i] != BodyKind::hole;
    }
    /// Whether a joint is where a body of it is that this rank has.
    bool hasJoint(const BodyStorage& bodies, const Joint& joint) const {
        const BodyIndex end = endOf(joint);
        return end != Joint::world && bodies.kind[end] != BodyKind::hole;
    }
    /// As isTold() of a joint.
    bool tellsJoint(const BodyStorage& bodies, const Joint& joint) const {
        return endOf(joint) == Joint::world ? ranks_.rank() == 0 : hasJoint(bodies, joint);
    }

    /// Brings the bodies to where they belong, before a detection. If the world is whole it is divided afterwards.
    /// @return whether bodies left or came
    bool settle(const DealtOut& world);
    /// Makes a divided world whole: all ranks have all bodies, with the contacts of the last step.
    void gather(const DealtOut& world);

  private:
    void divide(const DealtOut& world);
    bool moveHouse(const DealtOut& world);
    bool isDue(const DealtOut& world);
    void coverSpeed();
    Bounds reachOf(const DealtOut& world, BodyIndex i);
    void coverAll(const DealtOut& world);
    void cut(const DealtOut& world);
    void tellFrozen(BodyStorage& bodies);
    void leave(BodyStorage& bodies, BodyIndex i) const;
    void packResident(std::vector<std::byte>& message, const DealtOut& world, BodyIndex i) const;
    BodyIndex unpackResident(Unpacker& in, const DealtOut& world);
    NearGroupsInput groupsInput(const DealtOut& world) const;
    bool mayHaveLeft(const BodyStorage& bodies, BodyIndex i) const;
    void findOwners(const DealtOut& world);
    int ownerOf(const DealtOut& world, BodyIndex group) const;
    bool moveAway(const DealtOut& world, Ranks::Messages& out);
    void takeIn(const DealtOut& world, const Ranks::Messages& in);
    BodyIndex endOf(const Joint& joint) const;
    std::uint32_t holderOf(const Contact& contact) const;
    bool isRebalanced(std::int64_t step) const {
        return partition_.rebalance_every > 0 && step % partition_.rebalance_every == 0;
    }
    /// Whether all bodies go to the regions that they are in.
    bool goHome(std::int64_t step) const;
    bool isOwn(const BodyStorage& bodies, BodyIndex i) const { return bodies.kind[i] == BodyKind::dynamic; }

    Ranks& ranks_;
    Partition partition_;
    bool whole_ = true;
    std::vector<BodyKind> kind_;         ///< [slots] of all bodies, wherever they are
    std::vector<Bounds> cover_;          ///< [slots] of own bodies: where groups were found for [m, W]
    std::vector<std::uint8_t> covered_;  ///< [slots] 1 = has a cover
    bool covers_anew_ = false;           ///< covers are for another speed than before
    double fastest_ = 0;                 ///< [m/s]
    double covered_speed_ = 0;           ///< that covers are for: nobody is followed out of them [m/s]
    std::vector<std::uint32_t> owner_;   ///< [slots] of own bodies: where they go
    std::vector<BodyAhead> ahead_;       ///< [slots] kept memory
    std::vector<std::uint8_t> left_;     ///< [slots] 1 = went to another rank in this step
    std::vector<BodyIndex> came_;        ///< in this step
    std::vector<Contact> contacts_;      ///< of those, sorted by (a, b)
    std::optional<Regions> regions_;
    NearGroups groups_;
};

}  // namespace cairn
