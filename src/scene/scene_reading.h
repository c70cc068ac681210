/// @file The parts of a scene file, one reader each.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cairn/scene.h"
#include "scene/json_document.h"
#include "scene/json_node.h"

namespace cairn {

/// What bodies take from a template.
struct BodyTemplate {
    SceneBody body;          ///< its material is empty if the template gives none
    bool has_shape = false;  ///< whether the template gives one
};

/// Things by name.
template <class Thing>
using ByName = std::map<std::string, Thing, std::less<>>;

/// A scene on its way, with its names.
struct SceneReading {
    Scene scene;
    ByName<double> density;          ///< of each material [kg/m³]
    ByName<std::size_t> by_name;     ///< index of each named body
    ByName<Shape> shapes;            ///< that bodies share
    ByName<BodyTemplate> templates;  ///< of bodies
    ByName<Scene> groups;            ///< templates of groups: bodies, springs and joints
    std::size_t told = 0;            ///< bodies that were taken out of the scene, which stood before the others
    Scene placed;                    ///< springs, joints and drives of what is included; follow the scene's own
    std::vector<std::filesystem::path> files{};  ///< that are being read, each included by the one before
};

// Each reads the value of one key of the scene. @throws InputError
void readMaterials(const JsonNode& node, SceneReading& reading);
void readContacts(const JsonNode& node, SceneReading& reading);
/// Shapes by name, of which bodies share what was computed.
void readSharedShapes(const JsonNode& node, SceneReading& reading);
/// Templates of bodies and of groups; each may use those before it.
void readTemplates(const JsonNode& node, SceneReading& reading);
/// A template of a body. @param name of the template
void readTemplateOfBody(const JsonNode& node, std::string_view name, SceneReading& reading);
/// One body, which becomes the scene's last.
void readBodyInto(const JsonNode& node, SceneReading& reading);
/// All bodies of an array.
void readBodies(const JsonNode& node, SceneReading& reading);
/// What the scene takes of its templates and of other files. After the bodies.
void readIncludes(const JsonNode& node, SceneReading& reading);
/// Adds the springs and joints of what is included. After the scene's own.
void addPlaced(SceneReading& reading);
/// Names of groups, and which of them do not touch. Before the bodies, which name them.
void readGroups(const JsonNode& node, SceneReading& reading);
/// Exceptions of single pairs of bodies. After the bodies.
void readFilterExceptions(const JsonNode& node, SceneReading& reading);
void readEvents(const JsonNode& node, SceneReading& reading);
void readSprings(const JsonNode& node, SceneReading& reading);
void readJoints(const JsonNode& node, SceneReading& reading);
/// Gravity [m/s²], which may be a function of time.
void readGravity(const JsonNode& node, Scene& scene);
/// What follows functions of time. After the joints.
void readDrives(const JsonNode& node, SceneReading& reading);

/// A scene file, and the templates of bodies that it has.
struct SceneWithTemplates {
    SceneSource source;
    ByName<BodyTemplate> templates{};
};
/// @throws as readSceneSource()
SceneWithTemplates readWithTemplates(const std::filesystem::path& file);
/// A scene that another one may include. @param files that are being read @throws InputError, IoError
Scene readSceneIn(const std::filesystem::path& file, std::vector<std::filesystem::path> files);
/// A shape, or the name of a shared one. @throws InputError
Shape readShape(const JsonNode& node, const SceneReading& reading);
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
/// What a table does after its last time.
TableEnd readTableEnd(const JsonNode& node);
/// The name of a group that the scene has.
std::string readGroup(const JsonNode& node, const SceneReading& reading);
/// The names of things, for messages. @param key of the scene that lists them
template <class Thing>
std::string knownNames(const ByName<Thing>& things, std::string_view key) {
    if (things.empty()) return "'" + std::string(key) + "' lists none";
    std::string all;
    for (const auto& [name, thing] : things) all += (all.empty() ? "known are " : ", ") + name;
    return all;
}
/// The index of a body that is given by index or name.
std::size_t readBodyReference(const JsonNode& node, const SceneReading& reading);

}  // namespace cairn
