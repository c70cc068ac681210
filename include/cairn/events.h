/// @file What a step tells the user's code: contacts that began, lasted and ended, bodies that slept, woke or failed.
#pragma once

#include <cstdint>

#include "cairn/types.h"

namespace cairn {

/// Why a body woke. The first six are the wake conditions of thesis §3.2.
enum class WakeReason : std::uint8_t {
    none,
    changed,            ///< 1 its state or a force on it was changed
    displaced,          ///< 2 the penetration correction moved it
    struck,             ///< 3 a contact of it was resolved
    neighbour_removed,  ///< 4 a body it touched was removed
    support_lost,       ///< 5 fewer contacts in the direction of gravity than in the last step
    floating,           ///< 6 no contact in the direction of gravity
};

/// What happened.
enum class EventKind : std::uint8_t {
    contact_begun,      ///< two bodies touch that did not in the last step
    contact_persisted,  ///< two bodies touch as in the last step
    contact_ended,      ///< two bodies no longer touch; either may have been removed
    woke,               ///< a body woke since the last step; Event::reason says why
    fell_asleep,        ///< a body fell asleep
    frozen,             ///< a body left the finite numbers and was fixed; World::faults() says more
    joint_broke,        ///< a joint was loaded more than it bears and is gone
    sensor_entered,     ///< body b overlaps sensor a and did not in the last step
    sensor_left,        ///< body b no longer overlaps sensor a; either may have been removed
};

/// One event of a step.
struct Event {
    EventKind kind = EventKind::contact_begun;  ///< what happened
    WakeReason reason = WakeReason::none;       ///< of EventKind::woke
    BodyId a{};                                 ///< the body; of contacts the one with the smaller index
    BodyId b{};                                 ///< the other body of a contact or joint; none = the world
    std::uint32_t contacts = 0;                 ///< contact points of the two bodies in this step
    Vec3 point = Vec3::Zero();                  ///< the deepest of them [m, W]
    Vec3 normal = Vec3::Zero();                 ///< of that point: unit, from B to A, W
    double distance = 0;                        ///< of that point along the normal [m]; negative = overlap
    Vec3 impulse = Vec3::Zero();                ///< sum that A received in the step [N·s, W]; B received the opposite
    JointId joint{};                            ///< of EventKind::joint_broke; its id is stale now
};

/// Which events a world collects; each level has those before it.
enum class EventLevel : std::uint8_t {
    none,     ///< nothing, at no cost
    changes,  ///< everything but EventKind::contact_persisted
    all,
};

}  // namespace cairn
