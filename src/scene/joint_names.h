/// @file How scene files call the kinds of joints.
#pragma once

#include <array>
#include <string_view>

#include "cairn/joint.h"

namespace cairn {

/// In the order of JointKind.
constexpr std::array<std::string_view, 6> jointNames() {
    return {"distance", "rope", "ball", "hinge", "slider", "fixed"};
}

}  // namespace cairn
