#include "world/snapshot_parts.h"

#include <fmt/core.h>

#include "messages/sums.h"
#include "world/division.h"
#include "world/saved_fields.h"
#include "world/saved_filter.h"
#include "world/snapshot_pieces.h"

namespace cairn {

namespace {

/// What says that parts belong together, and in which order.
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
    std::vector<T> picked;
    picked.reserve(slots.size());
    for (const BodyIndex i : slots) picked.push_back(values[i]);
    out.putArray(std::span<const T>(picked));
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

void saveBodiesHere(const WorldState& world, ByteWriter& out) {
    const BodyStorage& bodies = world.bodies;
    std::vector<BodyIndex> slots;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (world.shared->isTold(bodies, i)) slots.push_back(i);
    }
    std::vector<BodyIndex> homes;
    for (const BodyIndex i : slots) homes.push_back(bodies.homeOf(i));
    out.putArray(std::span<const BodyIndex>(homes));
    pickedFields(out, bodies, slots);
}

/// Reads the bodies of all parts. @param slots of the world
void loadBodies(std::span<ByteReader> parts, std::uint64_t slots, BodyStorage& bodies) {
    std::vector<std::vector<BodyIndex>> slots_of(parts.size());
    std::uint64_t told = 0;
    for (std::size_t n = 0; n < parts.size(); ++n) {
        parts[n].getArray(slots_of[n]);
        told += slots_of[n].size();
    }
    // Compared before anything is reserved.
    if (told != slots) parts.front().refuse("another number of bodies than all parts have");
    std::vector<std::uint8_t> found(slots, 0);
    forEachBodyField([&](const auto& row) { (bodies.*row.array).resize(slots); });
    for (std::size_t n = 0; n < parts.size(); ++n) {
        for (const BodyIndex i : slots_of[n]) {
            if (i >= slots || found[i]++ != 0) parts[n].refuse("a body that another part has, or none");
        }
        pickedFields(parts[n], bodies, slots_of[n]);
    }
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
    loadContacts(in, world.data.generation.size(), world.data.contacts);
    std::vector<Sensed> sensed;
    loadSensed(in, sensed);
    world.data.sensed.insert(world.data.sensed.end(), sensed.begin(), sensed.end());
    Statistics statistics;
    statisticsFields(in, statistics);
    addRank(world.statistics, statistics);
    loadFaults(in, world.faults);
}

}  // namespace

void savePart(const WorldState& world, ByteWriter& out) {
    const Ranks& ranks = world.shared->ranks();
    const Place place{static_cast<std::uint32_t>(ranks.rank()), static_cast<std::uint32_t>(ranks.size()), world.steps};
    placeFields(out, place);
    if (place.rank == 0) {
        saveHead(world, out);
        out.put(std::uint64_t{world.bodies.wholeSlots()});
        out.put(world.bodies.nextNumber());
    }
    saveBodiesHere(world, out);
    if (place.rank == 0) {
        saveTies(world, out);
        saveEvents(world.events, out);
    }
    saveStep(world, out);
}

std::unique_ptr<WorldState> loadParts(std::span<ByteReader> parts) {
    Place first;
    for (std::size_t n = 0; n < parts.size(); ++n) {
        Place place;
        placeFields(parts[n], place);
        if (n == 0) first = place;
        if (place.rank != n || place.ranks != parts.size() || place.steps != first.steps) {
            parts[n].refuse(
                fmt::format("the part of rank {} of {} after {} time steps, where that of {} of {} after {} "
                            "is needed",
                            place.rank, place.ranks, place.steps, n, parts.size(), first.steps));
        }
    }
    ByteReader& head = parts.front();
    std::unique_ptr<WorldState> world = loadHead(head);
    const auto slots = head.get<std::uint64_t>();
    const auto next_number = head.get<std::uint64_t>();
    loadBodies(parts, slots, world->bodies);
    completeBodies(head, world->materials.all().size(), next_number, world->bodies);
    loadTies(head, *world);
    // Parts are of the end of a step.
    world->data.generation.assign(world->bodies.generation.begin(), world->bodies.generation.end());
    loadEvents(head, world->events);
    checkWorld(head, *world);
    for (ByteReader& part : parts) loadStep(part, *world);
    unite(*world);
    return world;
}

}  // namespace cairn
