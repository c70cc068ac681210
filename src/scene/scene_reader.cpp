#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "integration/motion_curve.h"
#include "scene/scene_reading.h"

namespace cairn {
namespace {

/// Largest file that is read [bytes]: about half a million bodies.
constexpr std::uintmax_t largest_file = std::uintmax_t{64} << 20U;

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

}  // namespace

Scene parseScene(std::string_view json, std::string_view source) {
    const Json document = parseJson(json, source);
    const JsonNode root(document, source);
    root.expectKeys({"name", "duration", "gravity", "events", "materials", "contacts", "filters", "frame_motion",
                     "bodies", "springs", "joints", "settings"});
    SceneReading reading;
    Scene& scene = reading.scene;
    scene.name = root.required("name", "a text that is not empty").text();
    scene.duration = root.required("duration", "a number above 0 [s]").positive();
    scene.gravity = root.required("gravity", "an array of three numbers [m/s²]").vector();
    if (const auto node = root.find("materials")) readMaterials(*node, reading);
    if (const auto node = root.find("contacts")) readContacts(*node, reading);
    const auto filters = root.find("filters");
    if (filters) readGroups(*filters, reading);
    readBodies(root.required("bodies", "an array of bodies; it may be empty"), reading);
    if (filters) readFilterExceptions(*filters, reading);
    if (const auto node = root.find("frame_motion")) readFrameMotion(*node, scene);
    if (const auto node = root.find("events")) readEvents(*node, reading);
    if (const auto node = root.find("springs")) readSprings(*node, reading);
    if (const auto node = root.find("joints")) readJoints(*node, reading);
    if (const auto node = root.find("settings")) readSettings(*node, scene);
    return scene;
}

Scene readScene(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!error && size > largest_file) {
        throw InputError(
            fmt::format("{}: the file has {} bytes; a scene has at most {}", file.string(), size, largest_file));
    }
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (stream) text << stream.rdbuf();
    if (error || !stream || stream.bad()) {
        throw IoError(fmt::format("{}: cannot be read ({}); give the path of a scene file", file.string(),
                                  error ? error.message() : "not readable"));
    }
    return parseScene(text.str(), file.string());
}

}  // namespace cairn
