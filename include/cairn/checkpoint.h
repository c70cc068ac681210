/// @file Runs on disk, so that they can be stopped, or killed, and continued.
#pragma once

#include <filesystem>

#include "cairn/scene.h"

namespace cairn {

/// Writes a run to a file. Whatever happens, the file is complete afterwards: the new one, or the one before it if this
/// throws, the program is killed or the power fails.
/// @throws IoError if it cannot be written, for example because the disk is full
void writeCheckpoint(const SceneRun& run, const std::filesystem::path& file);

/// @throws IoError if it cannot be read; InputError with the offset if it is damaged or no checkpoint
SceneRun readCheckpoint(const std::filesystem::path& file);

}  // namespace cairn
