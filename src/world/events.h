/// @file Collects the events of a step.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Notes what the world is like before the step, since the stages overwrite it.
void beginEvents(WorldState& world);

/// Fills the events of the step: contacts by their pair, then what sensors hold, then bodies that woke and those that
/// fell asleep, each in ascending order of ids, then faults and broken joints likewise; of all ranks that share the
/// world. @pre the stages have run, the reasons of waking are not cleared yet
void collectEvents(WorldState& world);

/// Calls visit(member) for all members of an event. Snapshots and other ranks get them in this order.
/// @tparam AnyEvent maybe const
template <class AnyEvent, class Visit>
void forEventMembers(AnyEvent& event, const Visit& visit) {
    visit(event.kind);
    visit(event.reason);
    visit(event.a);
    visit(event.b);
    visit(event.contacts);
    visit(event.point);
    visit(event.normal);
    visit(event.distance);
    visit(event.impulse);
    visit(event.joint);
}

}  // namespace cairn
