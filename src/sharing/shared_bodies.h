/// @file The bodies of a world that several ranks share: each that can move is on one of them, together with all that
/// it may touch, so that every rank steps its bodies as if there were no others.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "body/body_storage.h"
#include "body/body_way.h"
#include "body/contact.h"
#include "cairn/ranks.h"
#include "joints/joint.h"
#include "messages/packing.h"
#include "pairs/pair_table.h"
#include "regions/regions.h"
#include "sharing/near_groups.h"
#include "sharing/realms.h"

namespace cairn {

/// What of a world is dealt out to the ranks.
struct DealtOut {
    BodyStorage& bodies;
    PairTable& pairs;
    std::vector<Contact>& contacts;  ///< of the last step, sorted by (a, b)
    std::span<Joint> joints;
    std::span<const BodyIndex> named;  ///< bodies that keep a slot on all ranks, since lasting things name them
    std::vector<BodyWay>* begun;       ///< [slots] ways since the last detection, or null
    std::vector<BodyPair>& tied;       ///< bodies that belong together, wherever they are
    BroadPhase& search;                ///< of the detection that follows
    const DetectionRange& range;       ///< likewise
    double fastest;                    ///< of the bodies here: a struck one is looked ahead for so far [m/s]
    double speed;                      ///< no point of a body here is faster [m/s]
    std::int64_t step;                 ///< number of the time step
    const Executor& executor;
    /// Called after the bodies were brought into other slots, for all else that names slots or has an entry of each.
    std::function<void(const SlotMove&)> rearrange;
};

/// Which bodies this rank has. A body that can move is on one rank, fixed bodies are on all. A rank has slots for the
/// bodies that it has, for those that joints and the like name, and for some that it had before: these are holes. Slots
/// ascend with those that the bodies have in the whole world (BodyStorage::homeOf()), so that every order is the same
/// on all ranks. A world is whole or divided: whole, every rank has all bodies, and as all do the same with them all
/// stay alike.
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

    /// Whether a body is on all ranks, as what cannot move is, or a slot is a hole on all of them.
    bool isOnAll(BodyIndex i) const { return kind_[i] != BodyKind::dynamic; }
    /// Whether bodies that can move are of shapes that are sent, so that a rank need not know those it does not have.
    bool sendsAllShapes() const { return solids_.empty(); }
    /// Takes over a part of a world that was divided before. At the next settle() space is cut anew.
    /// @param moved lists of homes of its bodies that can move, or could until a fault @pre their shapes are sent
    void takeOver(const BodyStorage& bodies, std::span<const std::vector<BodyIndex>> moved);

    /// Divides a world that has no bodies yet: those that are added until the next settle() are dealt out.
    /// @param places where they will be [m, W], the same on all ranks
    void deal(BodyStorage& bodies, std::vector<Vec3> places);
    /// Whether bodies are being dealt out.
    bool isDealing() const { return is_dealing_; }
    /// Leaves a body that was just added on all ranks to one of them, if it can move. @param place of it [m, W]
    void dealOut(BodyStorage& bodies, BodyIndex i, const Vec3& place);

    /// Brings the bodies to where they belong, before a detection. If the world is whole it is divided afterwards.
    /// The layout of the bodies changes if any left or came.
    void settle(const DealtOut& world);
    /// Makes a divided world whole: all ranks have all bodies, with the contacts of the last step.
    void gather(const DealtOut& world);

  private:
    /// Stands for no rank.
    static constexpr std::uint32_t no_rank = UINT32_MAX;

    void endDealing(const DealtOut& world);
    void divide(const DealtOut& world);
    void moveHouse(const DealtOut& world);
    bool isDue(const DealtOut& world);
    void coverSpeed();
    void cut(const BodyStorage& bodies);
    void beginAnew(std::size_t slots);
    void tellFrozen(const DealtOut& world);
    void leave(BodyStorage& bodies, BodyIndex i) const;
    void listSolids(const BodyStorage& bodies);
    void takeHomes(const DealtOut& world, std::vector<BodyIndex> homes);
    void addHomes(const DealtOut& world, std::vector<BodyIndex> homes);
    void dropVacant(const DealtOut& world, std::size_t most);
    bool isVacant(const BodyStorage& bodies, BodyIndex i) const {
        return bodies.kind[i] == BodyKind::hole && kind_[i] == BodyKind::dynamic && stays_[i] == 0;
    }
    void packWhole(std::vector<std::byte>& message, const BodyStorage& bodies, BodyIndex i) const;
    void unpackWhole(Unpacker& in, BodyStorage& bodies, BodyIndex i);
    void packResident(std::vector<std::byte>& message, const DealtOut& world, BodyIndex i) const;
    BodyIndex unpackResident(Unpacker& in, const DealtOut& world);
    static void packNamed(std::vector<std::byte>& message, const BodyStorage& bodies, Contact contact);
    double wayOf(const DealtOut& world) const;
    Bounds reachOf(const DealtOut& world, BodyIndex i) const;
    Bounds coverOf(const DealtOut& world, BodyIndex i) const;
    double largestCover(const DealtOut& world) const;
    Bounds roughCoverOf(const DealtOut& world, BodyIndex i, double way) const;
    bool hasLeft(const DealtOut& world) const;
    bool isCovered(const DealtOut& world, BodyIndex i, double way, const Bounds* cover) const;
    void compare(const DealtOut& world);
    Reach reachOfAll(const DealtOut& world);
    void tellNear(const DealtOut& world);
    bool findMoving(const DealtOut& world);
    void findGroupsOf(const DealtOut& world, std::span<const BodyIndex> some);
    void findGroups(const DealtOut& world, const Bounds& zone);
    std::optional<Bounds> isCutBy(const DealtOut& world, const Bounds& zone) const;
    template <class Visit>
    void forJoined(const DealtOut& world, const Visit& visit) const;
    void findOwners(const DealtOut& world);
    void forgetGroups();
    void forgetNear();
    int ownerOf(BodyIndex name, const Vec3& place, std::int64_t step) const;
    bool moveAway(const DealtOut& world, Ranks::Messages& out);
    void makeRoom(const DealtOut& world, const Ranks::Messages& in);
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
    bool is_dealing_ = false;
    bool is_taken_over_ = false;        ///< and no space is cut yet
    std::vector<BodyKind> kind_;        ///< [slots] of all bodies, wherever they are
    std::vector<std::uint8_t> stays_;   ///< [slots] 1 = is named, and so has a slot on all ranks
    std::vector<std::uint32_t> solid_;  ///< [slots] index of the shape in solids_; no_slot = it is sent with the body
    std::vector<Shape> solids_;         ///< shapes of bodies that can move that are not sent, the same on all ranks
    double fastest_ = 0;                ///< [m/s]
    double covered_speed_ = 0;          ///< that covers are for: nobody is followed out of them [m/s]
    std::vector<std::uint32_t> owner_;  ///< [slots] of own bodies: where they go
    std::vector<std::uint8_t> left_;    ///< [slots] 1 = went to another rank in this step
    std::vector<BodyIndex> came_;       ///< in this step
    std::vector<Contact> contacts_;     ///< of those, sorted by (a, b)
    std::optional<Regions> regions_;

    // Until the next comparison each body is within the realm of its rank and no other, or within its cover.
    bool is_compared_ = false;
    Realms realms_;
    double largest_r_max_ = 0;           ///< of the bodies here, at the last comparison [m]
    double largest_r_min_ = 0;           ///< likewise
    double largest_v_ = 0;               ///< likewise, of their centres [m/s]
    std::vector<CoveredBody> near_;      ///< own bodies that other ranks know, or that came since
    std::vector<BodyIndex> near_slots_;  ///< theirs
    std::vector<std::uint8_t> is_near_;  ///< [slots] 1 = is one of them
    std::vector<CoveredBody> others_;    ///< bodies of other ranks that this one knows

    /// Own bodies that groups were searched among.
    struct Around {
        std::vector<CoveredBody> bodies;
        std::vector<BodyIndex> slots;     ///< theirs
        std::vector<std::uint8_t> moves;  ///< 1 = its group may go elsewhere
        std::vector<BodyIndex> index;     ///< [slots] among them; no_slot = it is not
    };
    Around around_;
    NearGroups groups_;
};

}  // namespace cairn
