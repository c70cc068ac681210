#include "world/events.h"

#include <tuple>

namespace cairn {

namespace {

/// The contacts of one pair, which stand side by side, as one event.
Event pairEvent(const WorldState& world, std::span<const Contact> contacts) {
    const Contact* deepest = contacts.data();
    Vec3 impulse = Vec3::Zero();
    for (const Contact& contact : contacts) {
        impulse += contact.impulse;
        if (contact.distance < deepest->distance) deepest = &contact;
    }
    return {.a = world.bodies.idOf(deepest->a),
            .b = world.bodies.idOf(deepest->b),
            .contacts = static_cast<std::uint32_t>(contacts.size()),
            .point = deepest->point,
            .normal = deepest->normal,
            .distance = deepest->distance,
            .impulse = impulse};
}

/// Length of the run of contacts of one pair that begins at an index.
std::size_t runLength(std::span<const Contact> contacts, std::size_t begin) {
    std::size_t end = begin + 1;
    while (end < contacts.size() && contacts[end].a == contacts[begin].a && contacts[end].b == contacts[begin].b) ++end;
    return end - begin;
}

/// Order of pairs: by indices as the contacts are, then by generations, so that the pair of a body that was replaced
/// ends before that of its successor begins.
bool before(const TouchingPair& x, const TouchingPair& y) {
    return std::tie(x.a.index, x.b.index, x.a.generation, x.b.generation) <
           std::tie(y.a.index, y.b.index, y.a.generation, y.b.generation);
}

/// Merges the pairs of the last step with those of this one.
void collectContacts(WorldState& world) {
    EventLog& log = world.events;
    const std::span<const Contact> contacts = world.data.contacts;
    std::size_t old = 0;
    const auto end = [&] {
        const TouchingPair& pair = log.touching_before[old++];
        log.events.push_back({.kind = EventKind::contact_ended, .a = pair.a, .b = pair.b});
    };
    for (std::size_t i = 0; i < contacts.size();) {
        const std::size_t length = runLength(contacts, i);
        Event event = pairEvent(world, contacts.subspan(i, length));
        i += length;
        const TouchingPair pair{event.a, event.b};
        while (old < log.touching_before.size() && before(log.touching_before[old], pair)) end();
        event.kind = EventKind::contact_begun;
        if (old < log.touching_before.size() && log.touching_before[old] == pair) {
            ++old;
            event.kind = EventKind::contact_persisted;
        }
        if (event.kind == EventKind::contact_persisted && log.level != EventLevel::all) continue;
        log.events.push_back(event);
    }
    while (old < log.touching_before.size()) end();
}

void collectSleep(WorldState& world) {
    EventLog& log = world.events;
    const BodyStorage& bodies = world.bodies;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (bodies.kind[i] == BodyKind::hole || bodies.woken[i] == WakeReason::none) continue;
        log.events.push_back({.kind = EventKind::woke, .reason = bodies.woken[i], .a = bodies.idOf(i)});
    }
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (bodies.kind[i] != BodyKind::dynamic || bodies.asleep[i] == 0) continue;
        if (log.asleep_before[i] != 0 && bodies.woken[i] == WakeReason::none) continue;
        log.events.push_back({.kind = EventKind::fell_asleep, .a = bodies.idOf(i)});
    }
}

}  // namespace

void beginEvents(WorldState& world) {
    EventLog& log = world.events;
    log.events.clear();
    if (log.level == EventLevel::none) return;
    log.asleep_before.assign(world.bodies.asleep.begin(), world.bodies.asleep.end());
    log.faults_before = world.faults.size();
    log.touching_before.clear();
    const std::span<const Contact> contacts = world.data.contacts;
    for (std::size_t i = 0; i < contacts.size(); i += runLength(contacts, i)) {
        const Contact& c = contacts[i];
        log.touching_before.push_back({{c.a, world.data.generation[c.a]}, {c.b, world.data.generation[c.b]}});
    }
}

void collectEvents(WorldState& world) {
    EventLog& log = world.events;
    if (log.level == EventLevel::none) return;
    collectContacts(world);
    collectSleep(world);
    for (std::size_t i = log.faults_before; i < world.faults.size(); ++i) {
        log.events.push_back({.kind = EventKind::frozen, .a = world.faults[i].body});
    }
    for (const BrokenJoint& broken : world.data.broken) {
        log.events.push_back({.kind = EventKind::joint_broke,
                              .a = broken.a,
                              .b = broken.b,
                              .impulse = broken.impulse,
                              .joint = broken.joint});
    }
}

}  // namespace cairn
