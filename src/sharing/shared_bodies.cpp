#include "sharing/shared_bodies.h"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <variant>

#include "messages/packing.h"
#include "sharing/body_records.h"

namespace cairn {

namespace {

/// Time steps after which bodies that went into the region of another rank and met nobody go there.
constexpr std::int64_t home_every = 30;

/// Where so many bodies are tells where all are, when space is cut.
constexpr std::size_t enough_places = std::size_t{1} << 17U;

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

}  // namespace

SharedBodies::SharedBodies(Ranks& ranks, const Partition& partition) : ranks_(ranks), partition_(partition) {
    requirePartition(partition, ranks.size());
}

void SharedBodies::deal(BodyStorage& bodies, std::vector<Vec3> places) {
    regions_.emplace(partition_, ranks_.size(), std::move(places));
    bodies.beginPart();
    whole_ = false;
    is_dealing_ = true;
}

void SharedBodies::dealOut(BodyStorage& bodies, BodyIndex i, const Vec3& place) {
    const BodyKind kind = bodies.kind[i];
    const bool is_own = kind != BodyKind::dynamic || ownerOf(bodies.homeOf(i), place, 0) == ranks_.rank();
    if (!is_own) bodies.passOver(i);
    kind_.resize(bodies.slots(), BodyKind::hole);
    if (i < kind_.size()) kind_[i] = kind;
}

/// From now on the bodies are those of any divided world.
void SharedBodies::endDealing(const DealtOut& world) {
    is_dealing_ = false;
    beginAnew(world.bodies.slots());
}

void SharedBodies::takeOver(const BodyStorage& bodies, std::span<const std::vector<BodyIndex>> moved) {
    whole_ = false;
    is_taken_over_ = true;
    kind_.assign(bodies.kind.begin(), bodies.kind.end());
    for (const std::vector<BodyIndex>& homes : moved) {
        for (const BodyIndex home : homes) kind_[bodies.slotOf(home)] = BodyKind::dynamic;
    }
    beginAnew(bodies.slots());
}

/// Knows nothing of the bodies but which there are.
void SharedBodies::beginAnew(std::size_t slots) {
    // What joints and the like name was fixed, and is on all ranks.
    stays_.assign(slots, 0);
    solid_.assign(slots, no_slot);
    is_compared_ = false;
    owner_.assign(slots, static_cast<std::uint32_t>(ranks_.rank()));
    left_.assign(slots, 0);
}

void SharedBodies::settle(const DealtOut& world) {
    if (is_dealing_) endDealing(world);
    if (whole_) {
        divide(world);
        return;
    }
    if (ranks_.size() == 1) {
        // Nobody is elsewhere.
        fastest_ = world.fastest;
        return;
    }
    if (is_taken_over_) cut(world.bodies);
    if (!isDue(world)) return;
    compare(world);
    if (findMoving(world)) moveHouse(world);
    is_taken_over_ = false;
}

/// Every rank keeps its part of what all have.
void SharedBodies::divide(const DealtOut& world) {
    BodyStorage& bodies = world.bodies;
    kind_.assign(bodies.kind.begin(), bodies.kind.end());
    stays_.assign(bodies.slots(), 0);
    for (const BodyIndex i : world.named) stays_[i] = 1;
    listSolids(bodies);
    const auto own = static_cast<std::uint32_t>(ranks_.rank());
    owner_.assign(bodies.slots(), own);
    is_compared_ = false;
    fastest_ = world.fastest;
    coverSpeed();
    std::vector<Vec3> places;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (isOwn(bodies, i)) places.push_back(bodies.position[i]);
    }
    regions_.emplace(partition_, ranks_.size(), std::move(places));
    findGroups(world, Bounds());
    around_.moves.assign(around_.bodies.size(), 1);
    findOwners(world);
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
    forgetGroups();
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

bool SharedBodies::goHome(std::int64_t step) const {
    return partition_.restless || step % home_every == 0 || isRebalanced(step) || is_taken_over_;
}

/// Asks all ranks whether groups must be found anew.
bool SharedBodies::isDue(const DealtOut& world) {
    const BodyStorage& bodies = world.bodies;
    std::uint8_t wish = goHome(world.step) || !is_compared_ || hasLeft(world) ? groups_anew : nothing;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (kind_[i] == BodyKind::dynamic && bodies.kind[i] == BodyKind::fixed) wish |= tell_frozen;
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
    if (isRebalanced(world.step)) cut(world.bodies);
    return all != nothing;
}

/// Makes covers large enough for bodies that are struck now, and some that are faster.
void SharedBodies::coverSpeed() {
    covered_speed_ = 1.25 * fastest_;
}

/// Cuts all space anew, by where bodies are now; of many by where some of them are.
void SharedBodies::cut(const BodyStorage& bodies) {
    const std::size_t apart = 1 + bodies.wholeSlots() / enough_places;
    std::size_t own = 0;
    std::vector<std::byte> message;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (isOwn(bodies, i) && own++ % apart == 0) pack(message, bodies.position[i]);
    }
    std::vector<Vec3> places;
    for (const auto& told : tellAll(ranks_, message)) {
        for (Unpacker in(told); !in.isAtEnd();) places.push_back(in.get<Vec3>());
    }
    regions_.emplace(partition_, ranks_.size(), std::move(places));
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

/// The rank that a group belongs to; all ranks that have a part of it tell the same.
/// @param name of the group @param place of its middle [m, W]
int SharedBodies::ownerOf(BodyIndex name, const Vec3& place, std::int64_t step) const {
    const auto count = static_cast<std::uint64_t>(ranks_.size());
    const auto turn = partition_.restless ? static_cast<std::uint64_t>(step) : 0;
    if (partition_.kind == PartitionKind::hash) {
        return static_cast<int>((mixed(std::uint64_t{name} + 1) + turn) % count);
    }
    return static_cast<int>((static_cast<std::uint64_t>(regions_->ownerOf(place)) + turn) % count);
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

}  // namespace cairn
