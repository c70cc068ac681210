#include "world/events.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <type_traits>

#include "messages/packing.h"

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

/// The pairs that touched at the end of the last step.
void listTouching(const WorldState& world, std::vector<Touching>& touching) {
    const auto idOf = [&](BodyIndex i) { return BodyId{world.bodies.homeOf(i), world.data.generation[i]}; };
    touching.clear();
    for (const ContactPair& pair : world.data.pairs.pairs()) {
        if (pair.touches()) touching.push_back({idOf(pair.a), idOf(pair.b)});
    }
}

// In the order of the pairs.
auto placeOf(const Touching& t) {
    return std::tuple(t.a.index, t.b.index, t.a.generation, t.b.generation);
}

auto placeOf(const Sensed& s) {
    return std::tuple(s.sensor, s.body);
}

/// Goes through two lists that are sorted by their places: began(i) for what only the second has, lasted(i) for what is
/// in both, ended(i) for what only the first has. @param forNow calls with each of the second
template <class Before, class ForNow, class Began, class Lasted, class Ended>
void compare(const Before& before, const ForNow& forNow, const Began& began, const Lasted& lasted, const Ended& ended) {
    auto old = before.begin();
    forNow([&](const auto& now) {
        // The pair of a body that was replaced ends before that of its successor begins.
        for (; old != before.end() && placeOf(*old) < placeOf(now); ++old) ended(*old);
        if (old == before.end() || placeOf(now) < placeOf(*old)) {
            began(now);
            return;
        }
        lasted(now);
        ++old;
    });
    for (; old != before.end(); ++old) ended(*old);
}

/// A pair of this step, that may be compared with those of the last.
struct TouchingNow : Touching {
    const ContactPair* pair;
};

/// Tells which pairs began to touch, touched on and parted, in their order.
void collectContacts(WorldState& world) {
    EventLog& log = world.events;
    const auto forTouching = [&](const auto& use) {
        for (const ContactPair& pair : world.data.pairs.pairs()) {
            if (pair.touches()) use(TouchingNow{{world.bodies.idOf(pair.a), world.bodies.idOf(pair.b)}, &pair});
        }
    };
    const auto tell = [&](const TouchingNow& now, EventKind kind) {
        Event event = pairEvent(world, std::span(world.data.contacts).subspan(now.pair->first, now.pair->count));
        event.kind = kind;
        log.events.push_back(event);
    };
    compare(
        log.touched_before, forTouching, [&](const TouchingNow& now) { tell(now, EventKind::contact_begun); },
        [&](const TouchingNow& now) {
            if (log.level == EventLevel::all) tell(now, EventKind::contact_persisted);
        },
        [&](const Touching& old) { log.events.push_back({.kind = EventKind::contact_ended, .a = old.a, .b = old.b}); });
}

/// Compares the bodies that sensors held in the last step with those of this one.
void collectSensed(WorldState& world) {
    EventLog& log = world.events;
    const auto tell = [&](const Sensed& sensed, EventKind kind) {
        log.events.push_back({.kind = kind, .a = sensed.sensor, .b = sensed.body});
    };
    const auto forSensed = [&](const auto& use) { std::ranges::for_each(world.data.sensed, use); };
    compare(
        log.sensed_before, forSensed, [&](const Sensed& now) { tell(now, EventKind::sensor_entered); },
        [](const Sensed&) {}, [&](const Sensed& old) { tell(old, EventKind::sensor_left); });
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

/// Which kinds of events stand in one row, and where.
int rowOf(EventKind kind) {
    switch (kind) {
        case EventKind::contact_begun:
        case EventKind::contact_persisted:
        case EventKind::contact_ended:
            return 0;
        case EventKind::sensor_entered:
        case EventKind::sensor_left:
            return 1;
        case EventKind::woke:
            return 2;
        case EventKind::fell_asleep:
            return 3;
        case EventKind::frozen:
            return 4;
        case EventKind::joint_broke:
            return 5;
    }
    return 6;
}

/// By row, and in it as one rank lists them.
auto placeOf(const Event& event) {
    const int row = rowOf(event.kind);
    const auto [a, b] = std::pair(event.a, event.b);
    const std::array in_row = row == 0 ? std::array{a.index, b.index, a.generation, b.generation}
                                       : std::array{a.index, a.generation, b.index, b.generation};
    return std::tuple(row, event.kind == EventKind::joint_broke ? event.joint : JointId{}, in_row);
}

/// What a body began on the rank that it came to, it ended on the one that it left: then it lasted.
Event joined(const Event& one, const Event& other) {
    const bool ended = one.kind == EventKind::contact_ended || one.kind == EventKind::sensor_left;
    Event event = ended ? other : one;
    event.kind = EventKind::contact_persisted;
    return event;
}

bool isCounterpart(EventKind one, EventKind other) {
    return one != other && rowOf(one) == rowOf(other) && rowOf(one) <= 1;
}

/// Lists the events of all ranks, in the order of one.
void gatherEvents(Ranks& ranks, EventLog& log) {
    std::vector<std::byte> message;
    for (const Event& event : log.events) {
        forEventMembers(event, [&](const auto& member) { pack(message, member); });
    }
    std::vector<Event> all;
    for (const auto& told : tellAll(ranks, message)) {
        for (Unpacker in(told); !in.isAtEnd();) {
            forEventMembers(all.emplace_back(),
                            [&](auto& member) { member = in.get<std::remove_reference_t<decltype(member)>>(); });
        }
    }
    std::ranges::stable_sort(all, {}, [](const Event& e) { return placeOf(e); });
    log.events.clear();
    for (auto next = all.begin(); next != all.end();) {
        const auto end = std::find_if(next, all.end(), [&](const Event& e) { return placeOf(e) != placeOf(*next); });
        // Of fixed bodies all ranks tell the same.
        const auto other = std::find_if(next, end, [&](const Event& e) { return isCounterpart(e.kind, next->kind); });
        if (other == end) {
            log.events.push_back(*next);
        } else if (log.level == EventLevel::all && rowOf(next->kind) == 0) {
            log.events.push_back(joined(*next, *other));
        }
        next = end;
    }
}

}  // namespace

void beginEvents(WorldState& world) {
    EventLog& log = world.events;
    log.events.clear();
    if (log.level == EventLevel::none) return;
    log.asleep_before.assign(world.bodies.asleep.begin(), world.bodies.asleep.end());
    log.faults_before = world.faults.size();
    log.touched_before.clear();
    log.sensed_before.clear();
    // Of a whole world the first rank tells what ended.
    if (world.shared != nullptr && world.shared->isWhole() && world.shared->ranks().rank() != 0) return;
    listTouching(world, log.touched_before);
    log.sensed_before = world.data.sensed;
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
    if (world.shared != nullptr) gatherEvents(world.shared->ranks(), log);
}

}  // namespace cairn
