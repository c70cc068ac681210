/// What a scene gives once and uses often: shapes, templates, groups and other files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "scene_testing.h"
#include "temporary_folder.h"

namespace cairn {
namespace {

using testing::messageOf;
using testing::parseMessage;

std::string scene(const std::string& rest) {
    return R"({"name":"t","duration":1,"gravity":[0,0,-10],"materials":{"oak":{"density":800},"iron":{"density":7874}},)" +
           rest + "}";
}

constexpr const char* stone = R"("shapes":{"stone":{"type":"hull","points":[[1,0,0],[0,1,0],[0,0,1],[0,0,0]]}},)";

TEST(SceneTemplates, BodiesShareAShapeAndTakeWhatTheyDoNotGive) {
    const Scene read = parseScene(scene(std::string(stone) + R"("bodies":[
        {"template":"pebble","position":[0,0,1]},
        {"template":"pebble","name":"slow","material":"iron","linear_velocity":[0,0,0],"groups":["b"]}],
        "filters":{"groups":["a","b"]},
        "templates":{"pebble":{"shape":"stone","material":"oak","linear_velocity":[1,2,3],"groups":["a"]}})"),
                                  "t.json");
    ASSERT_EQ(read.bodies.size(), 2U);
    EXPECT_EQ(&std::get<ConvexHull>(read.bodies[0].shape).data(), &std::get<ConvexHull>(read.bodies[1].shape).data());
    EXPECT_EQ(read.bodies[0].linear_velocity, Vec3(1, 2, 3));
    EXPECT_EQ(read.bodies[0].material, "oak");
    EXPECT_EQ(read.bodies[1].linear_velocity, Vec3::Zero());
    EXPECT_EQ(read.bodies[1].material, "iron");
    EXPECT_EQ(read.bodies[1].groups, std::vector<std::string>{"b"});
}

TEST(SceneTemplates, WritingGivesASharedShapeOnce) {
    const Scene read = parseScene(scene(std::string(stone) + R"("bodies":[
        {"shape":"stone","material":"oak"},{"shape":"stone","material":"oak"},
        {"shape":{"type":"sphere","radius":1},"material":"oak"}])"),
                                  "t.json");
    const std::string text = formatScene(read);
    EXPECT_EQ(text.find("points"), text.rfind("points")) << text;
    EXPECT_EQ(formatScene(parseScene(text, "written")), text);
}

TEST(SceneTemplates, AGroupIsPlacedWithItsJointsAndNames) {
    const Scene read = parseScene(scene(R"("bodies":[{"shape":{"type":"sphere","radius":0.1},"material":"oak"}],
        "templates":{"pair":{"bodies":[
            {"shape":{"type":"sphere","radius":0.1},"material":"oak","name":"a","linear_velocity":[1,0,0]},
            {"shape":{"type":"sphere","radius":0.1},"material":"oak","name":"b","position":[1,0,0]}],
          "joints":[{"type":"hinge","a":"a","b":"b","anchor":[0.5,0,0],"axis":[1,0,0],"motor":{"speed":1,"limit":1}}],
          "drives":[{"joint":0,"speed":{"type":"constant","rate":2}}]}},
        "includes":[{"template":"pair","name":"left"},
                    {"template":"pair","name":"right","position":[0,0,5],"orientation":[1,0,0,1]}],
        "springs":[{"a":"left/a","b":"right/b","stiffness":1}])"),
                                  "t.json");
    ASSERT_EQ(read.bodies.size(), 5U);
    EXPECT_EQ(read.bodies[4].name, "right/b");
    EXPECT_TRUE(read.bodies[4].position.isApprox(Vec3(0, 1, 5), 1e-12));
    EXPECT_TRUE(read.bodies[3].linear_velocity.isApprox(Vec3(0, 1, 0), 1e-12));
    EXPECT_EQ(read.springs[0].a, 1U);
    EXPECT_EQ(read.springs[0].b, 4U);
    ASSERT_EQ(read.joints.size(), 2U);
    EXPECT_EQ(read.joints[1].a, 3U);
    EXPECT_TRUE(read.joints[1].joint.anchor.isApprox(Vec3(0, 0.5, 5), 1e-12));
    EXPECT_TRUE(read.joints[1].joint.axis.isApprox(Vec3(0, 1, 0), 1e-12));
    ASSERT_EQ(read.drives.size(), 2U);
    EXPECT_EQ(read.drives[1].target, 1U);
    SceneRun run(read, settingsFor(read));
    for (int i = 0; i < 30; ++i) run.simulationStep();
    EXPECT_TRUE(run.world().faults().empty());
}

TEST(SceneTemplates, SaysWhatIsWrong) {
    const auto message = [](const std::string& rest) { return parseMessage(scene(rest)); };
    EXPECT_EQ(message(R"("bodies":[{"shape":"stone","material":"oak"}])"),
              "test.json: bodies[0].shape is the unknown shape \"stone\"; 'shapes' lists none");
    EXPECT_EQ(message(R"("templates":{"t":{"material":"oak"}},"bodies":[{"template":"t"}])"),
              "test.json: bodies[0].shape is missing; it must be an object, or the name of a shape");
    EXPECT_EQ(
        message(R"("templates":{"t":{"bodies":[]}},"bodies":[{"template":"t"}])"),
        "test.json: bodies[0].template is a template of a group; 'includes' places it, a body needs that of a body");
    EXPECT_EQ(message(R"("templates":{"t":{"shape":{"type":"box","size":[1,1,0]}}},"bodies":[])"),
              "test.json: templates.t.shape.size is [1,1,0]; it must be three numbers above 0: the full edge lengths "
              "[m]");
    EXPECT_NE(message(R"("templates":{"g":{"bodies":[
        {"shape":{"type":"sphere","radius":1},"material":"oak","name":"a"}]}},
        "bodies":[],"includes":[{"template":"g"},{"template":"g"}])")
                  .find("includes[1] brings a body 'a', whose name another body has"),
              std::string::npos);
    EXPECT_NE(message(R"("templates":{"g":{"bodies":[
        {"shape":{"type":"sphere","radius":1},"material":"oak","locked":["x"]}]}},
        "bodies":[],"includes":[{"template":"g","orientation":[1,0,0,1]}])")
                  .find("includes[0] turns a body with locked axes"),
              std::string::npos);
}

class SceneIncludes : public ::testing::Test {
  protected:
    void SetUp() override { std::filesystem::create_directories(folder_ / "parts"); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return (folder_ / name).string();
    }
    std::string message(const std::string& file) const {
        return messageOf([&] { readScene(file); });
    }

    test::TemporaryFolder folder_;
};

TEST_F(SceneIncludes, TakeBodiesMaterialsAndContactsOfAnotherFile) {
    write("parts/arch.json", R"({"name":"arch","duration":1,"gravity":[0,0,0],"materials":{"lime":{"density":2000}},
        "contacts":{"lime/lime":{"static_friction":0.7}},"filters":{"groups":["stones"]},
        "bodies":[{"shape":{"type":"sphere","radius":1},"material":"lime","name":"key","groups":["stones"]}]})");
    const Scene read =
        readScene(write("main.json", scene(R"("bodies":[],"includes":[{"file":"parts/arch.json","name":"n"},
                              {"file":"parts/arch.json","name":"s","position":[0,0,9]}])")));
    ASSERT_EQ(read.bodies.size(), 2U);
    EXPECT_EQ(read.bodies[1].name, "s/key");
    EXPECT_EQ(read.bodies[1].position, Vec3(0, 0, 9));
    EXPECT_EQ(read.materials.size(), 3U);
    ASSERT_EQ(read.pairs.size(), 1U);
    EXPECT_EQ(read.pairs[0].second.static_friction, 0.7);
    EXPECT_EQ(read.filters.groups, std::vector<std::string>{"stones"});
    EXPECT_EQ(read.gravity, Vec3(0, 0, -10)) << "of the including scene";
}

TEST_F(SceneIncludes, NameTheFileAndThePathOfAnError) {
    const std::string part =
        write("part.json", scene(R"("bodies":[{"shape":{"type":"sphere","radius":0},"material":"oak"}])"));
    const std::string file = write("main.json", scene(R"("bodies":[],"includes":[{"file":"part.json"}])"));
    EXPECT_EQ(message(file), part + ": bodies[0].shape.radius is 0; it must be a number above 0");
    write("part.json", R"({"name":"p","duration":1,"gravity":[0,0,0],"materials":{"oak":{"density":1}},"bodies":[]})");
    EXPECT_NE(message(file).find("includes[0].file has a material 'oak' of 1 kg/m³"), std::string::npos)
        << message(file);
    write("part.json", scene(R"("bodies":[],"events":[{"time":0,"gravity":[0,0,0]}])"));
    EXPECT_NE(message(file).find("includes[0].file has events"), std::string::npos);
    write("part.json", scene(R"("bodies":[],"includes":[{"file":"main.json"}])"));
    EXPECT_NE(message(file).find("includes itself"), std::string::npos) << message(file);
    std::filesystem::remove(folder_ / "part.json");
    EXPECT_NE(message(file).find("includes[0].file names a file that fails"), std::string::npos);
}

TEST(SceneStreaming, BodiesAreReadWhereverTheyStandAndErrorsSayWhere) {
    const std::string ball = R"({"shape":{"type":"sphere","radius":1},"material":"oak"})";
    const std::string head = "{\"bodies\":[\n" + ball + ",\n";
    const std::string tail = R"(],"name":"t","duration":1,"gravity":[0,0,0],"materials":{"oak":{"density":1}}})";
    EXPECT_EQ(parseScene(head + ball + tail, "t").bodies.size(), 2U);
    EXPECT_NE(parseMessage(head + R"({"shape":{"type":"sphere",}})" + tail).find("test.json:3:27:"), std::string::npos)
        << parseMessage(head + R"({"shape":{"type":"sphere",}})" + tail);
    EXPECT_NE(parseMessage(head + tail).find("test.json:3:1: syntax error"), std::string::npos)
        << "nothing after a comma: " << parseMessage(head + tail);
    EXPECT_NE(parseMessage(head + ball + ball + tail).find("test.json:3:"), std::string::npos) << "no comma";
    EXPECT_NE(parseMessage(head + R"({"mass":1,"mass":2})" + tail).find("bodies[1].mass is given twice"),
              std::string::npos);
    EXPECT_NE(parseMessage(head + ball + tail + "}").find("test.json:3:"), std::string::npos) << "one brace too many";
    std::string deep = ball;
    for (int i = 0; i < 40; ++i) deep = "[" + deep + "]";
    EXPECT_NE(parseMessage(head + deep + tail).find("is nested more than 32 levels deep"), std::string::npos);
}

}  // namespace
}  // namespace cairn
