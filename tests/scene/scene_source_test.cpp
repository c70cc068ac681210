/// Scenes whose bodies are told one by one.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "scene/scene_survey.h"
#include "scene_testing.h"
#include "temporary_folder.h"

namespace cairn {
namespace {

using testing::messageOf;
using testing::sceneText;

/// A file that is removed with it.
class SceneFile {
  public:
    explicit SceneFile(const std::string& text) { write(text); }

    const std::filesystem::path& path() const { return path_; }
    void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }

  private:
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "scene.json";
};

std::string ballText(int number) {
    return R"({"shape":{"type":"sphere","radius":0.1},"material":"oak","name":"ball )" + std::to_string(number) +
           R"(","position":[)" + std::to_string(number) + ",0,1]}";
}

/// A scene longer than the pages that files are read in. @param rest behind the bodies
std::string longText(int balls, const std::string& rest) {
    std::string text =
        R"({"name":"long","duration":1,"gravity":[0,0,-10],"materials":{"oak":{"density":800}},"bodies":[)";
    for (int i = 0; i < balls; ++i) text += (i == 0 ? "\n" : ",\n") + ballText(i);
    return text + "\n]" + rest + "}\n";
}

TEST(SceneSource, FamiliesTellTheBodiesOfTheScene) {
    for (const char* name :
         {"heap:30", "pit:40", "pits:3:20", "gas:30", "bed:3:2:2", "bed:3:2", "grains:50", "pits:2"}) {
        const SceneSource source = builtInSource(name);
        EXPECT_TRUE(source.isTold()) << name;
        EXPECT_TRUE(source.scene().bodies.empty());
        const Scene scene = builtInScene(name);
        EXPECT_EQ(scene.bodies.size(), source.survey().bodies);
        EXPECT_TRUE(source.survey().can_be_dealt_out);
        EXPECT_EQ(formatScene(source), formatScene(scene));
        EXPECT_EQ(settingsFor(source).steps_per_second, settingsFor(scene).steps_per_second);
    }
    EXPECT_FALSE(builtInSource("stacks5").isTold());
    EXPECT_EQ(formatScene(builtInSource("stacks5")), formatScene(builtInScene("stacks5")));
}

TEST(SceneSource, BodiesOfFamiliesDoNotDependOnHowManyThereAre) {
    const Scene few = builtInScene("bed:10:10:2");
    const Scene many = builtInScene("bed:10:10:4");
    const std::size_t fixed = 5;
    for (std::size_t i = fixed; i < few.bodies.size(); ++i) {
        EXPECT_EQ(few.bodies[i].position, many.bodies[i].position);
    }
}

TEST(SceneSource, FilesTellTheirBodiesPageByPage) {
    const SceneFile file(longText(8000, R"(,"events":[{"time":0.5,"gravity":[1,0,0]}])"));
    ASSERT_GT(std::filesystem::file_size(file.path()), std::size_t{600000});
    const SceneSource source = readSceneSource(file.path());
    EXPECT_TRUE(source.isTold());
    EXPECT_EQ(source.scene().events.size(), 1U);
    const Scene scene = readScene(file.path());
    EXPECT_EQ(formatScene(source), formatScene(scene));
    EXPECT_EQ(formatScene(source.whole()), formatScene(parseScene(formatScene(source), "again")));
    EXPECT_EQ(scene.bodies.at(7999).name, "ball 7999");
}

TEST(SceneSource, FilesThatNameBodiesAreThereAsAWhole) {
    for (const std::string rest : {R"(,"events":[{"time":0,"body":"ball","impulse":[1,0,0]}])",
                                   R"(,"springs":[{"a":"ball","b":"crate","stiffness":1}])",
                                   R"(,"joints":[{"type":"ball","a":"ball","b":"crate","anchor":[1,0,0]}])"}) {
        const SceneFile file(sceneText(rest));
        const SceneSource source = readSceneSource(file.path());
        EXPECT_FALSE(source.isTold()) << rest;
        EXPECT_EQ(source.scene().bodies.size(), 3U);
    }
    const SceneFile file(sceneText());
    EXPECT_TRUE(readSceneSource(file.path()).isTold());
}

TEST(SceneSource, ErrorsSayWhereInTheFile) {
    SceneFile file(longText(8000, ""));
    const auto message = [&](std::string text, const std::string& what, const std::string& by) {
        file.write(text.replace(text.rfind(what), what.size(), by));
        const std::string told = messageOf([&] { readSceneSource(file.path()); });
        EXPECT_EQ(told, messageOf([&] { readScene(file.path()); }));
        return told;
    };
    const std::string text = longText(8000, "");
    EXPECT_NE(message(text, "\"oak\",\"name\":\"ball 7999", "\"oak\" \"name\":\"ball 7999").find(".json:8001:"),
              std::string::npos);
    EXPECT_NE(message(text, "ball 7999", "ball 12").find("bodies[7999].name is 'ball 12' as that of bodies[12]"),
              std::string::npos);
    EXPECT_NE(message(text, "\"oak\"", "\"elm\"").find("bodies[7999].material"), std::string::npos);
    EXPECT_NE(message(text, "]}\n", "]\n").find("json:8003:"), std::string::npos);
}

TEST(SceneSource, SaysThatItsFileWasChanged) {
    const SceneFile file(longText(20, ""));
    const SceneSource source = readSceneSource(file.path());
    const std::filesystem::path other = file.path().string() + ".other";
    std::filesystem::rename(file.path(), other);
    file.write("another");
    EXPECT_EQ(source.whole().bodies.size(), 20U) << "it is another file now that has the name";
    std::filesystem::rename(other, file.path());
    file.write(longText(21, ""));
    EXPECT_THROW(source.whole(), IoError);
}

TEST(SceneSource, RefusesWhatWouldHaveToNameBodies) {
    Scene scene = builtInScene("cradle_swing:3:1");
    EXPECT_NE(messageOf([&] { SceneSource(scene, [](const SceneSource::Take&) {}); }).find("give it as a Scene"),
              std::string::npos);
}

TEST(SceneSource, KeepsSomePlacesOfMany) {
    Scene scene = builtInScene("gas:1");
    const SceneBody ball = scene.bodies.at(0);
    scene.bodies.clear();
    const auto tell = [&](const SceneSource::Take& take) {
        SceneBody body = ball;
        for (int i = 0; i < 300'000; ++i) {
            body.position.x() = i;
            take(body);
        }
    };
    const std::vector<Vec3> places = SceneSource(scene, tell).survey().places;
    EXPECT_EQ(places.size(), 75'000U);
    EXPECT_EQ(places.back().x(), 299'996);
}

TEST(SceneSource, RunsAsTheScene) {
    const SceneFile file(formatScene(builtInScene("grains:40")));
    SceneRun told(readSceneSource(file.path()), settingsFor(readSceneSource(file.path())));
    const Scene scene = readScene(file.path());
    SceneRun whole(scene, settingsFor(scene));
    EXPECT_TRUE(told.scene().bodies.empty());
    for (int i = 0; i < 20; ++i) {
        told.step();
        whole.step();
    }
    EXPECT_EQ(told.world().stateHash(), whole.world().stateHash());
    EXPECT_EQ(told.save(), whole.save());
    EXPECT_EQ(SceneRun::restore(told.save()).scene().bodies.size(), scene.bodies.size());
}

}  // namespace
}  // namespace cairn
