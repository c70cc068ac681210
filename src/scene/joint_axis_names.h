/// @file How scene files call the axes of joints.
#pragma once

#include <array>
#include <string_view>

#include "cairn/joint.h"

namespace cairn {

/// In the order of JointAlong.
constexpr std::array<std::string_view, 6> jointAxisNames() {
    return {"x", "y", "z", "turn_x", "turn_y", "turn_z"};
}

}  // namespace cairn
