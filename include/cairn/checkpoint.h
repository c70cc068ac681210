/// @file Runs on disk, so that they can be stopped, or killed, and continued.
#pragma once

#include <filesystem>

#include "cairn/scene.h"

namespace cairn {

/// Writes a run to a file. Whatever happens, the file is complete afterwards: the new one, or the one before it if this
/// throws, the program is killed or the power fails.
///
/// Of a world that ranks share it is to be called by all of them, who need the same folder: each writes what it has
/// into the folder FILE.parts, to which the first adds the scene, and when all have done so FILE names these parts.
/// Nothing is gathered.
/// @throws IoError if it cannot be written, for example because the disk is full; on all ranks if it is so on one
void writeCheckpoint(const SceneRun& run, const std::filesystem::path& file);

/// Reads what one or more ranks wrote; the world is whole then. @throws IoError if it cannot be read; InputError with
/// the offset if it is damaged or no checkpoint
SceneRun readCheckpoint(const std::filesystem::path& file);
/// The same on ranks that are to share the world, of any number. Of what ranks wrote each reads some of the parts, as
/// World::restoreParts() says; what one rank wrote is read as a whole by each. @param ranks must outlive the run
/// @throws as above, maybe on some of the ranks only
SceneRun readCheckpoint(const std::filesystem::path& file, Ranks& ranks, const Partition& partition = {});

}  // namespace cairn
