/// @file What each rank has of a world that is divided, as bytes; all parts together are the world.
#pragma once

#include <span>

#include "world/byte_stream.h"
#include "world/world_state.h"

namespace cairn {

/// Writes what this rank has; the first one adds what all have in common. @pre the world is divided
void savePart(const WorldState& world, ByteWriter& out);

/// @param parts of all ranks of one moment, in their order @throws InputError if they are not, or no world is such
std::unique_ptr<WorldState> loadParts(std::span<ByteReader> parts);

}  // namespace cairn
