/// Servos, motors and forces that follow functions of time.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "scene_testing.h"

namespace cairn {
namespace {

using testing::parseMessage;

/// A rod on a hinge about y through the origin.
std::string scene(const std::string& axis, const std::string& drives) {
    return R"({"name":"d","duration":2,"gravity":[0,0,0],"materials":{"oak":{"density":800}},"bodies":[
        {"shape":{"type":"box","size":[1,0.1,0.1]},"material":"oak","name":"rod","position":[0.5,0,0]}],
        "joints":[{"type":"hinge","a":"rod","anchor":[0,0,0],"axis":[0,1,0],)" +
           axis + R"(}],"drives":)" + drives + "}";
}

constexpr const char* servo = R"("servo":{"stiffness":1e9,"damping":1e7})";

double angleAfter(SceneRun& run, double seconds) {
    while (run.world().time() < seconds - 1e-9) run.step();
    return run.world().joint(run.world().joints().front()).position;
}

TEST(SceneDrives, AServoFollowsATable) {
    const Scene read = parseScene(
        scene(servo, R"([{"joint":0,"position":{"type":"table","times":[0,1,2],"values":[0,0.5,0.2]}}])"), "d");
    SceneRun run(read, settingsFor(read));
    EXPECT_NEAR(angleAfter(run, 1), 0.5, 1e-3);
    EXPECT_NEAR(angleAfter(run, 2), 0.2, 1e-3);
}

TEST(SceneDrives, AMotorsSpeedFollowsASine) {
    const Scene read =
        parseScene(scene(R"("motor":{"speed":0,"limit":1e9})",
                         R"([{"joint":0,"speed":{"type":"sine","start":0,"amplitude":1,"frequency":0.5}}])"),
                   "d");
    SceneRun run(read, settingsFor(read));
    // The integral of sin(πt) over a second.
    EXPECT_NEAR(angleAfter(run, 1), 2 / std::numbers::pi, 0.01);
}

TEST(SceneDrives, AForceThatGrowsGivesItsIntegral) {
    const std::string text = R"({"name":"d","duration":1,"gravity":[0,0,0],"materials":{"oak":{"density":1000}},
        "bodies":[{"shape":{"type":"box","size":[1,1,1]},"material":"oak","name":"block"}],
        "drives":[{"body":"block","force":{"type":"constant","start":[0,0,0],"rate":[1000,0,0]}}]})";
    const Scene read = parseScene(text, "d");
    SceneRun run(read, settingsFor(read));
    for (int i = 0; i < 30; ++i) run.simulationStep();
    EXPECT_NEAR(run.world().linearVelocity(run.ids()[0]).x(), 0.5, 1e-9);
}

TEST(SceneDrives, GoOnAfterASnapshotAndAreWrittenAgain) {
    const Scene read = parseScene(
        scene(servo, R"([{"joint":0,"position":{"type":"table","times":[0,1,2],"values":[0,0.5,0.2]}}])"), "d");
    SceneRun run(read, settingsFor(read));
    angleAfter(run, 0.7);
    SceneRun restored = SceneRun::restore(run.save());
    EXPECT_EQ(angleAfter(run, 2), angleAfter(restored, 2));
    const std::string text = formatScene(read);
    EXPECT_EQ(formatScene(parseScene(text, "written")), text);
    for (const char* function : {R"({"type":"sine","start":1,"amplitude":2,"frequency":3,"phase":0.5})",
                                 R"({"type":"constant","start":1,"rate":2})"}) {
        const std::string once =
            formatScene(parseScene(scene(servo, std::string(R"([{"joint":0,"position":)") + function + "}]"), "d"));
        EXPECT_NE(once.find(function), std::string::npos) << once;
    }
}

TEST(SceneDrives, SayWhatIsWrong) {
    const auto message = [](const std::string& drive) { return parseMessage(scene(servo, "[" + drive + "]")); };
    EXPECT_NE(message(R"({"joint":1,"position":{"type":"constant","rate":1}})").find("drives[0].joint is 1"),
              std::string::npos);
    EXPECT_NE(message(R"({"joint":0,"axis":1,"position":{"type":"constant","rate":1}})").find("free axis 1"),
              std::string::npos);
    EXPECT_NE(
        message(R"({"joint":0,"position":{"type":"table","times":[1,0],"values":[0,0]}})").find("drives[0] is not"),
        std::string::npos);
    EXPECT_NE(message(R"({"joint":0,"position":{"type":"table","times":[0,1],"values":[0]}})").find("drives[0] is not"),
              std::string::npos);
    EXPECT_NE(message(R"({"joint":0})").find("drives nothing"), std::string::npos);
    EXPECT_NE(message(R"({"joint":0,"position":{"type":"constant","rate":1}},
                         {"joint":0,"speed":{"type":"constant","rate":1}})")
                  .find("drives[1] drives what another one drives"),
              std::string::npos);
    EXPECT_NE(parseMessage(scene(R"("damping":1)", R"([{"joint":0,"speed":{"type":"constant","rate":1}}])"))
                  .find("neither servo nor motor"),
              std::string::npos);
}

}  // namespace
}  // namespace cairn
