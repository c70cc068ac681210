/// The part of SharedBodies that brings bodies from rank to rank, and into slots.
#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "messages/packing.h"
#include "sharing/body_records.h"
#include "sharing/shared_bodies.h"

namespace cairn {

namespace {

/// Slots of bodies that went elsewhere, and may come back, are dropped when they are more than one in so many.
constexpr std::size_t vacant_part = 16;

/// What follows in a message to another rank.
enum class Item : std::uint8_t { slots, body, cover, contact, joint };

}  // namespace

/// Brings the bodies, and all that has an entry of each, into slots with other homes.
void SharedBodies::takeHomes(const DealtOut& world, std::vector<BodyIndex> homes) {
    // While arrays of all bodies are copied, what these take is most, and they are found anew next time anyway.
    forgetGroups();
    const SlotMove move = world.bodies.takeHomes(std::move(homes));
    // A new slot is for a body that another rank has.
    rearrange(kind_, move, BodyKind::dynamic);
    rearrange(stays_, move, 0);
    rearrange(solid_, move, no_slot);
    rearrange(owner_, move, no_rank);
    rearrange(is_near_, move, 0);
    for (BodyIndex& slot : near_slots_) slot = move(slot);
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
    if (is_dealing_) endDealing(world);
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
    is_taken_over_ = false;
}

/// Takes the bodies that belong elsewhere out of this world. @param out gets them @return whether there are any
bool SharedBodies::moveAway(const DealtOut& world, Ranks::Messages& out) {
    BodyStorage& bodies = world.bodies;
    const auto own = static_cast<std::uint32_t>(ranks_.rank());
    bool any = false;
    left_.assign(bodies.slots(), 0);
    std::vector<std::vector<BodyIndex>> leaving(out.size());
    for (const BodyIndex i : around_.slots) {
        if (owner_[i] != own) leaving[owner_[i]].push_back(bodies.homeOf(i));
    }
    // Who gets bodies first makes room for all of them.
    for (std::size_t to = 0; to < out.size(); ++to) {
        if (leaving[to].empty()) continue;
        pack(out[to], Item::slots);
        pack(out[to], std::uint64_t{leaving[to].size()});
        for (const BodyIndex home : leaving[to]) pack(out[to], home);
    }
    for (std::size_t n = 0; n < around_.slots.size(); ++n) {
        const BodyIndex i = around_.slots[n];
        if (owner_[i] == own) continue;
        packResident(out[owner_[i]], world, i);
        pack(out[owner_[i]], Item::cover);
        packBounds(out[owner_[i]], around_.bodies[n].cover);
        leave(bodies, i);
        left_[i] = 1;
        any = true;
    }
    if (!any) return false;
    forgetNear();
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

/// Drops the covers of bodies that went.
void SharedBodies::forgetNear() {
    std::size_t kept = 0;
    for (std::size_t n = 0; n < near_.size(); ++n) {
        const BodyIndex i = near_slots_[n];
        is_near_[i] = left_[i] == 0 ? 1 : 0;
        if (left_[i] != 0) continue;
        near_[kept] = near_[n];
        near_slots_[kept++] = i;
    }
    near_.resize(kept);
    near_slots_.resize(kept);
}

/// Makes slots for what others sent, and for the other bodies nearby: they are likely to be the next.
void SharedBodies::makeRoom(const DealtOut& world, const Ranks::Messages& in) {
    std::vector<BodyIndex> homes;
    for (const auto& message : in) {
        Unpacker reader(message);
        if (reader.isAtEnd() || reader.get<Item>() != Item::slots) continue;
        for (auto left = reader.get<std::uint64_t>(); left > 0; --left) homes.push_back(reader.get<BodyIndex>());
    }
    const BodyStorage& bodies = world.bodies;
    const auto has = [&](BodyIndex home) { return bodies.slotOf(home) != no_slot; };
    const bool is_room = std::ranges::all_of(homes, has);
    if (is_room) return;
    if (others_.size() <= bodies.slots() / (2 * vacant_part)) {
        for (const CoveredBody& other : others_) homes.push_back(other.home);
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
                case Item::cover:
                    near_.push_back({bodies.homeOf(came_.back()), unpackBounds(reader)});
                    near_slots_.push_back(came_.back());
                    is_near_[came_.back()] = 1;
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
    if (!left && std::ranges::all_of(in, &std::vector<std::byte>::empty)) return;
    makeRoom(world, in);
    takeIn(world, in);
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
    if (world.begun != nullptr) forMembers((*world.begun)[i], [&](const auto& member) { pack(message, member); });
}

BodyIndex SharedBodies::unpackResident(Unpacker& in, const DealtOut& world) {
    const BodyIndex i = world.bodies.slotOf(in.get<BodyIndex>());
    unpackWhole(in, world.bodies, i);
    owner_[i] = static_cast<std::uint32_t>(ranks_.rank());
    if (world.begun != nullptr) {
        forMembers((*world.begun)[i], [&](auto& member) { member = in.get<std::remove_cvref_t<decltype(member)>>(); });
    }
    return i;
}

/// Leaves a slot to the rank that has its body.
void SharedBodies::leave(BodyStorage& bodies, BodyIndex i) const {
    bodies.kind[i] = BodyKind::hole;
    bodies.asleep[i] = 0;
    bodies.woken[i] = WakeReason::none;
}

}  // namespace cairn
