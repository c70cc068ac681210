#include "world/events.h"

namespace cairn {

namespace {

/// The contacts of one pair as one event.
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

/// Tells which pairs began to touch, touched on and parted, in their order.
void collectContacts(WorldState& world) {
    EventLog& log = world.events;
    const std::vector<std::uint32_t>& generation = world.data.generation;
    std::span<const BodyPair> removed = world.data.pairs.removed();
    const auto endRemoved = [&] {
        const auto [a, b] = removed.front();
        removed = removed.subspan(1);
        log.events.push_back({.kind = EventKind::contact_ended, .a = {a, generation[a]}, .b = {b, generation[b]}});
    };
    for (const ContactPair& pair : world.data.pairs.pairs()) {
        // The pair of a body that was replaced ends before that of its successor begins.
        while (!removed.empty() && removed.front() <= pair) endRemoved();
        if (pair.touches()) {
            if (pair.touched && log.level != EventLevel::all) continue;
            Event event = pairEvent(world, std::span(world.data.contacts).subspan(pair.first, pair.count));
            event.kind = pair.touched ? EventKind::contact_persisted : EventKind::contact_begun;
            log.events.push_back(event);
        } else if (pair.touched) {
            log.events.push_back(
                {.kind = EventKind::contact_ended, .a = world.bodies.idOf(pair.a), .b = world.bodies.idOf(pair.b)});
        }
    }
    while (!removed.empty()) endRemoved();
}

/// Merges the bodies that sensors held in the last step with those of this one.
void collectSensed(WorldState& world) {
    EventLog& log = world.events;
    const auto order = [](const Sensed& s) { return std::tie(s.sensor, s.body); };
    auto old = log.sensed_before.begin();
    const auto leave = [&] {
        log.events.push_back({.kind = EventKind::sensor_left, .a = old->sensor, .b = old->body});
        ++old;
    };
    for (const Sensed& now : world.data.sensed) {
        while (old != log.sensed_before.end() && order(*old) < order(now)) leave();
        if (old != log.sensed_before.end() && *old == now) {
            ++old;
            continue;
        }
        log.events.push_back({.kind = EventKind::sensor_entered, .a = now.sensor, .b = now.body});
    }
    while (old != log.sensed_before.end()) leave();
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
    log.sensed_before = world.data.sensed;
    log.faults_before = world.faults.size();
}

void collectEvents(WorldState& world) {
    EventLog& log = world.events;
    if (log.level == EventLevel::none) return;
    collectContacts(world);
    collectSensed(world);
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
