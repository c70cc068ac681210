/// @file The settings of a recording.
#pragma once

#include "cairn/recording.h"

namespace cairn {

/// @throws IoError if one is unknown or refused
Settings settingsOf(const RecordingInfo& info);

}  // namespace cairn
