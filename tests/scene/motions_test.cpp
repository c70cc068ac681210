/// Motions by laws in scene files.
#include <gtest/gtest.h>

#include "scene_testing.h"

namespace cairn {
namespace {

using testing::parseMessage;

/// A scene of one fixed box. @param motion of the box @param rest more keys of the scene
std::string movedScene(const std::string& motion, const std::string& rest = "", const std::string& fixed = "true") {
    return R"({"name":"a","duration":1,"gravity":[0,0,-10],"materials":{"oak":{"density":800}},"bodies":[)"
           R"({"shape":{"type":"box","size":[1,1,1]},"material":"oak","fixed":)" +
           fixed + R"(,"motion":)" + motion + "}]" + rest + "}";
}

constexpr const char* constant_law = R"({"type":"constant","velocity":[1,0,0],"spin":[0,0,2],"pivot":[0.5,0,0]})";

TEST(SceneMotions, AreReadWrittenAndRun) {
    for (const std::string& motion :
         {std::string(constant_law), std::string(R"({"type":"sine","amplitude":[0,0,0.1],"frequency":2,"phase":1})"),
          std::string(R"({"type":"table","times":[0,1,2],"displacements":[[0,0,0],[1,0,0],[0,0,0]],"end":"repeat"})"),
          std::string(R"({"type":"table","times":[0,1],"turns":[[0,0,0],[0,0,1]]})"),
          std::string(R"({"type":"table","interval":0.1,"accelerations":[[0,0,0],[1,0,0],[-1,0,0],[0,0,0]]})")}) {
        const Scene scene = parseScene(movedScene(motion), "test");
        ASSERT_TRUE(scene.bodies[0].motion);
        const std::string text = formatScene(scene);
        EXPECT_EQ(formatScene(parseScene(text, "written")), text);
        SceneRun run(scene, settingsFor(scene));
        SceneRun again(parseScene(text, "written"), settingsFor(scene));
        const Pose before = run.world().pose(run.ids()[0]);
        for (int i = 0; i < 20; ++i) {
            run.step();
            again.step();
        }
        EXPECT_EQ(run.world().stateHash(), again.world().stateHash());
        EXPECT_EQ(SceneRun::restore(run.save()).world().stateHash(), run.world().stateHash());
        const Pose after = run.world().pose(run.ids()[0]);
        EXPECT_GT((after.position - before.position).norm() + after.orientation.angularDistance(before.orientation),
                  1e-4);
    }
}

TEST(SceneMotions, FramesMoveToo) {
    const Scene scene = parseScene(
        movedScene(constant_law, R"(,"frame_motion":{"type":"sine","amplitude":[0.1,0,0],"frequency":1})"), "test");
    const std::string text = formatScene(scene);
    EXPECT_EQ(formatScene(parseScene(text, "written")), text);
    EXPECT_TRUE(SceneRun(scene, settingsFor(scene)).world().frameMotion());
}

std::string gravityScene(const std::string& gravity) {
    return R"({"name":"g","duration":2,"gravity":)" + gravity +
           R"(,"materials":{"oak":{"density":800}},"bodies":[{"shape":{"type":"box","size":[1,1,1]},"material":"oak"}]})";
}

TEST(SceneMotions, GravityIsAFunctionOfTime) {
    for (const std::string& gravity :
         {std::string(R"({"type":"constant","start":[0,0,-10],"rate":[0,0,2]})"),
          std::string(R"({"type":"sine","start":[0,0,-10],"amplitude":[0,1,0],"frequency":0.5,"phase":1})"),
          std::string(R"({"type":"table","times":[0,1,2],"values":[[0,0,0],[0,0,-3],[0,0,-6]]})")}) {
        const Scene scene = parseScene(gravityScene(gravity), "test");
        ASSERT_TRUE(scene.gravity_law);
        const std::string text = formatScene(scene);
        EXPECT_NE(text.find(gravity.substr(0, 20)), std::string::npos) << text;
        EXPECT_EQ(formatScene(parseScene(text, "written")), text);
        SceneRun run(scene, settingsFor(scene));
        while (run.world().time() < 1.5 - 1e-9) run.step();
        SceneRun again = SceneRun::restore(run.save());
        for (int i = 0; i < 20; ++i) {
            run.step();
            again.step();
        }
        EXPECT_EQ(again.world().stateHash(), run.world().stateHash());
        EXPECT_NE(run.world().gravity(), scene.gravity);
    }
}

/// Thresholds follow the gravity at which a table ends, not those that it passes.
TEST(SceneMotions, ThresholdsFollowTheGravityThatLasts) {
    const auto thresholdOf = [](const std::string& gravity) {
        return settingsFor(parseScene(gravityScene(gravity), "test")).sleep.sleep_threshold;
    };
    EXPECT_EQ(thresholdOf(R"({"type":"table","times":[0,1],"values":[[0,0,-0.001],[0,0,-5]]})"),
              thresholdOf("[0,0,-5]"));
}

TEST(SceneMotions, RefuseWhatNoFunctionOfGravityIs) {
    const auto refusal = [](const std::string& gravity) { return parseMessage(gravityScene(gravity)); };
    EXPECT_NE(refusal(R"({"type":"jump"})").find("gravity.type"), std::string::npos);
    EXPECT_NE(refusal("3").find("gravity"), std::string::npos);
    EXPECT_NE(refusal(R"({"type":"table","times":[1,0],"values":[[0,0,0],[0,0,1]]})").find("ascend"),
              std::string::npos);
    Scene scene = parseScene(gravityScene("[0,0,-10]"), "test");
    scene.gravity_law = TableMotion{{0, 1}, {Vec3::Zero(), Vec3::Ones()}, {}};
    EXPECT_THROW(SceneRun(scene, settingsFor(scene)), InputError) << "it does not begin with gravity";
}

TEST(SceneMotions, RefuseWhatNoLawIs) {
    const auto refusal = [](const std::string& motion) { return parseMessage(movedScene(motion)); };
    EXPECT_NE(refusal(R"({"type":"jump"})").find("bodies[0].motion.type"), std::string::npos);
    EXPECT_NE(refusal(R"({"type":"sine"})").find("frequency is missing"), std::string::npos);
    EXPECT_NE(refusal(R"({"type":"table","times":[0,0],"displacements":[[0,0,0],[1,0,0]]})").find("ascend"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"type":"table","times":[0,1]})").find("neither displacements nor turns"), std::string::npos);
    EXPECT_NE(refusal(R"({"type":"table","interval":0.1,"accelerations":[[0,0,0]]})").find("at least two"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"type":"table","interval":0.1,"accelerations":[[0,0,0],[1,0,0]],"baseline":"odd"})")
                  .find("none or at_rest"),
              std::string::npos);
    EXPECT_NE(parseMessage(movedScene(constant_law, "", "false")).find("\"fixed\": true"), std::string::npos);
    EXPECT_NE(parseMessage(movedScene(constant_law, R"(,"frame_motion":{"type":"constant","spin":[0,0,1]})"))
                  .find("frame_motion turns"),
              std::string::npos);
}

}  // namespace
}  // namespace cairn
