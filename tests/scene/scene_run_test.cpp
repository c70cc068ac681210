#include <gtest/gtest.h>

#include <numbers>

#include "scene_testing.h"

namespace cairn {
namespace {

using testing::messageOf;
using testing::sceneText;

/// A ball of oak in free space.
Scene lonelyBall() {
    Scene scene;
    scene.name = "lonely";
    scene.duration = 1;
    scene.materials = {{"oak", 800}};
    SceneBody ball;
    ball.shape = Sphere{0.06};
    ball.material = "oak";
    ball.name = "ball";
    ball.mass = 2;
    ball.linear_velocity = {0.5, 0, 0};
    scene.bodies = {ball};
    return scene;
}

SceneRun started(const Scene& scene) {
    return SceneRun(scene, settingsFor(scene));
}

TEST(SceneRun, PutsTheBodiesIntoTheWorld) {
    const Scene scene = parseScene(sceneText(), "test");
    const SceneRun run = started(scene);
    ASSERT_EQ(run.ids().size(), 3U);
    EXPECT_EQ(run.world().bodyCount(), 3U);
    EXPECT_EQ(run.world().gravity(), Vec3(0, 0, -10));
    EXPECT_TRUE(run.world().isFixed(run.ids()[0]));
    EXPECT_EQ(run.world().name(run.ids()[1]), "ball");
    EXPECT_NEAR(run.world().mass(run.ids()[1]), 7874 * std::numbers::pi / 6, 1e-9);
    EXPECT_EQ(run.world().pose(run.ids()[1]).position, Vec3(0, 0, 5));
    EXPECT_TRUE(run.world().isAsleep(run.ids()[2]));
    EXPECT_EQ(run.world().pairProperties(MaterialId{0}, MaterialId{1}).restitution, 0.5);
}

TEST(SceneRun, RunsASceneWithoutBodies) {
    SceneRun run = started(parseScene(R"({"name":"e","duration":1,"gravity":[0,0,0],"bodies":[]})", "e"));
    run.simulationStep();
    EXPECT_EQ(run.world().stepCount(), 8);
}

TEST(SceneRun, AppliesEventsAtTheFirstStepThatBeginsAtOrAfterTheirTime) {
    // 0.1 · 240 is not exactly 24; 0.101 s lies within step 24, so that its event waits for the 25th.
    for (const auto& [time, step] :
         {std::pair(0.0, 0), std::pair(0.1, 24), std::pair(0.101, 25), std::pair(1.0 / 30, 8), std::pair(0.3, 72)}) {
        Scene scene = lonelyBall();
        scene.events = {{time, SetVelocity{0, {3, 0, 0}}}};
        SceneRun run = started(scene);
        for (int i = 0; i < step; ++i) {
            run.step();
            EXPECT_EQ(run.world().linearVelocity(run.ids()[0]).x(), 0.5) << "time " << time << " step " << i;
        }
        run.step();
        EXPECT_EQ(run.world().linearVelocity(run.ids()[0]).x(), 3) << "time " << time;
    }
}

TEST(SceneRun, AppliesEachKindOfEvent) {
    Scene scene = lonelyBall();
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].name = "other";
    scene.bodies[1].position = {0, 10, 0};
    scene.events = {{0, GiveImpulse{0, {2, 0, 0}}},
                    {0.1, SetForce{0, {0, 4, 0}}},
                    {0.1, SetTorque{0, {0, 0, 1}}},
                    {0.2, RemoveBody{1}},
                    {0.3, SetGravity{{0, 0, -10}}}};
    SceneRun run = started(scene);
    const BodyId ball = run.ids()[0];
    for (int i = 0; i < 24; ++i) run.step();
    EXPECT_NEAR(run.world().linearVelocity(ball).x(), 1.5, 1e-12) << "0.5 m/s and 2 N·s on 2 kg";
    EXPECT_EQ(run.world().linearVelocity(ball).y(), 0);
    for (int i = 0; i < 24; ++i) run.step();
    EXPECT_NEAR(run.world().linearVelocity(ball).y(), 4.0 / 2 * 0.1, 1e-12);
    EXPECT_NEAR(run.world().angularVelocity(ball).z(), 1 / (0.4 * 2 * 0.0036) * 0.1, 1e-12);
    EXPECT_TRUE(run.world().contains(run.ids()[1]));
    run.step();
    EXPECT_FALSE(run.world().contains(run.ids()[1]));
    EXPECT_TRUE(run.world().contains(ball));
    for (int i = 0; i < 23; ++i) run.step();
    EXPECT_EQ(run.world().linearVelocity(ball).z(), 0);
    run.step();
    EXPECT_LT(run.world().linearVelocity(ball).z(), 0);
    EXPECT_EQ(run.world().gravity(), Vec3(0, 0, -10));
}

TEST(SceneRun, AppliesEventsOfOneTimeInTheirOrder) {
    Scene scene = lonelyBall();
    scene.events = {{0.5, SetVelocity{0, {9, 0, 0}}}, {0, SetVelocity{0, {1, 0, 0}}}, {0, SetVelocity{0, {2, 0, 0}}}};
    SceneRun run = started(scene);
    run.step();
    EXPECT_EQ(run.world().linearVelocity(run.ids()[0]).x(), 2);
}

TEST(SceneRun, JoinsBodiesBySprings) {
    Scene scene = lonelyBall();
    scene.bodies[0].linear_velocity = Vec3::Zero();
    scene.springs = {{0, std::nullopt, Vec3::Zero(), {2, 0, 0}, 100, 0, 0}};
    SceneRun run = started(scene);
    run.step();
    run.step();
    EXPECT_GT(run.world().linearVelocity(run.ids()[0]).x(), 0);
}

TEST(SceneRun, NamesTheBodyThatIsWrong) {
    Scene scene = lonelyBall();
    scene.bodies[0].material = "cheese";
    std::string message = messageOf([&] { started(scene); });
    EXPECT_NE(message.find("body 0 'ball'"), std::string::npos) << message;
    EXPECT_NE(message.find("cheese"), std::string::npos) << message;
    scene = lonelyBall();
    scene.bodies[0].shape = Sphere{-1};
    message = messageOf([&] { started(scene); });
    EXPECT_NE(message.find("body 0 'ball'"), std::string::npos) << message;
    EXPECT_NE(message.find("-1"), std::string::npos) << message;
    scene = lonelyBall();
    scene.events = {{0, RemoveBody{4}}};
    message = messageOf([&] { started(scene).step(); });
    EXPECT_NE(message.find("event at 0 s: body 4"), std::string::npos) << message;
}

TEST(SceneRun, ASimulationStepIsAThirtiethOfASecond) {
    const Scene scene = lonelyBall();
    SceneRun run = started(scene);
    EXPECT_EQ(run.stepsPerSimulationStep(), 8);
    run.simulationStep();
    EXPECT_EQ(run.world().stepCount(), 8);
    EXPECT_NEAR(run.world().time(), 1.0 / 30, 1e-12);
}

TEST(SceneRun, ASimulationStepSumsTheStatistics) {
    Scene scene = parseScene(sceneText(), "test");
    scene.bodies[1].position.z() = 0.5;
    const Settings settings = settingsFor(scene, {{}, 240, {}});
    SceneRun run(scene, settings);
    SceneRun single(scene, settings);
    std::int64_t contacts = 0;
    for (int i = 0; i < 8; ++i) {
        single.step();
        contacts += single.world().statistics().contacts;
    }
    const Statistics sum = run.simulationStep();
    EXPECT_GT(contacts, 8);
    EXPECT_EQ(sum.contacts, contacts);
}

TEST(SceneRun, SimulationStepsEndWithTheFirstTimeStepAtAThirtiethOrLater) {
    const Scene scene = lonelyBall();
    for (const auto& [steps_per_second, counts] : {std::pair(250.0, std::vector<std::int64_t>{9, 17, 25, 34, 42, 50}),
                                                   std::pair(100.0, std::vector<std::int64_t>{4, 7, 10, 14, 17, 20}),
                                                   std::pair(7.5, std::vector<std::int64_t>{1, 2, 3, 4, 5, 6})}) {
        Settings settings = settingsFor(scene);
        settings.steps_per_second = steps_per_second;
        SceneRun run(scene, settings);
        for (const std::int64_t count : counts) {
            run.simulationStep();
            EXPECT_EQ(run.world().stepCount(), count) << steps_per_second;
        }
    }
}

TEST(SettingsFor, CountsTheTimeStepsThatTheSizesOfTheBodiesAskFor) {
    Scene scene = builtInScene("tower:3");
    for (SceneBody& body : scene.bodies) {
        if (auto* box = std::get_if<Box>(&body.shape)) box->size *= 0.01;
        body.position *= 0.01;
    }
    const Settings settings = settingsFor(scene);
    EXPECT_FALSE(settings.steps_per_second.isBySize());
    EXPECT_EQ(settings.steps_per_second, 1920);
    EXPECT_EQ(SceneRun(scene, Settings{}).world().settings().steps_per_second, 1920);
    EXPECT_EQ(settingsFor(scene, {{}, 480, {}}).steps_per_second, 480);
    // A scene's own threshold is what it is.
    scene.settings = {{"sleep_threshold", 1e-4}};
    EXPECT_EQ(settingsFor(scene).sleep.sleep_threshold, 1e-4);
}

TEST(SettingsFor, TakesThePresetOfOverrideThenSceneThenPerformance) {
    Scene scene = lonelyBall();
    EXPECT_EQ(settingsFor(scene).steps_per_second, 240);
    scene.preset = Preset::accuracy;
    EXPECT_EQ(settingsFor(scene).steps_per_second, 960);
    SettingOverrides overrides;
    overrides.preset = Preset::performance;
    EXPECT_EQ(settingsFor(scene, overrides).steps_per_second, 240);
}

TEST(SettingsFor, OverridesWinOverTheScenesFields) {
    Scene scene = lonelyBall();
    scene.settings = {{"sleeping", false}, {"contact_margin", 2e-4}};
    SettingOverrides overrides;
    overrides.fields = {{"contact_margin", "3e-4"}};
    const Settings settings = settingsFor(scene, overrides);
    EXPECT_FALSE(settings.sleep.sleeping);
    EXPECT_EQ(settings.detection.contact_margin, 3e-4);
}

TEST(SettingsFor, ScalesThePresetToTheStepsPerSecond) {
    Scene scene = lonelyBall();
    const double expected = Settings::preset(Preset::performance, 480).sleep.sleep_threshold;
    ASSERT_NE(expected, Settings::preset(Preset::performance).sleep.sleep_threshold);
    SettingOverrides overrides;
    overrides.steps_per_second = 480;
    EXPECT_EQ(settingsFor(scene, overrides).sleep.sleep_threshold, expected);
    SettingOverrides field;
    field.fields = {{"steps_per_second", "480"}};
    EXPECT_EQ(settingsFor(scene, field).sleep.sleep_threshold, expected);
    EXPECT_EQ(settingsFor(scene, field).steps_per_second, 480);
    scene.settings = {{"steps_per_second", std::int64_t{480}}};
    EXPECT_EQ(settingsFor(scene).sleep.sleep_threshold, expected);
    overrides.steps_per_second = 960;
    EXPECT_EQ(settingsFor(scene, overrides).steps_per_second, 960) << "the override wins over the scene";
}

TEST(SettingsFor, ScalesToTheWeakestGravityOfTheScene) {
    Scene scene = lonelyBall();
    EXPECT_EQ(settingsFor(scene).sleep.sleep_threshold, Settings::preset(Preset::performance).sleep.sleep_threshold);
    scene.gravity = {0, 0, -10};
    scene.events = {{1, SetGravity{{1.6, 0, 0}}}, {2, SetGravity{Vec3::Zero()}}};
    EXPECT_EQ(settingsFor(scene).sleep.sleep_threshold,
              Settings::preset(Preset::performance, 0, 1.6).sleep.sleep_threshold);
}

TEST(SettingsFor, RefusesContradictions) {
    Scene scene = lonelyBall();
    scene.events = {{1, SetGravity{{0, 0, -10}}}};
    scene.settings = {{"sleep_threshold", 1.0}};
    EXPECT_NE(messageOf([&] { settingsFor(scene); }).find("sleep_threshold"), std::string::npos)
        << "contradicts the gravity that comes later";
    SettingOverrides overrides;
    overrides.steps_per_second = 480;
    overrides.fields = {{"steps_per_second", "960"}};
    EXPECT_NE(messageOf([&] { settingsFor(lonelyBall(), overrides); }).find("twice"), std::string::npos);
    overrides.fields = {{"nonsense", "1"}};
    EXPECT_NE(messageOf([&] { settingsFor(lonelyBall(), overrides); }).find("nonsense"), std::string::npos);
}

}  // namespace
}  // namespace cairn
