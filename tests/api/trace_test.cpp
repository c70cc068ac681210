#include <gtest/gtest.h>

#include "cairn/scene.h"

namespace cairn {
namespace {

TEST(Trace, TellsBoundsLevelCorrectionAndShockStage) {
    const Scene scene = builtInScene("tower:6");
    Settings settings = settingsFor(scene);
    settings.resolution.resolution = ResolutionKind::impulse_queue;
    settings.resolution.iterations = 0.1;
    SceneRun run(scene, settings);
    World& world = run.world();
    world.setTracing(Tracing::on);
    run.step();
    for (int i = 1; i <= 6; ++i) {
        const BodyTrace trace = world.trace(run.ids()[static_cast<std::size_t>(i)]);
        EXPECT_EQ(trace.shock_stage, i - 1);
        EXPECT_GE(trace.level, 0);
        // A sixteenth of the overlap that two boxes of 10 cm are allowed.
        EXPECT_NEAR(trace.bounds_upper.z(), 0.1 * i + settings.correction.allowed_overlap * 0.1 / 16, 1e-12);
        EXPECT_EQ(trace.correction, Vec3::Zero());
    }
    const BodyId lowest = run.ids()[1];
    world.setPose(lowest, {Vec3(1, 0, 0.04), Quat::Identity()});
    run.step();
    EXPECT_GT(world.trace(lowest).correction.z(), 5e-3);
    world.setTracing(Tracing::off);
    run.step();
    EXPECT_EQ(world.trace(lowest).shock_stage, -1);
    EXPECT_THROW(world.trace(BodyId{}), StaleIdError);
}

TEST(EventsOfScene, FollowTheTimeWhenTheStepLengthChangesAndSkipRemovedBodies) {
    Scene scene = builtInScene("tower:2");
    scene.events = {{0.5, SetGravity{Vec3(0, 0, -9)}}, {0.5, GiveImpulse{1, Vec3(1, 0, 0)}}};
    SceneRun run(scene, settingsFor(scene));
    for (int i = 0; i < 60; ++i) run.step();
    run.world().setSettings(Settings::preset(Preset::accuracy, 960, 9));
    run.world().removeBody(run.ids()[1]);
    for (int i = 0; i < 240; ++i) {
        run.step();
        ASSERT_EQ(run.world().gravity().z(), -10) << run.world().time();
    }
    run.step();
    EXPECT_EQ(run.world().gravity().z(), -9);
}

}  // namespace
}  // namespace cairn
