#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene_testing.h"

namespace cairn {
namespace {

using Json = nlohmann::ordered_json;
using testing::parseMessage;
using testing::sceneText;
using testing::sceneWithBody;

Json schema() {
    std::ifstream file(CAIRN_SOURCE_DIR "/docs/scene.schema.json");
    return Json::parse(file);
}

std::vector<std::string> keysOf(const Json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.at("properties").items()) keys.push_back(key);
    std::sort(keys.begin(), keys.end());
    return keys;
}

/// The keys that the reader names as allowed in its message about the unknown key "?".
std::vector<std::string> allowedKeys(const std::string& text) {
    const std::string message = parseMessage(text);
    const std::string marker = "has the unknown key \"?\"; allowed are ";
    const std::size_t at = message.find(marker);
    EXPECT_NE(at, std::string::npos) << message;
    if (at == std::string::npos) return {};
    std::vector<std::string> keys{""};
    for (const char c : message.substr(at + marker.size())) {
        if (c == ',') {
            keys.emplace_back();
        } else if (c != ' ') {
            keys.back() += c;
        }
    }
    std::sort(keys.begin(), keys.end());
    return keys;
}

TEST(SceneSchema, ListsTheKeysThatTheReaderAllows) {
    const Json root = schema();
    const Json& parts = root.at("$defs");
    EXPECT_EQ(keysOf(root), allowedKeys(R"({"?":1})"));
    EXPECT_EQ(keysOf(parts.at("body")), allowedKeys(sceneWithBody(R"({"?":1})")));
    EXPECT_EQ(keysOf(parts.at("event")), allowedKeys(sceneText(R"(,"events":[{"?":1}])")));
    EXPECT_EQ(keysOf(parts.at("spring")), allowedKeys(sceneText(R"(,"springs":[{"?":1}])")));
    const std::string head = R"({"name":"a","duration":1,"gravity":[0,0,0],)";
    EXPECT_EQ(keysOf(parts.at("material")), allowedKeys(head + R"("materials":{"oak":{"?":1}}})"));
    EXPECT_EQ(keysOf(parts.at("pair")), allowedKeys(head + R"("contacts":{"default":{"?":1}}})"));
    const auto asTemplate = [&](const std::string& entry) {
        return head + R"("bodies":[],"templates":{"t":)" + entry + "}}";
    };
    EXPECT_EQ(keysOf(parts.at("template")), allowedKeys(asTemplate(R"({"?":1})")));
    EXPECT_EQ(keysOf(parts.at("group")), allowedKeys(asTemplate(R"({"bodies":[],"?":1})")));
    EXPECT_EQ(keysOf(parts.at("include")), allowedKeys(sceneText(R"(,"includes":[{"?":1}])")));
    EXPECT_EQ(keysOf(parts.at("drive")), allowedKeys(sceneText(R"(,"drives":[{"?":1,"force":1}])")));
    for (const Json& shape : parts.at("shape").at("oneOf")) {
        const std::string type = shape.at("properties").at("type").at("const").get<std::string>();
        const std::string body = R"({"material":"oak","shape":{"type":")" + type + R"(","?":1}})";
        EXPECT_EQ(keysOf(shape), allowedKeys(sceneWithBody(body)));
        // A surface, and what one encloses, is given in one of two ways.
        if (type == "mesh" || type == "solid" || type == "height_field") continue;
        const std::size_t optional = type == "compound" ? 1 : 0;
        EXPECT_EQ(shape.at("required").size() + optional, shape.at("properties").size());
    }
}

TEST(SceneSchema, RequiresWhatTheReaderRequires) {
    const Json root = schema();
    const auto expectRequired = [](const Json& object, const Json& complete, const Json& part, auto wrap) {
        std::vector<std::string> needed;
        for (const auto& [key, value] : part.items()) {
            Json smaller = part;
            smaller.erase(key);
            if (parseMessage(wrap(complete, smaller).dump()).find(key + " is missing") != std::string::npos) {
                needed.push_back(key);
            }
        }
        EXPECT_EQ(Json(needed), object.at("required"));
    };
    const Json complete = Json::parse(sceneText());
    const auto whole = [](const Json&, const Json& part) { return part; };
    const auto asBody = [](Json scene, const Json& part) {
        scene.at("bodies").push_back(part);
        return scene;
    };
    const auto asSpring = [](Json scene, const Json& part) {
        scene["springs"] = Json::array({part});
        return scene;
    };
    expectRequired(root, complete, complete, whole);
    expectRequired(root.at("$defs").at("body").at("anyOf").at(0), complete, complete.at("bodies").at(1), asBody);
    const Json spring = Json::parse(R"({"a":1,"b":2,"stiffness":1,"damping":1})");
    expectRequired(root.at("$defs").at("spring"), complete, spring, asSpring);
}

/// A number as it is written by hand: without a point where it is whole.
Json plainNumber(double value) {
    const auto whole = static_cast<std::int64_t>(value);
    return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

/// What the schema has to say of a field of the settings.
Json describeField(const SettingField& field) {
    Json entry;
    const SettingValue value = field.get(Settings{});
    if (std::holds_alternative<bool>(value)) {
        entry["type"] = "boolean";
    } else if (std::holds_alternative<std::string>(value)) {
        entry["enum"] = std::vector<std::string>(field.choices.begin(), field.choices.end());
    } else {
        entry["type"] = std::holds_alternative<double>(value) ? "number" : "integer";
        entry["minimum"] = plainNumber(field.minimum);
        entry["maximum"] = plainNumber(field.maximum);
    }
    entry["description"] =
        std::string(field.meaning) + (field.unit.empty() ? "" : " [" + std::string(field.unit) + "]");
    return entry;
}

TEST(SceneSchema, ListsAllSettingsWithTheirRanges) {
    const Json settings = schema().at("$defs").at("settings").at("properties");
    Json expected;
    expected["preset"] = settings.at("preset");
    for (const SettingField& field : settingFields()) expected[std::string(field.name)] = describeField(field);
    EXPECT_TRUE(settings == expected) << "settings changed; their properties in docs/scene.schema.json must be:\n"
                                      << expected.dump(2);
}

}  // namespace
}  // namespace cairn
