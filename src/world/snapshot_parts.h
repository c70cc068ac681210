/// @file What each rank has of a world that is divided, as bytes, and what all have in common; together they are the
/// world.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "world/byte_stream.h"
#include "world/world_state.h"

namespace cairn {

/// Writes what this rank has. @pre the world is divided
void savePart(const WorldState& world, ByteWriter& out);
/// Writes what all ranks have, but for what is on all of them because of a fault. @pre as above, and this is the first
/// rank
void saveCommon(const WorldState& world, ByteWriter& out);

/// What is to be known before the parts are read.
struct DividedWorld {
    std::uint32_t ranks = 0;  ///< that it was divided among, with a part each
    std::int64_t steps = 0;   ///< time steps at that moment
    /// Whether a rank can go on with some of the parts alone: nothing that all must know names what it does not have.
    bool can_stay_divided = false;
};
DividedWorld loadDivided(ByteReader& common);

/// The world from its parts: whole from all of them, or else a part of it, which the ranks that have the others share
/// with this one. @param common behind what loadDivided() read @param parts ascending @param shared null = all parts
/// are there @throws InputError if they are not of one moment, or no world is such
std::unique_ptr<WorldState> loadParts(ByteReader& common, const DividedWorld& divided, std::span<ByteReader> parts,
                                      std::unique_ptr<SharedBodies> shared);

}  // namespace cairn
