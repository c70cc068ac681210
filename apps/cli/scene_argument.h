/// @file A scene as it is named on the command line.
#pragma once

#include <filesystem>
#include <string>

#include "cairn/scene.h"

namespace cairn::cli {

/// @param argument the name of a built-in scene, or else a file @throws InputError, IoError
Scene loadScene(const std::string& argument);
/// The same of which bodies are told. @throws as loadScene()
SceneSource openScene(const std::string& argument);

/// True for a file whose name or first bytes are those of HDF5.
bool looksLikeRecording(const std::filesystem::path& file);

}  // namespace cairn::cli
