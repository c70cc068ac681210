/// @file What a snapshot of a world consists of: the pieces that whole snapshots and those of ranks have in common.
#pragma once

#include <memory>
#include <vector>

#include "world/byte_stream.h"
#include "world/world_state.h"

namespace cairn {

/// Settings, materials, gravity and time.
void saveHead(const WorldState& world, ByteWriter& out);
std::unique_ptr<WorldState> loadHead(ByteReader& in);

/// Refuses what no world can be, of bodies whose saved fields were read, and completes them.
void completeBodies(const ByteReader& in, std::size_t materials, std::uint64_t next_number, BodyStorage& bodies);

/// Filters, motions, springs and joints.
void saveTies(const WorldState& world, ByteWriter& out);
/// @pre the bodies are complete
void loadTies(ByteReader& in, WorldState& world);

/// @param bodies that say how the whole world calls the slots that contacts name
void saveContacts(const BodyStorage& bodies, const std::vector<Contact>& contacts, ByteWriter& out);
/// @param slots that contacts may name @param contacts gets them, and must be sorted by (a, b)
void loadContacts(ByteReader& in, std::size_t slots, std::vector<Contact>& contacts);

void saveFaults(const std::vector<FaultInfo>& faults, ByteWriter& out);
void loadFaults(ByteReader& in, std::vector<FaultInfo>& faults);

void saveEvents(const EventLog& log, ByteWriter& out);
void loadEvents(ByteReader& in, EventLog& log);

/// Refuses a time or settings that no world has.
void checkWorld(const ByteReader& in, const WorldState& world);

}  // namespace cairn
