#include "world/snapshot_parts.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "messages/sums.h"
#include "world/division.h"
#include "world/saved_fields.h"
#include "world/saved_filter.h"
#include "world/snapshot_pieces.h"

namespace cairn {

namespace {

/// Which part it is, of which moment.
struct Place {
    std::uint32_t rank = 0;
    std::uint32_t ranks = 0;
    std::int64_t steps = 0;
};

template <class Stream, class AnyPlace>
void placeFields(Stream& stream, AnyPlace& place) {
    field(stream, place.rank);
    field(stream, place.ranks);
    field(stream, place.steps);
}

// What some bodies have of a field.
template <PlainBytes T>
void pickedSlots(ByteWriter& out, const FieldArray<T>& values, std::span<const BodyIndex> slots) {
    out.put(std::uint64_t{slots.size()});
    for (const BodyIndex i : slots) out.put(values[i]);
}
template <PlainBytes T>
void pickedSlots(ByteReader& in, FieldArray<T>& values, std::span<const BodyIndex> slots) {
    std::vector<T> picked;
    in.getArray(picked, slots.size());
    for (std::size_t n = 0; n < slots.size(); ++n) values[slots[n]] = picked[n];
}
void pickedSlots(ByteWriter& out, const FieldArray<Shape>& shapes, std::span<const BodyIndex> slots) {
    for (const BodyIndex i : slots) saveShape(shapes[i], out);
}
void pickedSlots(ByteReader& in, FieldArray<Shape>& shapes, std::span<const BodyIndex> slots) {
    for (const BodyIndex i : slots) shapes[i] = loadShape(in);
}
void pickedSlots(ByteWriter& out, const FieldArray<std::string>& names, std::span<const BodyIndex> slots) {
    for (const BodyIndex i : slots) out.putText(names[i]);
}
void pickedSlots(ByteReader& in, FieldArray<std::string>& names, std::span<const BodyIndex> slots) {
    for (const BodyIndex i : slots) names[i] = in.getText();
}

template <class Stream, class Bodies>
void pickedFields(Stream& stream, Bodies& bodies, std::span<const BodyIndex> slots) {
    forEachBodyField([&](const auto& row) {
        if (row.isSaved()) pickedSlots(stream, bodies.*row.array, slots);
    });
}

/// What steps change of a joint.
template <class Stream, class AnyJoint>
void changingFields(Stream& stream, AnyJoint& joint) {
    field(stream, joint.present);
    field(stream, joint.generation);
    field(stream, joint.redundant);
    field(stream, joint.impulse);
    field(stream, joint.angular_impulse);
    for (auto& axis : joint.free) field(stream, axis.position);
}

/// The joints that go along with a body of this rank.
std::vector<std::uint32_t> jointsHere(const WorldState& world) {
    std::vector<std::uint32_t> joints;
    for (std::uint32_t j = 0; j < world.joints.size(); ++j) {
        if (world.shared->hasJoint(world.bodies, world.joints[j])) joints.push_back(j);
    }
    return joints;
}

/// @param is_meant which slots
template <class Predicate>
void saveBodies(const BodyStorage& bodies, ByteWriter& out, const Predicate& is_meant) {
    std::vector<BodyIndex> slots;
    std::vector<BodyIndex> homes;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (!is_meant(i)) continue;
        slots.push_back(i);
        homes.push_back(bodies.homeOf(i));
    }
    out.putArray(std::span<const BodyIndex>(homes));
    pickedFields(out, bodies, slots);
}

using Homes = std::vector<BodyIndex>;

/// The homes of bodies, of which there is one each. @param slots of the whole world
Homes loadHomes(ByteReader& in, std::uint64_t slots) {
    Homes homes;
    in.getArray(homes);
    const bool sound = std::ranges::adjacent_find(homes, std::ranges::greater_equal()) == homes.end() &&
                       (homes.empty() || homes.back() < slots);
    if (!sound) in.refuse("bodies out of order, or more than there are");
    return homes;
}

/// Makes slots for the bodies of all lists. @param slots of the whole world @param is_whole they are to be all
void makeSlots(const ByteReader& in, std::span<const Homes> lists, std::uint64_t slots, bool is_whole,
               BodyStorage& bodies) {
    Homes all;
    for (const Homes& homes : lists) all.insert(all.end(), homes.begin(), homes.end());
    std::ranges::sort(all);
    if (std::ranges::adjacent_find(all) != all.end()) in.refuse("a body that two parts have");
    if (is_whole && all.size() != slots) in.refuse("another number of bodies than all parts have");
    bodies.becomePart(std::move(all), slots);
    if (is_whole) bodies.endPart();
}

void loadBodies(ByteReader& in, const Homes& homes, BodyStorage& bodies) {
    std::vector<BodyIndex> slots;
    slots.reserve(homes.size());
    for (const BodyIndex home : homes) slots.push_back(bodies.slotOf(home));
    pickedFields(in, bodies, slots);
}

void saveStep(const WorldState& world, ByteWriter& out) {
    const std::vector<std::uint32_t> joints = jointsHere(world);
    out.putArray(std::span<const std::uint32_t>(joints));
    for (const std::uint32_t j : joints) changingFields(out, world.joints[j]);
    saveContacts(world.bodies, world.data.contacts, out);
    saveSensed(world.data.sensed, out);
    statisticsFields(out, world.statistics);
    saveFaults(world.faults, out);
}

void loadStep(ByteReader& in, WorldState& world) {
    std::vector<std::uint32_t> joints;
    in.getArray(joints);
    for (const std::uint32_t j : joints) {
        if (j >= world.joints.size()) in.refuse("a joint that the world has not");
        const std::uint32_t generation = world.joints[j].generation;
        changingFields(in, world.joints[j]);
        const bool broke = !world.joints[j].present && world.joints[j].generation == generation + 1;
        if (world.joints[j].generation != generation && !broke) in.refuse("a joint of another time");
    }
    std::vector<Contact> contacts;
    loadContacts(in, world.bodies.wholeSlots(), contacts);
    for (Contact& contact : contacts) {
        contact.a = world.bodies.slotOf(contact.a);
        contact.b = world.bodies.slotOf(contact.b);
        if (contact.a == no_slot || contact.b == no_slot) in.refuse("a contact of a body that the part has not");
        world.data.contacts.push_back(contact);
    }
    std::vector<Sensed> sensed;
    loadSensed(in, sensed);
    world.data.sensed.insert(world.data.sensed.end(), sensed.begin(), sensed.end());
    Statistics statistics;
    statisticsFields(in, statistics);
    addRank(world.statistics, statistics);
    loadFaults(in, world.faults);
}

/// Refuses parts that are not of the moment, or not those that are asked for.
void requirePlaces(const DividedWorld& divided, std::span<ByteReader> parts, bool is_whole) {
    std::uint32_t next = 0;
    for (ByteReader& part : parts) {
        Place place;
        placeFields(part, place);
        const bool follows = is_whole ? place.rank == next : place.rank >= next;
        if (!follows || place.ranks != divided.ranks || place.steps != divided.steps) {
            part.refuse(
                fmt::format("the part of rank {} of {} after {} time steps, where that of {} of {} after {} time steps "
                            "is needed",
                            place.rank, place.ranks, place.steps, next, divided.ranks, divided.steps));
        }
        next = place.rank + 1;
    }
    if (is_whole && next != divided.ranks) parts.back().refuse("the last of too few parts");
}

}  // namespace

void savePart(const WorldState& world, ByteWriter& out) {
    const SharedBodies& shared = *world.shared;
    const Place place{static_cast<std::uint32_t>(shared.ranks().rank()),
                      static_cast<std::uint32_t>(shared.ranks().size()), world.steps};
    placeFields(out, place);
    saveBodies(world.bodies, out,
               [&](BodyIndex i) { return !shared.isOnAll(i) && world.bodies.kind[i] != BodyKind::hole; });
    saveStep(world, out);
}

void saveCommon(const WorldState& world, ByteWriter& out) {
    const SharedBodies& shared = *world.shared;
    const bool is_tied = !world.springs.empty() || !world.joints.empty() || !world.bodies.filter.exceptions().empty();
    out.put(static_cast<std::uint32_t>(shared.ranks().size()));
    out.put(world.steps);
    out.put(static_cast<std::uint8_t>(!is_tied && shared.sendsAllShapes()));
    saveHead(world, out);
    out.put(std::uint64_t{world.bodies.wholeSlots()});
    out.put(world.bodies.nextNumber());
    out.putArray(std::span<const double>(world.dealt_extents));
    saveBodies(world.bodies, out, [&](BodyIndex i) { return shared.isOnAll(i); });
    saveTies(world, out);
    saveEvents(world.events, out);
}

DividedWorld loadDivided(ByteReader& common) {
    DividedWorld divided;
    divided.ranks = common.get<std::uint32_t>();
    divided.steps = common.get<std::int64_t>();
    divided.can_stay_divided = common.get<std::uint8_t>() != 0;
    return divided;
}

std::unique_ptr<WorldState> loadParts(ByteReader& common, const DividedWorld& divided, std::span<ByteReader> parts,
                                      std::unique_ptr<SharedBodies> shared) {
    const bool is_whole = shared == nullptr;
    requirePlaces(divided, parts, is_whole);
    std::unique_ptr<WorldState> world = loadHead(common);
    const auto slots = common.get<std::uint64_t>();
    const auto next_number = common.get<std::uint64_t>();
    common.getArray(world->dealt_extents);
    if (is_whole) world->dealt_extents = {};
    std::vector<Homes> homes;
    for (ByteReader& part : parts) homes.push_back(loadHomes(part, slots));
    homes.push_back(loadHomes(common, slots));
    makeSlots(common, homes, slots, is_whole, world->bodies);
    for (std::size_t n = 0; n < parts.size(); ++n) loadBodies(parts[n], homes[n], world->bodies);
    loadBodies(common, homes.back(), world->bodies);
    completeBodies(common, world->materials.all().size(), next_number, world->bodies);
    loadTies(common, *world);
    // Parts are of the end of a step.
    world->data.generation.assign(world->bodies.generation.begin(), world->bodies.generation.end());
    loadEvents(common, world->events);
    checkWorld(common, *world);
    for (ByteReader& part : parts) loadStep(part, *world);
    unite(*world);
    if (is_whole) return world;
    homes.pop_back();
    shared->takeOver(world->bodies, homes);
    world->shared = std::move(shared);
    return world;
}

}  // namespace cairn
