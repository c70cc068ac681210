#include "sharing/shared_bodies.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <variant>

#include "messages/packing.h"
#include "sharing/body_records.h"

namespace cairn {

namespace {

/// Covers are larger than what a detection searches by this part of the body's smallest extent, so that groups last for
/// some steps. The larger, the more bodies stand in one group that do not touch.
constexpr double slack = 0.1;

/// … and by its way in the time that follows [s].
constexpr double time_ahead = 1.0 / 60;

/// Time steps after which bodies that went into the region of another rank and met nobody go there.
constexpr std::int64_t home_every = 30;

/// Slots of bodies that went elsewhere, and may come back, are dropped when they are more than one in so many.
constexpr std::size_t vacant_part = 8;

/// Stands for no rank.
constexpr std::uint32_t no_rank = UINT32_MAX;

/// What follows in a message to another rank.
enum class Item : std::uint8_t { slots, body, contact, joint };

/// What a rank asks of the others at the beginning of a step …
enum Wish : std::uint8_t { nothing = 0, groups_anew = 1, tell_frozen = 2 };

/// … and tells them.
struct Asked {
    std::uint8_t wish;
    double fastest;  ///< DealtOut::fastest [m/s]
};

/// What copies of a shape that is not sent have in common. A compound has its parts for itself.
const void* dataOf(const Shape& shape) {
    if (const auto* hull = std::get_if<ConvexHull>(&shape)) return &hull->data();
    return &shape;
}

std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
}

/// A joint that is on another rank must not break here by what it bore.
void forgetLoad(Joint& joint) {
    joint.impulse.setZero();
    joint.angular_impulse.setZero();
}

}  // namespace

SharedBodies::SharedBodies(Ranks& ranks, const Partition& partition) : ranks_(ranks), partition_(partition) {
    requirePartition(partition, ranks.size());
}

void SharedBodies::settle(const DealtOut& world) {
    if (whole_) {
        divide(world);
        return;
    }
    if (ranks_.size() == 1) {
        // Nobody is elsewhere.
        fastest_ = world.fastest;
        return;
    }
    if (!isDue(world)) return;
    coverAll(world);
    const NearGroupsInput input = groupsInput(world);
    // Where no bodies of two ranks meet, each may stay where it is.
    if (!groups_.meetOthers(input, world.executor, ranks_) && !goHome(world.step)) return;
    groups_.findAcross(input, world.executor, ranks_);
    findOwners(world);
    moveHouse(world);
}

/// Every rank keeps its part of what all have.
void SharedBodies::divide(const DealtOut& world) {
    BodyStorage& bodies = world.bodies;
    kind_.assign(bodies.kind.begin(), bodies.kind.end());
    stays_.assign(bodies.slots(), 0);
    for (const BodyIndex i : world.named) stays_[i] = 1;
    listSolids(bodies);
    cover_.resize(bodies.slots());
    covered_.assign(bodies.slots(), 0);
    owner_.resize(bodies.slots());
    ahead_.resize(bodies.slots());
    fastest_ = world.fastest;
    coverSpeed();
    coverAll(world);
    std::vector<Vec3> places;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (isOwn(bodies, i)) places.push_back(bodies.position[i]);
    }
    regions_.emplace(partition_, ranks_.size(), std::move(places));
    groups_.find(groupsInput(world), world.executor);
    findOwners(world);
    const auto own = static_cast<std::uint32_t>(ranks_.rank());
    std::erase_if(world.contacts, [&](const Contact& contact) {
        // What is left of bodies that were fixed since is for one rank to forget.
        const std::uint32_t holder = holderOf(contact);
        return holder == no_rank ? own != 0 : holder != own;
    });
    for (Joint& joint : world.joints) {
        const BodyIndex end = endOf(joint);
        if (end != Joint::world && owner_[end] != own) forgetLoad(joint);
    }
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (isOwn(bodies, i) && owner_[i] != own) leave(bodies, i);
    }
    bodies.beginPart();
    world.pairs.adopt(world.contacts);
    whole_ = false;
    // What was found of the whole world is not needed any more.
    groups_ = NearGroups();
    left_.assign(bodies.slots(), 0);
    dropVacant(world, 0);
    bodies.adoptSlots(bodies.nextNumber());
}

/// Numbers the shapes that are not sent, as all ranks do.
void SharedBodies::listSolids(const BodyStorage& bodies) {
    std::unordered_map<const void*, std::uint32_t> known;
    solids_.clear();
    solid_.assign(bodies.slots(), no_slot);
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (!isOwn(bodies, i) || isSent(bodies.shape[i])) continue;
        const auto next = static_cast<std::uint32_t>(solids_.size());
        const auto [place, is_new] = known.emplace(dataOf(bodies.shape[i]), next);
        if (is_new) solids_.push_back(bodies.shape[i]);
        solid_[i] = place->second;
    }
}

/// Brings the bodies, and all that has an entry of each, into slots with other homes.
void SharedBodies::takeHomes(const DealtOut& world, std::vector<BodyIndex> homes) {
    const SlotMove move = world.bodies.takeHomes(std::move(homes));
    // A new slot is for a body that another rank has.
    rearrange(kind_, move, BodyKind::dynamic);
    rearrange(stays_, move, 0);
    rearrange(solid_, move, no_slot);
    rearrange(cover_, move, {});
    rearrange(covered_, move, 0);
    rearrange(owner_, move, no_rank);
    rearrange(ahead_, move, {});
    rearrange(left_, move, 0);
    world.rearrange(move);
}

/// Makes slots for the bodies that have none. @param homes in any order
void SharedBodies::addHomes(const DealtOut& world, std::vector<BodyIndex> homes) {
    const BodyStorage& bodies = world.bodies;
    std::erase_if(homes, [&](BodyIndex home) { return bodies.slotOf(home) != no_slot; });
    if (homes.empty()) return;
    std::ranges::sort(homes);
    homes.erase(std::unique(homes.begin(), homes.end()), homes.end());
    std::vector<BodyIndex> all;
    all.reserve(homes.size() + bodies.slots());
    std::ranges::merge(homes, bodies.homes(), std::back_inserter(all));
    takeHomes(world, std::move(all));
}

/// Drops the slots of bodies that are elsewhere, where they are more than so many. @pre no contact or pair is of them
void SharedBodies::dropVacant(const DealtOut& world, std::size_t most) {
    const BodyStorage& bodies = world.bodies;
    std::vector<BodyIndex> homes;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (!isVacant(bodies, i)) homes.push_back(bodies.homeOf(i));
    }
    if (bodies.slots() - homes.size() > most) takeHomes(world, std::move(homes));
}

void SharedBodies::gather(const DealtOut& world) {
    if (whole_) return;
    BodyStorage& bodies = world.bodies;
    tellFrozen(world);
    std::vector<std::byte> message;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (isOwn(bodies, i)) packResident(message, world, i);
    }
    for (const Contact& contact : world.contacts) packNamed(message, bodies, contact);
    for (std::uint32_t j = 0; j < world.joints.size(); ++j) {
        const BodyIndex end = endOf(world.joints[j]);
        if (end == Joint::world || !isOwn(bodies, end)) continue;
        pack(message, Item::joint);
        pack(message, j);
        packJoint(message, world.joints[j]);
    }
    Ranks::Messages told = tellAll(ranks_, message);
    told[static_cast<std::size_t>(ranks_.rank())].clear();
    std::vector<BodyIndex> all(bodies.wholeSlots());
    std::iota(all.begin(), all.end(), 0U);
    addHomes(world, std::move(all));
    left_.assign(bodies.slots(), 0);
    takeIn(world, told);
    world.pairs.change({left_, came_, contacts_}, world.contacts);
    bodies.endPart();
    bodies.adoptSlots(bodies.nextNumber());
    whole_ = true;
}

bool SharedBodies::goHome(std::int64_t step) const {
    return partition_.restless || step % home_every == 0 || isRebalanced(step);
}

/// Whether a body of this rank may be elsewhere, or look farther, than when its cover was last compared.
bool SharedBodies::mayHaveLeft(const BodyStorage& bodies, BodyIndex i) const {
    const bool stays = covered_[i] != 0 && bodies.asleep[i] != 0 && bodies.detected_position[i] == bodies.position[i] &&
                       bodies.detected_orientation[i].coeffs() == bodies.orientation[i].coeffs();
    return !stays;
}

/// Asks all ranks whether groups must be found anew.
bool SharedBodies::isDue(const DealtOut& world) {
    const BodyStorage& bodies = world.bodies;
    std::uint8_t wish = goHome(world.step) ? groups_anew : nothing;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (kind_[i] == BodyKind::dynamic && bodies.kind[i] == BodyKind::fixed) wish |= tell_frozen;
        if ((wish & groups_anew) != 0 || !isOwn(bodies, i) || !mayHaveLeft(bodies, i)) continue;
        if (covered_[i] != 0 && cover_[i].contains(reachOf(world, i))) continue;
        wish |= groups_anew;
    }
    std::uint8_t all = nothing;
    fastest_ = 0;
    for (const auto& [wished, fastest] : gatherAll(ranks_, Asked{wish, world.fastest})) {
        all |= wished;
        fastest_ = std::max(fastest_, fastest);
    }
    if (fastest_ > covered_speed_) all |= groups_anew;
    const bool slower = (all & groups_anew) != 0 && fastest_ < covered_speed_ / 2;
    if (fastest_ > covered_speed_ || slower) coverSpeed();
    if ((all & tell_frozen) != 0) tellFrozen(world);
    if (isRebalanced(world.step)) cut(world);
    return all != nothing;
}

/// Makes covers large enough for bodies that are struck now, and some that are faster.
void SharedBodies::coverSpeed() {
    covered_speed_ = 1.25 * fastest_;
    covers_anew_ = true;
}

/// Cuts all space anew, by where bodies are now.
void SharedBodies::cut(const DealtOut& world) {
    std::vector<std::byte> message;
    for (BodyIndex i = 0; i < world.bodies.slots(); ++i) {
        if (isOwn(world.bodies, i)) pack(message, world.bodies.position[i]);
    }
    std::vector<Vec3> places;
    for (const auto& told : tellAll(ranks_, message)) {
        for (Unpacker in(told); !in.isAtEnd();) places.push_back(in.get<Vec3>());
    }
    regions_.emplace(partition_, ranks_.size(), std::move(places));
}

/// Where a detection searches a body, and where it may be followed to if it is struck.
Bounds SharedBodies::reachOf(const DealtOut& world, BodyIndex i) {
    Bounds reach = searchedBounds(world.bodies, world.range, i, ahead_[i]);
    if (world.range.foresight.time == 0) return reach;
    const Bounds struck = ahead_[i].now.grown(covered_speed_ * world.range.foresight.time);
    reach.lower = reach.lower.cwiseMin(struck.lower);
    reach.upper = reach.upper.cwiseMax(struck.upper);
    return reach;
}

/// Gives new covers to the bodies of this rank that move.
void SharedBodies::coverAll(const DealtOut& world) {
    const BodyStorage& bodies = world.bodies;
    world.executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            if (!isOwn(bodies, i) || (!covers_anew_ && !mayHaveLeft(bodies, i))) continue;
            const Bounds bounds = reachOf(world, i);
            const Vec3 way = time_ahead * bodies.v[i];
            cover_[i] = bounds.grown(slack * (bounds.upper - bounds.lower).minCoeff());
            cover_[i].lower += way.cwiseMin(0);
            cover_[i].upper += way.cwiseMax(0);
            covered_[i] = 1;
        }
    });
    covers_anew_ = false;
}

/// Lets all ranks know the bodies that were fixed by a fault: what is fixed is on all of them.
void SharedBodies::tellFrozen(const DealtOut& world) {
    BodyStorage& bodies = world.bodies;
    std::vector<std::byte> message;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (kind_[i] != BodyKind::dynamic || bodies.kind[i] != BodyKind::fixed) continue;
        pack(message, bodies.homeOf(i));
        packWhole(message, bodies, i);
    }
    bool any = false;
    for (const auto& told : tellAll(ranks_, message)) {
        for (Unpacker in(told); !in.isAtEnd();) {
            const auto home = in.get<BodyIndex>();
            addHomes(world, {home});
            const BodyIndex i = bodies.slotOf(home);
            const bool is_new = bodies.kind[i] == BodyKind::hole;
            unpackWhole(in, bodies, i);
            // Here nothing was found of it yet.
            if (is_new) bodies.detected_position[i] = nowhere();
            kind_[i] = bodies.kind[i] = BodyKind::fixed;
            bodies.updateMassProperties(i);
            any = true;
        }
    }
    if (any) bodies.adoptSlots(bodies.nextNumber());
}

NearGroupsInput SharedBodies::groupsInput(const DealtOut& world) const {
    const BodyStorage& bodies = world.bodies;
    return {bodies.kind, cover_, bodies.position, world.contacts, world.tied, bodies.homes()};
}

void SharedBodies::findOwners(const DealtOut& world) {
    for (BodyIndex i = 0; i < world.bodies.slots(); ++i) {
        if (isOwn(world.bodies, i)) owner_[i] = static_cast<std::uint32_t>(ownerOf(world, groups_.groupOf(i)));
    }
}

/// The rank that a group belongs to; all ranks that have a part of it tell the same.
int SharedBodies::ownerOf(const DealtOut& world, BodyIndex group) const {
    const auto count = static_cast<std::uint64_t>(ranks_.size());
    const auto turn = partition_.restless ? static_cast<std::uint64_t>(world.step) : 0;
    if (partition_.kind == PartitionKind::hash) {
        return static_cast<int>((mixed(std::uint64_t{groups_.nameOf(group)} + 1) + turn) % count);
    }
    return static_cast<int>((static_cast<std::uint64_t>(regions_->ownerOf(groups_.middleOf(group))) + turn) % count);
}

/// The rank that has or gets a contact of own bodies: that of its bodies that can move.
std::uint32_t SharedBodies::holderOf(const Contact& contact) const {
    if (kind_[contact.a] == BodyKind::dynamic) return owner_[contact.a];
    return kind_[contact.b] == BodyKind::dynamic ? owner_[contact.b] : no_rank;
}

/// A body that a joint goes along with: one of its ends that can move; Joint::world if none can.
BodyIndex SharedBodies::endOf(const Joint& joint) const {
    if (isMovable(kind_, joint.a)) return joint.a;
    return isMovable(kind_, joint.b) ? joint.b : Joint::world;
}

/// Takes the bodies that belong elsewhere out of this world. @param out gets them @return whether there are any
bool SharedBodies::moveAway(const DealtOut& world, Ranks::Messages& out) {
    BodyStorage& bodies = world.bodies;
    const auto own = static_cast<std::uint32_t>(ranks_.rank());
    bool any = false;
    left_.assign(bodies.slots(), 0);
    std::vector<std::vector<BodyIndex>> leaving(out.size());
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (isOwn(bodies, i) && owner_[i] != own) leaving[owner_[i]].push_back(bodies.homeOf(i));
    }
    // Who gets bodies first makes room for all of them.
    for (std::size_t to = 0; to < out.size(); ++to) {
        if (leaving[to].empty()) continue;
        pack(out[to], Item::slots);
        pack(out[to], std::uint64_t{leaving[to].size()});
        for (const BodyIndex home : leaving[to]) pack(out[to], home);
    }
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (!isOwn(bodies, i) || owner_[i] == own) continue;
        packResident(out[owner_[i]], world, i);
        leave(bodies, i);
        left_[i] = 1;
        any = true;
    }
    if (!any) return false;
    for (const Contact& contact : world.contacts) {
        const std::uint32_t holder = holderOf(contact);
        if (holder != no_rank && holder != own) packNamed(out[holder], bodies, contact);
    }
    for (std::uint32_t j = 0; j < world.joints.size(); ++j) {
        Joint& joint = world.joints[j];
        const auto sendWith = [&](BodyIndex end) {
            pack(out[owner_[end]], Item::joint);
            pack(out[owner_[end]], j);
            packJoint(out[owner_[end]], joint);
        };
        const bool with_a = isMovable(kind_, joint.a) && left_[joint.a] != 0;
        const bool with_b = isMovable(kind_, joint.b) && left_[joint.b] != 0;
        if (!with_a && !with_b) continue;
        if (with_a) sendWith(joint.a);
        // The ends of a joint that broke need not go together; both must know.
        if (with_b && !(with_a && owner_[joint.a] == owner_[joint.b])) sendWith(joint.b);
        forgetLoad(joint);
    }
    return true;
}

/// Makes slots for what others sent.
void SharedBodies::makeRoom(const DealtOut& world, const Ranks::Messages& in) {
    std::vector<BodyIndex> homes;
    for (const auto& message : in) {
        Unpacker reader(message);
        if (reader.isAtEnd() || reader.get<Item>() != Item::slots) continue;
        for (auto left = reader.get<std::uint64_t>(); left > 0; --left) homes.push_back(reader.get<BodyIndex>());
    }
    addHomes(world, std::move(homes));
}

/// Takes in what others sent. @pre there are slots for it
void SharedBodies::takeIn(const DealtOut& world, const Ranks::Messages& in) {
    const BodyStorage& bodies = world.bodies;
    came_.clear();
    contacts_.clear();
    for (const auto& message : in) {
        for (Unpacker reader(message); !reader.isAtEnd();) {
            switch (reader.get<Item>()) {
                case Item::slots:
                    for (auto left = reader.get<std::uint64_t>(); left > 0; --left) reader.get<BodyIndex>();
                    break;
                case Item::body:
                    came_.push_back(unpackResident(reader, world));
                    break;
                case Item::contact:
                    contacts_.push_back(unpackContact(reader));
                    contacts_.back().a = bodies.slotOf(contacts_.back().a);
                    contacts_.back().b = bodies.slotOf(contacts_.back().b);
                    break;
                case Item::joint: {
                    const auto j = reader.get<std::uint32_t>();
                    unpackJoint(reader, world.joints[j]);
                    break;
                }
            }
        }
    }
    // Those of a pair all come from one rank, in their order.
    std::ranges::stable_sort(contacts_, {}, [](const Contact& contact) { return BodyPair{contact.a, contact.b}; });
}

void SharedBodies::moveHouse(const DealtOut& world) {
    Ranks::Messages out(static_cast<std::size_t>(ranks_.size()));
    const bool left = moveAway(world, out);
    const Ranks::Messages in = ranks_.exchange(std::move(out));
    makeRoom(world, in);
    takeIn(world, in);
    if (!left && came_.empty()) return;
    world.pairs.change({left_, came_, contacts_}, world.contacts);
    dropVacant(world, world.bodies.slots() / vacant_part);
    world.bodies.adoptSlots(world.bodies.nextNumber());
}

/// Appends a body with its shape.
void SharedBodies::packWhole(std::vector<std::byte>& message, const BodyStorage& bodies, BodyIndex i) const {
    pack(message, solid_[i]);
    packBody(message, bodies, i);
}

void SharedBodies::unpackWhole(Unpacker& in, BodyStorage& bodies, BodyIndex i) {
    solid_[i] = in.get<std::uint32_t>();
    if (solid_[i] != no_slot) bodies.shape[i] = solids_[solid_[i]];
    unpackBody(in, bodies, i);
}

/// Appends a contact that names its bodies by their homes.
void SharedBodies::packNamed(std::vector<std::byte>& message, const BodyStorage& bodies, Contact contact) {
    contact.a = bodies.homeOf(contact.a);
    contact.b = bodies.homeOf(contact.b);
    pack(message, Item::contact);
    packContact(message, contact);
}

/// Appends a body with what this room and the step remember of it.
void SharedBodies::packResident(std::vector<std::byte>& message, const DealtOut& world, BodyIndex i) const {
    pack(message, Item::body);
    pack(message, world.bodies.homeOf(i));
    packWhole(message, world.bodies, i);
    pack(message, cover_[i].lower);
    pack(message, cover_[i].upper);
    if (world.begun != nullptr) pack(message, (*world.begun)[i]);
}

BodyIndex SharedBodies::unpackResident(Unpacker& in, const DealtOut& world) {
    const BodyIndex i = world.bodies.slotOf(in.get<BodyIndex>());
    unpackWhole(in, world.bodies, i);
    cover_[i].lower = in.get<Vec3>();
    cover_[i].upper = in.get<Vec3>();
    covered_[i] = 1;
    owner_[i] = static_cast<std::uint32_t>(ranks_.rank());
    if (world.begun != nullptr) (*world.begun)[i] = in.get<Vec3>();
    return i;
}

/// Leaves a slot to the rank that has its body.
void SharedBodies::leave(BodyStorage& bodies, BodyIndex i) const {
    bodies.kind[i] = BodyKind::hole;
    bodies.asleep[i] = 0;
    bodies.woken[i] = WakeReason::none;
}

}  // namespace cairn
