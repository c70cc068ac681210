/// @file The parts of a scene file, one reader each.
#pragma once

#include <map>
#include <string>

#include "cairn/scene.h"
#include "scene/joint_names.h"
#include "scene/json_node.h"

namespace cairn {

/// A scene on its way, with its names.
struct SceneReading {
    Scene scene;
    std::map<std::string, double, std::less<>> density;       ///< of each material [kg/m³]
    std::map<std::string, std::size_t, std::less<>> by_name;  ///< index of each named body
};

// Each reads the value of one key of the scene, in this order. @throws InputError
void readMaterials(const JsonNode& node, SceneReading& reading);
void readContacts(const JsonNode& node, SceneReading& reading);
void readBodies(const JsonNode& node, SceneReading& reading);
void readEvents(const JsonNode& node, SceneReading& reading);
void readSprings(const JsonNode& node, SceneReading& reading);
void readJoints(const JsonNode& node, SceneReading& reading);

/// @throws InputError
Shape readShape(const JsonNode& node);
Quat readOrientation(const JsonNode& node);
/// The index of a body that is given by index or name.
std::size_t readBodyReference(const JsonNode& node, const SceneReading& reading);

}  // namespace cairn
