#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <new>

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
        node.fail("turns; the frame of a scene does not, remove spin or turns");
}

std::string textOf(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    std::string text;
    if (!error && stream) {
        try {
            text.resize(size);
        } catch (const std::bad_alloc&) {
            throw IoError(fmt::format("{}: cannot be read; its {} bytes are more than the memory that is free",
                                      file.string(), size));
        }
        stream.read(text.data(), static_cast<std::streamsize>(size));
        text.resize(static_cast<std::size_t>(stream.gcount()));
    }
    if (error || !stream.is_open() || stream.bad()) {
        throw IoError(fmt::format("{}: cannot be read ({}); give the path of a scene file", file.string(),
                                  error ? error.message() : "not readable"));
    }
    return text;
}

/// What names other things, and what it names.
void readContents(const JsonDocument& document, SceneReading& reading) {
    const JsonNode root = document.root();
    if (const auto node = root.find("materials")) readMaterials(*node, reading);
    if (const auto node = root.find("contacts")) readContacts(*node, reading);
    const auto filters = root.find("filters");
    if (filters) readGroups(*filters, reading);
    if (const auto node = root.find("shapes")) readSharedShapes(*node, reading);
    if (const auto node = root.find("templates")) readTemplates(*node, reading);
    const JsonNode bodies = root.required("bodies", "an array of bodies; it may be empty");
    bodies.expectArray("an array of bodies; it may be empty");
    document.forEachElement(bodies, [&reading](const JsonNode& body) { readBodyInto(body, reading); });
    if (const auto node = root.find("includes")) readIncludes(*node, reading);
    if (filters) readFilterExceptions(*filters, reading);
    if (const auto node = root.find("events")) readEvents(*node, reading);
    if (const auto node = root.find("springs")) readSprings(*node, reading);
    if (const auto node = root.find("joints")) readJoints(*node, reading);
    addPlaced(reading);
    if (const auto node = root.find("drives")) readDrives(*node, reading);
}

Scene parseSceneIn(std::string_view json, std::string_view source, std::vector<std::filesystem::path> files) {
    const JsonDocument document(json, source, "bodies");
    const JsonNode root = document.root();
    root.expectKeys({"name", "duration", "gravity", "events", "materials", "contacts", "filters", "frame_motion",
                     "shapes", "templates", "bodies", "includes", "springs", "joints", "drives", "settings"});
    SceneReading reading;
    reading.files = std::move(files);
    Scene& scene = reading.scene;
    scene.name = root.required("name", "a text that is not empty").text();
    scene.duration = root.required("duration", "a number above 0 [s]").positive();
    readGravity(root.required("gravity", "an array of three numbers [m/s²], or a function of time"), scene);
    readContents(document, reading);
    if (const auto node = root.find("frame_motion")) readFrameMotion(*node, scene);
    if (const auto node = root.find("settings")) readSettings(*node, scene);
    return std::move(reading.scene);
}

}  // namespace

Scene parseScene(std::string_view json, std::string_view source) {
    return parseSceneIn(json, source, {});
}

Scene readScene(const std::filesystem::path& file) {
    return readSceneIn(file, {});
}

Scene readSceneIn(const std::filesystem::path& file, std::vector<std::filesystem::path> files) {
    const std::string text = textOf(file);
    files.push_back(std::filesystem::weakly_canonical(file));
    return parseSceneIn(text, file.string(), std::move(files));
}

}  // namespace cairn
