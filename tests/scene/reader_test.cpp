#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scene_testing.h"

namespace cairn {
namespace {

using testing::parseMessage;
using testing::sceneText;
using testing::sceneWithBody;

/// A bad text and what its message must say.
struct Bad {
    std::string text;
    std::vector<std::string> said;
};

void expectRefused(const std::vector<Bad>& all) {
    for (const Bad& bad : all) {
        const std::string message = parseMessage(bad.text);
        EXPECT_FALSE(message.empty()) << "accepted: " << bad.text;
        EXPECT_TRUE(message.starts_with("test.json:")) << message;
        for (const std::string& part : bad.said) {
            EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
        }
    }
}

/// A body of oak with a shape.
std::string shape(const std::string& text) {
    return sceneWithBody(R"({"shape":)" + text + R"(,"material":"oak"})");
}

/// A ball of oak with further members.
std::string ball(const std::string& members) {
    return sceneWithBody(R"({"shape":{"type":"sphere","radius":1},"material":"oak",)" + members + "}");
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
}

std::string event(const std::string& members) {
    return sceneText(R"(,"events":[{)" + members + "}]");
}
std::string spring(const std::string& members) {
    return sceneText(R"(,"springs":[{)" + members + "}]");
}
std::string settings(const std::string& members) {
    return sceneText(R"(,"settings":{)" + members + "}");
}
std::string contacts(const std::string& members) {
    return replaced(sceneText(), R"({"default":{"restitution":0.5}})", "{" + members + "}");
}

TEST(SceneReader, ReadsEveryMember) {
    const Scene scene = parseScene(
        R"({"name":"all","duration":2.5,"gravity":[1,2,-3],
        "events":[{"time":1,"gravity":[0,0,-1]},{"time":0.5,"body":"a","set_velocity":[1,0,0]},
          {"time":0.5,"body":1,"impulse":[0,1,0]},{"time":0.5,"body":1,"force":[0,0,1]},
          {"time":0.5,"body":1,"torque":[0,0,2]},{"time":3,"body":1,"remove":true}],
        "materials":{"oak":{"density":800},"iron":{"density":7874}},
        "contacts":{"oak/iron":{"static_friction":0.9},"default":{"restitution":0.5,"kinetic_friction":0.1,"rolling_friction":0.02,"spinning_friction":0.003}},
        "bodies":[{"shape":{"type":"capsule","radius":0.1,"length":0.4},"material":"oak","name":"a","mass":7,
            "position":[1,2,3],"orientation":[0,2,0,0],"linear_velocity":[4,5,6],"angular_velocity":[7,8,9]},
          {"shape":{"type":"box","size":[1,2,3]},"material":"iron","asleep":true},
          {"shape":{"type":"plane","normal":[0,3,4],"offset":-1},"material":"iron","fixed":true}],
        "springs":[{"a":"a","b":1,"anchor_a":[1,0,0],"anchor_b":[0,1,0],"stiffness":10,"damping":2,"rest_length":0.5},
          {"a":0,"stiffness":0}],
        "settings":{"preset":"accuracy","sleeping":false,"threads":2,"sleep_threshold":0.001}})",
        "all");
    EXPECT_EQ(scene.name, "all");
    EXPECT_EQ(scene.duration, 2.5);
    EXPECT_EQ(scene.gravity, Vec3(1, 2, -3));
    ASSERT_EQ(scene.events.size(), 6U);
    EXPECT_EQ(std::get<SetGravity>(scene.events[0].action).gravity, Vec3(0, 0, -1));
    EXPECT_EQ(scene.events[0].time, 1);
    EXPECT_EQ(std::get<SetVelocity>(scene.events[1].action).body, 0U);
    EXPECT_EQ(std::get<SetVelocity>(scene.events[1].action).velocity, Vec3(1, 0, 0));
    EXPECT_EQ(std::get<GiveImpulse>(scene.events[2].action).impulse, Vec3(0, 1, 0));
    EXPECT_EQ(std::get<SetForce>(scene.events[3].action).force, Vec3(0, 0, 1));
    EXPECT_EQ(std::get<SetTorque>(scene.events[4].action).torque, Vec3(0, 0, 2));
    EXPECT_EQ(std::get<RemoveBody>(scene.events[5].action).body, 1U);
    ASSERT_EQ(scene.materials.size(), 2U);
    EXPECT_EQ(scene.materials[1].name, "iron");
    EXPECT_EQ(scene.materials[1].density, 7874);
    EXPECT_EQ(scene.default_pair.restitution, 0.5);
    EXPECT_EQ(scene.default_pair.static_friction, 0.2);
    EXPECT_EQ(scene.default_pair.kinetic_friction, 0.1);
    ASSERT_EQ(scene.pairs.size(), 1U);
    EXPECT_EQ(scene.pairs[0].first, (std::pair<std::string, std::string>("oak", "iron")));
    EXPECT_EQ(scene.pairs[0].second.restitution, 0.5) << "inherited from the default, which stands after it";
    EXPECT_EQ(scene.pairs[0].second.static_friction, 0.9);
    EXPECT_EQ(scene.pairs[0].second.kinetic_friction, 0.1);
    EXPECT_EQ(scene.pairs[0].second.rolling_friction, 0.02);
    EXPECT_EQ(scene.pairs[0].second.spinning_friction, 0.003);
    ASSERT_EQ(scene.bodies.size(), 3U);
    EXPECT_EQ(std::get<Capsule>(scene.bodies[0].shape).radius, 0.1);
    EXPECT_EQ(std::get<Capsule>(scene.bodies[0].shape).length, 0.4);
    EXPECT_EQ(scene.bodies[0].name, "a");
    EXPECT_EQ(scene.bodies[0].mass, 7);
    EXPECT_EQ(scene.bodies[0].position, Vec3(1, 2, 3));
    EXPECT_EQ(scene.bodies[0].orientation.coeffs(), Quat(0, 2, 0, 0).coeffs());
    EXPECT_EQ(scene.bodies[0].linear_velocity, Vec3(4, 5, 6));
    EXPECT_EQ(scene.bodies[0].angular_velocity, Vec3(7, 8, 9));
    EXPECT_FALSE(scene.bodies[0].fixed);
    EXPECT_EQ(std::get<Box>(scene.bodies[1].shape).size, Vec3(1, 2, 3));
    EXPECT_TRUE(scene.bodies[1].asleep);
    EXPECT_EQ(std::get<HalfSpace>(scene.bodies[2].shape).normal, Vec3(0, 3, 4));
    EXPECT_EQ(std::get<HalfSpace>(scene.bodies[2].shape).offset, -1);
    EXPECT_TRUE(scene.bodies[2].fixed);
    ASSERT_EQ(scene.springs.size(), 2U);
    EXPECT_EQ(scene.springs[0].a, 0U);
    EXPECT_EQ(scene.springs[0].b, 1U);
    EXPECT_EQ(scene.springs[0].anchor_a, Vec3(1, 0, 0));
    EXPECT_EQ(scene.springs[0].anchor_b, Vec3(0, 1, 0));
    EXPECT_EQ(scene.springs[0].stiffness, 10);
    EXPECT_EQ(scene.springs[0].damping, 2);
    EXPECT_EQ(scene.springs[0].rest_length, 0.5);
    EXPECT_FALSE(scene.springs[1].b.has_value());
    EXPECT_EQ(scene.preset, Preset::accuracy);
    ASSERT_EQ(scene.settings.size(), 3U);
    EXPECT_EQ(scene.settings[0].second, SettingValue(false));
    EXPECT_EQ(scene.settings[1].second, SettingValue(std::int64_t{2}));
    EXPECT_EQ(scene.settings[2].second, SettingValue(0.001));
}

TEST(SceneReader, AcceptsASceneWithoutBodies) {
    const Scene scene = parseScene(R"({"name":"empty","duration":1,"gravity":[0,0,0],"bodies":[]})", "empty.json");
    EXPECT_TRUE(scene.bodies.empty());
    EXPECT_EQ(scene.default_pair.restitution, PairProperties{}.restitution);
}

TEST(SceneReader, NamesLineAndColumnOfWrongSyntax) {
    expectRefused({
        {"", {"test.json:1:1: ", "unexpected end of input"}},
        {"{\n  \"name\": ,\n}", {"test.json:2:11: "}},
        {"{\"name\":\"a\"} x", {"test.json:1:14: "}},
        {"{\n\n\"duration\": NaN}", {"test.json:3:13: ", "finite"}},
        {"{\"duration\": -Infinity}", {"test.json:1:15: ", "finite"}},
        {"{\"duration\":\n 1e999}", {"test.json:2:6: ", "1e999"}},
        {"{\"name\":\"\xff\"}", {"test.json:1:10: "}},
        {std::string("{\"name\":\"a\0b\"}", 14), {"test.json:1:11: "}},
    });
}

TEST(SceneReader, RefusesKeysGivenTwiceAndEndlessNesting) {
    expectRefused({
        {R"({"name":"a","name":"b"})", {"name is given twice"}},
        {ball(R"("mass":1,"mass":2)"), {"bodies[3].mass is given twice"}},
        {R"({"a":)" + std::string(1000000, '['), {"nested more than 32 levels"}},
        {R"({"a":[0,)" + std::string(1000000, '['), {"a[1][0][0]", "nested more than 32 levels"}},
    });
}

TEST(SceneReader, NamesMissingAndUnknownKeys) {
    expectRefused({
        {"[]", {"the scene is []", "object"}},
        {"{}", {"name is missing"}},
        {R"({"name":"a"})", {"duration is missing", "number above 0"}},
        {R"({"name":"a","duration":1})", {"gravity is missing", "three numbers"}},
        {R"({"name":"a","duration":1,"gravity":[0,0,0]})", {"bodies is missing"}},
        {sceneText(R"(,"colour":1)"), {"the scene has the unknown key \"colour\"", "duration", "springs"}},
        {ball(R"("colour":"red")"), {"bodies[3] has the unknown key \"colour\"", "linear_velocity"}},
        {sceneWithBody("{}"), {"bodies[3].shape is missing"}},
        {sceneWithBody("7"), {"bodies[3] is 7", "object"}},
        {sceneWithBody(R"({"shape":{"type":"sphere","radius":1}})"), {"bodies[3].material is missing"}},
        {shape(R"({"type":"sphere"})"), {"bodies[3].shape.radius is missing"}},
        {shape(R"({"type":"sphere","radius":1,"size":2})"), {"bodies[3].shape has the unknown key \"size\""}},
        {shape(R"({"radius":1})"), {"bodies[3].shape.type is missing", "capsule"}},
        {shape(R"({"type":"plane","normal":[0,0,1]})"), {"bodies[3].shape.offset is missing"}},
        {replaced(sceneText(), R"("density":800)", R"("density":800,"colour":1)"),
         {"materials.oak has the unknown key"}},
        {replaced(sceneText(), R"({"density":800})", "{}"), {"materials.oak.density is missing"}},
        {event(R"("gravity":[0,0,0])"), {"events[0].time is missing"}},
        {event(R"("time":1,"jump":1)"), {"events[0] has the unknown key \"jump\""}},
        {spring(R"("a":1)"), {"springs[0].stiffness is missing"}},
        {spring(R"("a":1,"stiffness":1,"colour":1)"), {"springs[0] has the unknown key"}},
        {settings(R"("colour":1)"), {"settings.colour", "colour"}},
    });
}

TEST(SceneReader, RefusesNumbersThatMeanNothing) {
    expectRefused({
        {replaced(sceneText(), R"("duration":2)", R"("duration":0)"), {"duration is 0;", "above 0"}},
        {replaced(sceneText(), R"("duration":2)", R"("duration":-1)"), {"duration is -1;"}},
        {replaced(sceneText(), R"("duration":2)", R"("duration":"2")"), {"duration is \"2\";", "number"}},
        {replaced(sceneText(), "[0,0,-10]", "[0,0]"), {"gravity is [0,0];", "three numbers"}},
        {replaced(sceneText(), "[0,0,-10]", "[0,null,0]"), {"gravity[1] is null;", "number"}},
        {replaced(sceneText(), R"("test")", R"("")"), {"name is \"\"", "not empty"}},
        {replaced(sceneText(), "800", "0"), {"materials.oak.density is 0;", "above 0"}},
        {replaced(sceneText(), "800", "-5"), {"materials.oak.density is -5;"}},
        {replaced(sceneText(), "800", "1e-320"), {"bodies[2] has a mass of", "neither 0 nor infinite"}},
        {shape(R"({"type":"sphere","radius":0})"), {"bodies[3].shape.radius is 0;", "above 0"}},
        {shape(R"({"type":"sphere","radius":1e200})"), {"bodies[3] has a mass of inf kg"}},
        {shape(R"({"type":"box","size":[1,0,1]})"), {"bodies[3].shape.size is [1,0,1];", "above 0"}},
        {shape(R"({"type":"box","size":1})"), {"bodies[3].shape.size is 1;", "three numbers"}},
        {shape(R"({"type":"capsule","radius":1,"length":-1})"), {"bodies[3].shape.length is -1;"}},
        {shape(R"({"type":"capsule","radius":0,"length":1})"), {"bodies[3].shape.radius is 0;"}},
        {shape(R"({"type":"plane","normal":[0,0,0],"offset":0})"), {"bodies[3].shape.normal is [0,0,0];"}},
        {shape(R"({"type":"cylinder","radius":1})"), {"bodies[3].shape.length is missing"}},
        {shape(R"({"type":"cone"})"),
         {"bodies[3].shape.type is \"cone\";",
          "sphere, box, capsule, cylinder, hull, compound, solid, plane, mesh or height_field"}},
        {ball(R"("mass":0)"), {"bodies[3].mass is 0;", "above 0"}},
        {ball(R"("mass":-2)"), {"bodies[3].mass is -2;"}},
        {ball(R"("mass":1e-310)"), {"bodies[3] has a mass of"}},
        {ball(R"("position":[1,2,"3"])"), {"bodies[3].position[2] is \"3\";"}},
        {ball(R"("orientation":[0,0,0,0])"), {"bodies[3].orientation is [0,0,0,0];", "normalised"}},
        {ball(R"("orientation":[1e200,0,0,0])"), {"bodies[3].orientation is [1e+200,0,0,0];", "normalised"}},
        {ball(R"("orientation":[1,0,0])"), {"bodies[3].orientation is [1,0,0];", "w, x, y, z"}},
        {ball(R"("fixed":1)"), {"bodies[3].fixed is 1;", "true or false"}},
        {ball(R"("name":"")"), {"bodies[3].name is \"\";", "not empty"}},
        {event(R"("time":-1,"gravity":[0,0,0])"), {"events[0].time is -1;", "0 or above"}},
        {spring(R"("a":1,"stiffness":-1)"), {"springs[0].stiffness is -1;"}},
        {spring(R"("a":1,"stiffness":1,"damping":-1)"), {"springs[0].damping is -1;"}},
        {spring(R"("a":1,"stiffness":1,"rest_length":-1)"), {"springs[0].rest_length is -1;"}},
    });
}

TEST(SceneReader, RefusesUnknownMaterialsAndBadPairs) {
    expectRefused({
        {sceneWithBody(R"({"shape":{"type":"sphere","radius":1},"material":"cheese"})"),
         {"bodies[3].material is the unknown material 'cheese'", "iron, oak"}},
        {contacts(R"("oak/cheese":{})"), {"contacts[\"oak/cheese\"] names the unknown material 'cheese'", "iron, oak"}},
        {contacts(R"("oak":{})"), {"contacts.oak is no pair"}},
        {contacts(R"("oak/iron":{},"iron/oak":{})"), {"contacts[\"iron/oak\"]", "given before"}},
        {contacts(R"("default":{"friction":1})"), {"contacts.default has the unknown key \"friction\""}},
        {contacts(R"("default":{"restitution":1.5})"), {"contacts.default.restitution is 1.5;", "0 and 1"}},
        {contacts(R"("default":{"restitution":-0.5})"), {"contacts.default.restitution is -0.5;"}},
        {contacts(R"("default":{"static_friction":-1})"), {"contacts.default.static_friction is -1;"}},
        {contacts(R"("default":{"rolling_friction":-1})"), {"contacts.default.rolling_friction is -1;"}},
        {contacts(R"("default":{"spinning_friction":-1})"), {"contacts.default.spinning_friction is -1;"}},
        {contacts(R"("oak/iron":{"static_friction":0.1,"kinetic_friction":0.15})"),
         {"contacts[\"oak/iron\"]", "kinetic_friction 0.15 above static_friction 0.1"}},
        {contacts(R"("oak/iron":{"static_friction":0.1})"), {"kinetic_friction 0.2", "default pair"}},
        {replaced(sceneText(), R"("iron":{)", R"("ir/on":{)"), {"materials[\"ir/on\"]", "'/'"}},
        {replaced(sceneText(), R"("iron":{)", R"("":{)"), {"materials[\"\"]", "without a name"}},
    });
}

TEST(SceneReader, RefusesBodiesThatContradictThemselves) {
    expectRefused({
        {shape(R"({"type":"plane","normal":[0,0,1],"offset":0})"), {"bodies[3] is a plane that is not fixed"}},
        {sceneWithBody(R"({"shape":{"type":"plane","normal":[0,0,1],"offset":0},"material":"oak","fixed":true,
                           "mass":1})"),
         {"bodies[3] is a plane with a mass"}},
        {ball(R"("asleep":true,"linear_velocity":[0,0,1])"), {"bodies[3] is asleep and has a velocity"}},
        {ball(R"("asleep":true,"angular_velocity":[0,0,1])"), {"bodies[3] is asleep and has a velocity"}},
        {ball(R"("fixed":true,"linear_velocity":[0,0,1])"), {"bodies[3] is fixed and has a velocity"}},
        {ball(R"("fixed":true,"asleep":true)"), {"bodies[3] is fixed and asleep"}},
        {ball(R"("name":"ball")"), {"bodies[3].name is 'ball' as that of bodies[1]", "unique"}},
    });
}

TEST(SceneReader, RefusesBadEvents) {
    const std::string rule = "exactly one of";
    expectRefused({
        {event(R"("time":1)"), {"events[0] has no action", rule}},
        {event(R"("time":1,"body":1)"), {"events[0] has no action", rule}},
        {event(R"("time":1,"body":1,"force":[1,0,0],"torque":[1,0,0])"), {"force and torque", rule}},
        {event(R"("time":1,"gravity":[0,0,0],"body":1)"), {"events[0] has gravity and body", rule}},
        {event(R"("time":1,"gravity":[0,0,0],"body":1,"remove":true)"), {"gravity and remove", rule}},
        {event(R"("time":1,"impulse":[0,0,0])"), {"events[0] has impulse without body", rule}},
        {event(R"("time":1,"body":1,"remove":false)"), {"events[0] has remove false"}},
        {event(R"("time":1,"body":3,"remove":true)"), {"events[0].body is 3", "indices 0 to 2"}},
        {event(R"("time":1,"body":-1,"remove":true)"), {"events[0].body is -1"}},
        {event(R"("time":1,"body":1.5,"remove":true)"), {"events[0].body is 1.5", "index or the name"}},
        {event(R"("time":1,"body":"bell","remove":true)"), {"events[0].body names the unknown body \"bell\""}},
        {event(R"("time":1,"body":0,"force":[0,0,1])"), {"events[0].body is body 0, which is fixed", "force"}},
        {sceneText(R"(,"events":[{"time":2,"body":"ball","impulse":[0,0,1]},{"time":1,"body":1,"remove":true}])"),
         {"events[0].body is body 1 'ball', which events[1] removed at 1 s"}},
        {sceneText(R"(,"events":[{"time":1,"body":1,"remove":true},{"time":1,"body":1,"remove":true}])"),
         {"events[1].body is body 1 'ball', which events[0] removed"}},
        {sceneText(R"(,"events":{})"), {"events is {}", "array"}},
        {R"({"name":"a","duration":1,"gravity":[0,0,0],"bodies":[],"events":[{"time":0,"body":0,"remove":true}]})",
         {"events[0].body is 0", "no bodies"}},
    });
}

TEST(SceneReader, AcceptsEventsUpToARemoval) {
    const std::string text =
        sceneText(R"(,"events":[{"time":1,"body":1,"remove":true},{"time":0.5,"body":1,"impulse":[0,0,1]}])");
    EXPECT_EQ(parseMessage(text), "");
}

TEST(SceneReader, RefusesBadSpringsAndSettings) {
    expectRefused({
        {spring(R"("a":7,"stiffness":1)"), {"springs[0].a is 7", "0 to 2"}},
        {spring(R"("a":1,"b":"bell","stiffness":1)"), {"springs[0].b names the unknown body \"bell\""}},
        {spring(R"("a":1,"b":1,"stiffness":1)"), {"springs[0].b is the same body"}},
        {spring(R"("a":0,"stiffness":1)"), {"springs[0] joins nothing that can move"}},
        {settings(R"("preset":"fast")"),
         {"settings.preset is \"fast\";", "one of performance, accuracy, thesis, thesis_accuracy"}},
        {settings(R"("sleep_threshold":-1)"), {"settings.sleep_threshold", "-1"}},
        {settings(R"("sleeping":"no")"), {"settings.sleeping"}},
        {settings(R"("correction":"magic")"), {"settings.correction", "magic", "propagated"}},
        {settings(R"("threads":[1])"), {"settings.threads is [1]"}},
        {sceneText(R"(,"settings":[])"), {"settings is []", "object"}},
    });
}

TEST(SceneReader, ShortensLongValuesInMessages) {
    const std::string message = parseMessage(R"({"name":[")" + std::string(10000, 'x') + R"("]})");
    EXPECT_LT(message.size(), 300U);
    EXPECT_NE(message.find("..."), std::string::npos);
}

TEST(SceneReader, NeverCrashesOnATruncatedFile) {
    const std::string text = formatScene(builtInScene("stacks5"));
    for (std::size_t length = 0; length + 2 < text.size(); length += 50) {
        EXPECT_FALSE(parseMessage(std::string_view(text).substr(0, length)).empty()) << length;
    }
}

TEST(SceneReader, NeverCrashesOnAChangedByte) {
    const std::string good = sceneText(R"(,"events":[{"time":1,"body":1,"remove":true}])");
    int refused = 0;
    for (std::size_t i = 0; i < good.size(); ++i) {
        for (const char c : {'"', '}', '-', '\\', '9', '\xe2'}) {
            std::string text = good;
            text[i] = c;
            if (!parseMessage(text).empty()) ++refused;
        }
    }
    EXPECT_GT(refused, 0);
}

TEST(SceneReader, SaysWhichFileCannotBeRead) {
    try {
        readScene("no/such/scene.json");
        FAIL() << "read a file that does not exist";
    } catch (const IoError& error) {
        EXPECT_NE(std::string(error.what()).find("no/such/scene.json"), std::string::npos);
    }
    EXPECT_THROW(readScene(std::filesystem::temp_directory_path()), IoError);
}

}  // namespace
}  // namespace cairn
