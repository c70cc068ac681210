#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "integration/motion_curve.h"
#include "scene/scene_reading.h"

namespace cairn {
namespace {

SettingValue readSettingValue(const JsonNode& node) {
    const Json& value = node.value();
    if (value.is_boolean()) return value.get<bool>();
    if (value.is_number_float()) return value.get<double>();
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number()) node.refuse("true, false, a number or a text");
    if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t{INT64_MAX}) {
        return value.get<double>();
    }
    return value.get<std::int64_t>();
}

void readSettings(const JsonNode& node, Scene& scene) {
    if (!node.value().is_object()) node.refuse("an object with preset and fields of the settings");
    Settings scratch;
    for (const auto& [key, value] : node.value().get_ref<const Json::object_t&>()) {
        const JsonNode entry = node.member(key, value);
        if (key == "preset") {
            const std::string name = entry.text();
            if (std::ranges::find(presetNames(), name) == presetNames().end()) {
                entry.refuse(fmt::format("one of {}", fmt::join(presetNames(), ", ")));
            }
            scene.preset = presetNamed(name);
            continue;
        }
        SettingValue setting = readSettingValue(entry);
        try {
            setField(scratch, key, setting);
        } catch (const InputError& error) {
            entry.fail(fmt::format("is not allowed: {}", error.what()));
        }
        scene.settings.emplace_back(key, std::move(setting));
    }
}

void readFrameMotion(const JsonNode& node, Scene& scene) {
    scene.frame_motion = readMotion(node);
    if (node.find("pivot")) node.fail("has a pivot; a frame does not turn, remove it");
    if (MotionCurve(*scene.frame_motion).turns())
        node.fail(
            "turns; the frame of a scene does not: remove spin or turns, and give them to the ground as its motion");
}

JsonNode bodiesOf(const JsonNode& root) {
    const JsonNode bodies = root.required("bodies", "an array of bodies; it may be empty");
    bodies.expectArray("an array of bodies; it may be empty");
    return bodies;
}

/// What stands before the bodies: what is about all of the scene, and what bodies name.
SceneReading readBeginning(const JsonNode& root, std::vector<std::filesystem::path> files) {
    root.expectKeys({"name", "duration", "gravity", "events", "materials", "contacts", "filters", "frame_motion",
                     "shapes", "templates", "bodies", "includes", "springs", "joints", "drives", "settings"});
    SceneReading reading;
    reading.files = std::move(files);
    Scene& scene = reading.scene;
    scene.name = root.required("name", "a text that is not empty").text();
    scene.duration = root.required("duration", "a number above 0 [s]").positive();
    readGravity(root.required("gravity", "an array of three numbers [m/s²], or a function of time"), scene);
    if (const auto node = root.find("materials")) readMaterials(*node, reading);
    if (const auto node = root.find("contacts")) readContacts(*node, reading);
    if (const auto node = root.find("filters")) readGroups(*node, reading);
    if (const auto node = root.find("shapes")) readSharedShapes(*node, reading);
    if (const auto node = root.find("templates")) readTemplates(*node, reading);
    return reading;
}

/// What stands behind the bodies, and may name them.
void readEnd(const JsonNode& root, SceneReading& reading) {
    if (const auto node = root.find("includes")) readIncludes(*node, reading);
    if (const auto node = root.find("filters")) readFilterExceptions(*node, reading);
    if (const auto node = root.find("events")) readEvents(*node, reading);
    if (const auto node = root.find("springs")) readSprings(*node, reading);
    if (const auto node = root.find("joints")) readJoints(*node, reading);
    addPlaced(reading);
    if (const auto node = root.find("drives")) readDrives(*node, reading);
    if (const auto node = root.find("frame_motion")) readFrameMotion(*node, reading.scene);
    if (const auto node = root.find("settings")) readSettings(*node, reading.scene);
}

Scene parseSceneIn(const JsonDocument& document, std::vector<std::filesystem::path> files) {
    const JsonNode root = document.root();
    SceneReading reading = readBeginning(root, std::move(files));
    document.forEachElement(bodiesOf(root), [&reading](const JsonNode& body) { readBodyInto(body, reading); });
    readEnd(root, reading);
    return std::move(reading.scene);
}

/// Whether something of the scene names bodies or adds some, so that all must be there.
bool namesBodies(const JsonNode& root) {
    for (const std::string_view key : {"includes", "springs", "joints", "drives"}) {
        if (root.find(key)) return true;
    }
    if (const auto filters = root.find("filters"); filters && filters->find("exceptions")) return true;
    const auto events = root.find("events");
    for (std::size_t i = 0; events && i < events->size(); ++i) {
        if (events->element(i).find("body")) return true;
    }
    return false;
}

/// Tells the bodies of a document, of which each is read and given away. @param beginning what they name
void tellBodies(const JsonDocument& document, const SceneReading& beginning, const SceneSource::Take& take) {
    SceneReading reading = beginning;
    const JsonNode root = document.root();
    document.forEachElement(bodiesOf(root), [&](const JsonNode& body) {
        readBodyInto(body, reading);
        take(reading.scene.bodies.back());
        reading.scene.bodies.clear();
        ++reading.told;
    });
}

std::shared_ptr<const JsonDocument> openDocument(const std::filesystem::path& file) {
    return std::make_shared<const JsonDocument>(PagedText(std::make_shared<const TextFile>(file)), file.string(),
                                                "bodies");
}

}  // namespace

Scene parseScene(std::string_view json, std::string_view source) {
    return parseSceneIn(JsonDocument(PagedText(json), std::string(source), "bodies"), {});
}

Scene readScene(const std::filesystem::path& file) {
    return readSceneIn(file, {});
}

Scene readSceneIn(const std::filesystem::path& file, std::vector<std::filesystem::path> files) {
    const auto document = openDocument(file);
    files.push_back(std::filesystem::weakly_canonical(file));
    return parseSceneIn(*document, std::move(files));
}

SceneSource readSceneSource(const std::filesystem::path& file) {
    return readWithTemplates(file).source;
}

SceneWithTemplates readWithTemplates(const std::filesystem::path& file) {
    const std::shared_ptr<const JsonDocument> document = openDocument(file);
    const JsonNode root = document->root();
    const std::vector<std::filesystem::path> files{std::filesystem::weakly_canonical(file)};
    if (root.value().is_object() && namesBodies(root)) return {parseSceneIn(*document, files)};
    const auto beginning = std::make_shared<const SceneReading>(readBeginning(root, files));
    SceneReading all = *beginning;
    readEnd(root, all);
    const auto tell = [document, beginning](const SceneSource::Take& take) { tellBodies(*document, *beginning, take); };
    return {SceneSource(std::move(all.scene), tell), beginning->templates};
}

}  // namespace cairn
