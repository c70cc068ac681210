/// A run that is saved and restored goes on as the one that was not.
#include <gtest/gtest.h>

#include <vector>

#include "cairn/scene.h"
#include "scene_testing.h"

namespace cairn {
namespace {

using testing::messageOf;

/// Steps two runs side by side. @return the number of the first step in which they differ, 0 if there is none
std::int64_t firstDifference(SceneRun& a, SceneRun& b, int steps) {
    for (int i = 0; i < steps; ++i) {
        a.step();
        b.step();
        if (a.world().stateHash() != b.world().stateHash()) return a.world().stepCount();
    }
    return 0;
}

TEST(SavedRun, GoesOnBitByBitInEveryBuiltInScene) {
    for (const char* name : {"stacks5", "well324", "cage384", "catapult7", "cradle", "tower:10", "wall:10"}) {
        const Scene scene = builtInScene(name);
        SceneRun run(scene, settingsFor(scene));
        for (int i = 0; i < 100; ++i) run.step();
        SceneRun copy = SceneRun::restore(run.save());
        ASSERT_EQ(copy.world().stateHash(), run.world().stateHash()) << name;
        EXPECT_EQ(firstDifference(run, copy, 140), 0) << name;
        EXPECT_TRUE(copy.save() == run.save()) << name;
    }
}

TEST(SavedRun, KeepsTheEventsThatAreStillToCome) {
    const Scene scene = parseScene(testing::sceneText(R"(,"events":[
        {"time":0.1,"body":"ball","impulse":[1,0,0]},
        {"time":0.3,"body":"crate","remove":true},
        {"time":0.5,"gravity":[0,1,-9]}])"),
                                   "test.json");
    for (const int saved_at : {10, 24, 25, 71, 72, 73, 121}) {
        SceneRun run(scene, settingsFor(scene));
        for (int i = 0; i < saved_at; ++i) run.step();
        SceneRun copy = SceneRun::restore(run.save());
        EXPECT_EQ(firstDifference(run, copy, 200), 0) << "saved after step " << saved_at;
        EXPECT_EQ(copy.world().gravity(), Vec3(0, 1, -9));
        EXPECT_EQ(copy.world().bodyCount(), 2U);
        EXPECT_EQ(copy.ids(), run.ids());
        EXPECT_EQ(copy.scene().bodies[1].name, "ball");
    }
}

TEST(SavedRun, IsRefusedWhenDamagedOrAWorldOnly) {
    const Scene scene = builtInScene("tower:3");
    SceneRun run(scene, settingsFor(scene));
    run.step();
    std::vector<std::byte> bytes = run.save();
    EXPECT_NE(messageOf([&] { SceneRun::restore(run.world().save()); }).find("holds a world"), std::string::npos);
    EXPECT_NE(messageOf([&] { World::restore(bytes); }).find("holds a run"), std::string::npos);
    bytes[bytes.size() / 2] ^= std::byte{4};
    EXPECT_EQ(messageOf([&] { SceneRun::restore(bytes, "my.checkpoint"); }).find("my.checkpoint is damaged within"),
              0U);
}

}  // namespace
}  // namespace cairn
