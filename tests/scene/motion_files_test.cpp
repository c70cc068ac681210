/// Motions from files, locked axes and pair laws in scene files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene_testing.h"
#include "temporary_folder.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using testing::parseMessage;
using testing::sceneText;
using testing::sceneWithBody;

/// A scene in a folder of its own, with a table beside it.
class MotionFiles : public ::testing::Test {
  protected:
    void write(const std::string& table) const { std::ofstream(folder_ / "table.csv") << table; }
    Scene read(const std::string& motion) const {
        const std::string body =
            R"({"shape":{"type":"sphere","radius":1},"material":"oak","fixed":true,"motion":)" + motion + "}";
        return parseScene(sceneWithBody(body), (folder_ / "scene.json").string());
    }
    std::string message(const std::string& motion) const {
        try {
            read(motion);
        } catch (const std::exception& error) {
            return error.what();
        }
        return "";
    }
    static const TableMotion& tableOf(const Scene& scene) { return std::get<TableMotion>(*scene.bodies.back().motion); }

    test::TemporaryFolder folder_;
};

TEST_F(MotionFiles, HoldTimesDisplacementsAndTurns) {
    write("time,x,y,z,rx,ry,rz\n# a remark\n0,0,0,0,0,0,0\n\n0.5; 1; 2; -3e-1; 0; 0; +0.25\r\n2\t4 5 6 7 8 9\n");
    const Scene scene = read(R"({"type":"table","file":"table.csv"})");
    const TableMotion& motion = tableOf(scene);
    EXPECT_EQ(motion.times, (std::vector<double>{0, 0.5, 2}));
    EXPECT_EQ(motion.displacements.at(1), Vec3(1, 2, -0.3));
    EXPECT_EQ(motion.turns.at(1), Vec3(0, 0, 0.25));
    EXPECT_EQ(tableOf(parseScene(formatScene(scene), "test")).times, motion.times) << "written as numbers";
}

TEST_F(MotionFiles, HoldAccelerograms) {
    write("1 0 0\n1 0 0\n1 0 0\n");
    const Scene scene = read(R"({"type":"table","interval":0.5,"file":"table.csv"})");
    EXPECT_NEAR(tableOf(scene).displacements.back().x(), 0.5, 1e-12) << "½·a·t²";
}

TEST_F(MotionFiles, RefuseWhatIsNoTable) {
    const auto expect = [&](const std::string& table, const std::string& part) {
        write(table);
        const std::string found = message(R"({"type":"table","file":"table.csv"})");
        EXPECT_NE(found.find(part), std::string::npos) << found;
    };
    expect("0,0,0,0\n1,a,0,0\n", "in line 2");
    expect("0,0,0,0\n1,0,0\n", "3 numbers in line 2");
    expect("0,0\n1,0\n", "four columns");
    expect("0,0,0,0\n", "fewer than two lines");
    expect("0,0,0,0\n0,0,0,0\n", "is not allowed");
    expect("1,0,0,0\nnan,0,0,0\n", "is not allowed");
    EXPECT_NE(message(R"({"type":"table","file":"none.csv"})").find("no file that can be read"), std::string::npos);
    EXPECT_NE(message(R"({"type":"table","file":"."})").find("no file that can be read"), std::string::npos);
    EXPECT_NE(message(R"({"type":"table","file":"table.csv","times":[0]})").find("unknown key"), std::string::npos);
}

TEST(SceneOwnProperties, LockedAxesAreWrittenAndRead) {
    const std::string head = R"({"shape":{"type":"sphere","radius":1},"material":"oak",)";
    const Scene scene = parseScene(sceneWithBody(head + R"("locked":["turn_x","y"]})"), "test");
    EXPECT_EQ(scene.bodies.back().locked, (std::vector<JointAlong>{JointAlong::turn_x, JointAlong::y}));
    EXPECT_EQ(parseScene(formatScene(scene), "test").bodies.back().locked, scene.bodies.back().locked);
    const SceneRun run(scene, settingsFor(scene));
    EXPECT_EQ(run.world().locked(run.ids().back()), (std::vector<JointAlong>{JointAlong::y, JointAlong::turn_x}));
    EXPECT_NE(parseMessage(sceneWithBody(head + R"("locked":["w"]})")).find("x, y, z"), std::string::npos);
    EXPECT_NE(parseMessage(sceneWithBody(head + R"("locked":["x","x"]})")).find("given twice"), std::string::npos);
    EXPECT_NE(parseMessage(sceneWithBody(head + R"("fixed":true,"locked":["x"]})")).find("fixed body"),
              std::string::npos);
}

TEST(ScenePairLaws, AreWrittenAndRead) {
    const std::string head =
        R"({"name":"a","duration":1,"gravity":[0,0,0],"materials":{"oak":{"density":800}},"bodies":[],"contacts":)";
    const std::string law = R"({"friction":{"speeds":[0,0.5],"values":[0.6,0.25]}})";
    const Scene scene = parseScene(head + R"({"oak/oak":{"law":)" + law + "}}}", "test");
    ASSERT_EQ(scene.pair_laws.size(), 1U);
    EXPECT_EQ(scene.pair_laws[0].second.friction.values, (std::vector<double>{0.6, 0.25}));
    EXPECT_EQ(formatScene(parseScene(formatScene(scene), "test")), formatScene(scene));
    const SceneRun run(scene, settingsFor(scene));
    EXPECT_EQ(run.world().pairLaw(MaterialId{0}, MaterialId{0}).friction.speeds.size(), 2U);
    EXPECT_NE(parseMessage(head + R"({"default":{"law":)" + law + "}}}").find("of no pair"), std::string::npos);
    const std::string wrong = R"({"friction":{"speeds":[1,0.5],"values":[0.6,0.25]}})";
    EXPECT_NE(parseMessage(head + R"({"oak/oak":{"law":)" + wrong + "}}}").find("ascending"), std::string::npos);
}

}  // namespace
}  // namespace cairn
