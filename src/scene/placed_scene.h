/// @file Scenes within scenes: what is placed by `includes`.
#pragma once

#include <string>

#include "cairn/scene.h"
#include "scene/scene_reading.h"

namespace cairn {

/// Where the bodies of a group stand, and what they are called.
struct Placement {
    Pose pose{};         ///< of the group's frame in W
    std::string prefix;  ///< before each name
};

/// Adds bodies, with springs, joints and drives between them. Materials and groups must be there.
/// @param node where it is asked for, for messages @throws InputError for names that are there already, and for what
/// cannot be turned
void place(const Scene& group, const Placement& placement, const JsonNode& node, SceneReading& reading);

}  // namespace cairn
