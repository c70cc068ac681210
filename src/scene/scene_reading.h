/// @file The parts of a scene file, one reader each.
#pragma once

#include <map>
#include <string>

#include "cairn/scene.h"
#include "scene/json_node.h"

namespace cairn {

/// A scene on its way, with its names.
struct SceneReading {
    Scene scene;
    std::map<std::string, double, std::less<>> density;       ///< of each material [kg/m³]
    std::map<std::string, std::size_t, std::less<>> by_name;  ///< index of each named body
};

// Each reads the value of one key of the scene. @throws InputError
void readMaterials(const JsonNode& node, SceneReading& reading);
void readContacts(const JsonNode& node, SceneReading& reading);
void readBodies(const JsonNode& node, SceneReading& reading);
/// Names of groups, and which of them do not touch. Before the bodies, which name them.
void readGroups(const JsonNode& node, SceneReading& reading);
/// Exceptions of single pairs of bodies. After the bodies.
void readFilterExceptions(const JsonNode& node, SceneReading& reading);
void readEvents(const JsonNode& node, SceneReading& reading);
void readSprings(const JsonNode& node, SceneReading& reading);
void readJoints(const JsonNode& node, SceneReading& reading);

/// @throws InputError
Shape readShape(const JsonNode& node);
Quat readOrientation(const JsonNode& node);
/// Three moments, or these and the products xy, xz and yz. @param unit in the message
Mat3 readInertia(const JsonNode& node, std::string_view unit);
std::vector<double> readNumbers(const JsonNode& node);
/// How properties of a pair depend on the velocity at a contact.
PairLaw readPairLaw(const JsonNode& node);
/// One of the names of the axes of joints.
JointAlong readJointAlong(const JsonNode& node);
/// A law of motion of a body or frame.
Motion readMotion(const JsonNode& node);
/// The name of a group that the scene has.
std::string readGroup(const JsonNode& node, const SceneReading& reading);
/// The index of a body that is given by index or name.
std::size_t readBodyReference(const JsonNode& node, const SceneReading& reading);

}  // namespace cairn
