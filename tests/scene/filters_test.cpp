/// Groups, exceptions, sensors and what bodies feel of their own in scene files.
#include <gtest/gtest.h>

#include <fstream>

#include "scene_testing.h"

namespace cairn {
namespace {

using testing::parseMessage;

/// @param filters, body JSON of `filters` and of more members of the second body
std::string filteredScene(const std::string& filters, const std::string& body) {
    return R"({"name":"a","duration":1,"gravity":[0,0,-10],"materials":{"oak":{"density":800}},"filters":)" + filters +
           R"(,"bodies":[{"shape":{"type":"plane","normal":[0,0,1],"offset":0},"material":"oak","fixed":true,)"
           R"("groups":["ground"]},{"shape":{"type":"sphere","radius":0.1},"material":"oak","name":"ball",)"
           R"("position":[0,0,1])" +
           body + "}]}";
}

constexpr const char* two_groups =
    R"({"groups":["ground","ghosts"],"apart":[["ghosts","ground"]],"exceptions":[{"a":0,"b":"ball","touch":true}]})";

TEST(SceneFilters, AreReadWrittenAndApplied) {
    const std::string own =
        R"(,"groups":["ghosts"],"gravity_factor":0.5,"linear_damping":1,"angular_damping":2,"user_data":18446744073709551615)";
    const Scene scene = parseScene(filteredScene(two_groups, own), "test");
    ASSERT_EQ(scene.filters.apart.size(), 1U);
    EXPECT_EQ(scene.filters.exceptions[0].touch, Touch::always);
    const std::string text = formatScene(scene);
    EXPECT_EQ(formatScene(parseScene(text, "written")), text);
    const SceneRun run(scene, settingsFor(scene));
    const World& world = run.world();
    const BodyId ball = run.ids()[1];
    EXPECT_EQ(world.groupNames().size(), 2U);
    EXPECT_EQ(world.groups(ball), std::vector<GroupId>{static_cast<GroupId>(1)});
    EXPECT_EQ(world.groupsTouch(static_cast<GroupId>(0), static_cast<GroupId>(1)), Touch::never);
    EXPECT_EQ(world.pairTouch(run.ids()[0], ball), Touch::always);
    EXPECT_EQ(world.gravityFactor(ball), 0.5);
    EXPECT_EQ(world.linearDamping(ball), 1);
    EXPECT_EQ(world.angularDamping(ball), 2);
    EXPECT_EQ(world.userData(ball), UINT64_MAX);
}

TEST(SceneFilters, SensorsTellWhoIsInside) {
    const Scene scene = parseScene(filteredScene(two_groups, R"(,"sensor":true,"fixed":true)"), "test");
    EXPECT_EQ(formatScene(parseScene(formatScene(scene), "written")), formatScene(scene));
    const SceneRun run(scene, settingsFor(scene));
    EXPECT_TRUE(run.world().isSensor(run.ids()[1]));
}

TEST(SceneFilters, RefuseUnknownNamesAndRepetitions) {
    const auto message = [](const std::string& filters, const std::string& body = "") {
        return parseMessage(filteredScene(filters, body));
    };
    EXPECT_NE(message(R"({"groups":["other"]})").find("unknown group 'ground'; known are other"), std::string::npos);
    EXPECT_NE(message(R"({"groups":["ground","ground"]})").find("filters.groups[1]"), std::string::npos);
    EXPECT_NE(message(R"({"groups":["ground"],"apart":[["ground","air"]]})").find("filters.apart[0][1]"),
              std::string::npos);
    EXPECT_NE(message(R"({"groups":["ground","a"],"apart":[["ground","a"],["a","ground"]]})").find("given before"),
              std::string::npos);
    EXPECT_NE(message(R"({"groups":["ground"],"exceptions":[{"a":1,"b":"ball","touch":true}]})").find("one body twice"),
              std::string::npos);
    EXPECT_NE(message(R"({"groups":["ground"]})", R"(,"gravity_factor":1e4)").find("bodies[1].gravity_factor"),
              std::string::npos);
    EXPECT_NE(message(R"({"groups":["ground"]})", R"(,"linear_damping":-1)").find("bodies[1].linear_damping"),
              std::string::npos);
    EXPECT_NE(message(R"({"groups":["ground"]})", R"(,"user_data":-1)").find("whole number"), std::string::npos);
    std::string many = R"({"groups":["ground")";
    for (int i = 0; i < 64; ++i) many += ",\"g" + std::to_string(i) + "\"";
    EXPECT_NE(message(many + "]}").find("at most 64 groups"), std::string::npos);
}

}  // namespace
}  // namespace cairn
