#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "scene_testing.h"

namespace cairn {
namespace {

std::string documentation() {
    std::ifstream file(CAIRN_SOURCE_DIR "/docs/scenes.md");
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

TEST(SceneDocumentation, ItsExampleIsAScene) {
    const std::string text = documentation();
    const std::string fence = "```json\n";
    const std::size_t begin = text.find(fence);
    ASSERT_NE(begin, std::string::npos);
    const std::string example = text.substr(begin + fence.size(), text.find("```", begin + 1) - begin - fence.size());
    const Scene scene = parseScene(example, "docs/scenes.md");
    SceneRun run(scene, settingsFor(scene));
    for (int i = 0; i < 150; ++i) run.simulationStep();
    EXPECT_EQ(run.world().bodyCount(), 3U) << "the crate is removed at 4 s";
    EXPECT_EQ(run.world().gravity(), Vec3(0, 0, -1.62));
    EXPECT_TRUE(run.world().faults().empty());
}

TEST(SceneDocumentation, ItsGatesStand) {
    const std::string text = documentation();
    const std::size_t begin = text.find("{\n  \"name\": \"two gates\"");
    ASSERT_NE(begin, std::string::npos);
    const Scene scene = parseScene(text.substr(begin, text.find("```", begin) - begin), "docs/scenes.md");
    ASSERT_EQ(scene.bodies.size(), 7U);
    SceneRun run(scene, settingsFor(scene));
    for (int i = 0; i < 60; ++i) run.simulationStep();
    for (const std::size_t wedge : {3U, 6U}) EXPECT_NEAR(run.world().pose(run.ids()[wedge]).position.z(), 1, 0.02);
}

TEST(SceneDocumentation, NamesEveryBuiltInScene) {
    const std::string text = documentation();
    for (const BuiltInScene& scene : builtInScenes()) {
        EXPECT_NE(text.find('`' + std::string(scene.name) + '`'), std::string::npos) << scene.name;
    }
}

}  // namespace
}  // namespace cairn
