/// @file A recording as one page that plays without a network.
#pragma once

#include <filesystem>

#include "cairn/recording.h"

namespace cairn::view {

/// @throws IoError
void exportHtml(const RecordingReader& recording, const std::filesystem::path& file);

}  // namespace cairn::view
