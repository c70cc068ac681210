/// @file Clips: recordings small enough for a browser, for replays and exported pages. Format: docs/view-protocol.md.
#pragma once

#include <string>

#include "cairn/recording.h"

namespace cairn::view {

/// How finely a clip keeps the numbers.
struct ClipUnits {
    static constexpr double position = 1e-4;           ///< [m]
    static constexpr double orientation = 1.0 / 4095;  ///< of a quaternion's parts
    static constexpr double velocity = 1e-3;           ///< [m/s]
    static constexpr double spin = 1e-2;               ///< [rad/s]
};

/// The whole recording, quantised and compressed. @throws IoError if it cannot be read
std::string makeClip(const RecordingReader& recording);

}  // namespace cairn::view
