#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cairn/filter.h"
#include "scene/placed_scene.h"
#include "scene/scene_reading.h"
#include "scene/scene_writing.h"

namespace cairn {
namespace {

/// What a group may have.
constexpr std::array<std::string_view, 4> group_keys = {"bodies", "springs", "joints", "drives"};

Scene readGroupTemplate(const JsonNode& node, const SceneReading& reading) {
    node.expectKeys(group_keys);
    SceneReading group = reading;
    readBodies(node.required("bodies", "an array of bodies"), group);
    if (const auto springs = node.find("springs")) readSprings(*springs, group);
    if (const auto joints = node.find("joints")) readJoints(*joints, group);
    if (const auto drives = node.find("drives")) readDrives(*drives, group);
    return std::move(group.scene);
}

bool isEqual(const PairProperties& a, const PairProperties& b) {
    return a.restitution == b.restitution && a.static_friction == b.static_friction &&
           a.kinetic_friction == b.kinetic_friction && a.rolling_friction == b.rolling_friction &&
           a.spinning_friction == b.spinning_friction;
}

using Names = std::pair<std::string, std::string>;

/// The value of a pair, in either order of its names.
template <class Value>
const Value* findPair(const std::vector<std::pair<Names, Value>>& pairs, const Names& names) {
    const Names swapped{names.second, names.first};
    const auto found =
        std::ranges::find_if(pairs, [&](const auto& pair) { return pair.first == names || pair.first == swapped; });
    return found == pairs.end() ? nullptr : &found->second;
}

std::string lawOf(const Scene& scene, const Names& names) {
    const PairLaw* law = findPair(scene.pair_laws, names);
    return law == nullptr ? std::string() : pairLawText(*law);
}

void mergePair(const Scene& from, const Names& names, const PairProperties& pair, const JsonNode& node, Scene& into) {
    const PairProperties* known = findPair(into.pairs, names);
    if (known == nullptr) {
        into.pairs.emplace_back(names, pair);
        if (const PairLaw* law = findPair(from.pair_laws, names)) into.pair_laws.emplace_back(names, *law);
    } else if (!isEqual(*known, pair) || lawOf(from, names) != lawOf(into, names)) {
        node.fail(fmt::format("has other contacts '{}/{}' than the scene; give one of the materials another name",
                              names.first, names.second));
    }
}

void mergeMaterials(const Scene& from, const JsonNode& node, SceneReading& reading) {
    for (const Material& material : from.materials) {
        const auto [known, added] = reading.density.emplace(material.name, material.density);
        if (added) reading.scene.materials.push_back(material);
        if (known->second != material.density) {
            node.fail(
                fmt::format("has a material '{}' of {} kg/m³, which the scene has with {}; give one of them "
                            "another name",
                            material.name, material.density, known->second));
        }
    }
    for (const auto& [names, pair] : from.pairs) mergePair(from, names, pair, node, reading.scene);
    if (!isEqual(from.default_pair, reading.scene.default_pair) && !isEqual(from.default_pair, PairProperties{})) {
        node.fail("has other default contacts than the scene, whose defaults count; give both the same, or pairs");
    }
}

void mergeGroups(const SceneFilters& from, const JsonNode& node, SceneFilters& into) {
    for (const std::string& name : from.groups) {
        if (std::ranges::find(into.groups, name) == into.groups.end()) into.groups.push_back(name);
    }
    if (into.groups.size() > most_groups) {
        node.fail(fmt::format("makes {} groups with those of the scene; a scene has at most {}", into.groups.size(),
                              most_groups));
    }
    const auto ordered = [](const auto& groups) { return std::minmax(groups.first, groups.second); };
    for (const auto& groups : from.apart) {
        const auto same = [&](const auto& others) { return ordered(others) == ordered(groups); };
        if (std::ranges::none_of(into.apart, same)) into.apart.push_back(groups);
    }
}

/// A scene of another file. What is about the whole scene cannot be placed.
Scene readIncluded(const JsonNode& node, SceneReading& reading) {
    const std::filesystem::path file = node.file();
    if (std::ranges::find(reading.files, std::filesystem::weakly_canonical(file)) != reading.files.end()) {
        node.fail("includes itself, directly or through others; take out one of the includes");
    }
    Scene scene;
    try {
        scene = readSceneIn(file, reading.files);
    } catch (const IoError& error) {
        node.fail(fmt::format("names a file that fails: {}", error.what()));
    }
    if (!scene.events.empty()) node.fail("has events; give them to the scene that includes it");
    if (scene.frame_motion) node.fail("has a frame_motion; give it to the scene that includes it");
    mergeMaterials(scene, node, reading);
    mergeGroups(scene.filters, node, reading.scene.filters);
    return scene;
}

const Scene& groupNamed(const JsonNode& node, const SceneReading& reading) {
    const auto found = reading.groups.find(node.text());
    if (found != reading.groups.end()) return found->second;
    if (reading.templates.contains(node.text())) node.fail("is a template of a body; give it to one of the bodies");
    node.fail(fmt::format("is the unknown template {}; {}", shown(node.value()),
                          knownNames(reading.groups, "templates") + " as groups"));
}

void readInclude(const JsonNode& node, SceneReading& reading) {
    node.expectKeys({"template", "file", "name", "position", "orientation"});
    Placement placement;
    if (const auto name = node.find("name")) placement.prefix = name->text() + "/";
    if (const auto value = node.find("position")) placement.pose.position = value->vector();
    if (const auto value = node.find("orientation")) placement.pose.orientation = readOrientation(*value).normalized();
    const auto file = node.find("file");
    const auto group = node.find("template");
    if (file.has_value() == group.has_value()) node.fail("needs either a file or a template");
    if (file) {
        place(readIncluded(*file, reading), placement, node, reading);
    } else {
        place(groupNamed(*group, reading), placement, node, reading);
    }
}

}  // namespace

void readSharedShapes(const JsonNode& node, SceneReading& reading) {
    if (!node.value().is_object()) node.refuse("an object with one entry per shape");
    for (const auto& [name, value] : node.value().get_ref<const Json::object_t&>()) {
        const JsonNode entry = node.member(name, value);
        if (name.empty()) entry.fail("is a shape without a name; a name has at least one character");
        reading.shapes.emplace(name, readShape(entry, reading));
    }
}

void readTemplates(const JsonNode& node, SceneReading& reading) {
    if (!node.value().is_object()) node.refuse("an object with one entry per template");
    for (const auto& [name, value] : node.value().get_ref<const Json::object_t&>()) {
        const JsonNode entry = node.member(name, value);
        if (name.empty()) entry.fail("is a template without a name; a name has at least one character");
        if (value.is_object() && entry.find("bodies")) {
            reading.groups.emplace(name, readGroupTemplate(entry, reading));
        } else {
            readTemplateOfBody(entry, name, reading);
        }
    }
}

void readIncludes(const JsonNode& node, SceneReading& reading) {
    node.expectArray("an array of what is included");
    for (std::size_t i = 0; i < node.size(); ++i) readInclude(node.element(i), reading);
}

}  // namespace cairn
