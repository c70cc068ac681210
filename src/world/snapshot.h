/// @file The complete world as bytes. A run that is continued from them goes on bit by bit as it would have.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "world/byte_stream.h"
#include "world/world_state.h"

namespace cairn {

/// Everything but wall times and what a step computes anew.
void saveWorld(const WorldState& world, ByteWriter& out);

/// @throws InputError with the offset, for anything that cannot be the state of a world
std::unique_ptr<WorldState> loadWorld(ByteReader& in);

}  // namespace cairn
