/// @file Motions by laws in snapshots.
#pragma once

#include "world/byte_stream.h"
#include "world/world_state.h"

namespace cairn {

void saveMotions(const WorldState& world, ByteWriter& out);
/// @pre the bodies are loaded @throws InputError for motions that no world has
void loadMotions(ByteReader& in, WorldState& world);

}  // namespace cairn
