/// @file Options, messages, exit codes, and the commands that do not simulate.
#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "cairn/scene.h"
#include "cairn/settings.h"
#include "cairn/version.h"
#include "cli/cli_fixture.h"

namespace cairn::test {
namespace {

const std::string version_line = "cairn " + std::string(version) + "\n";

TEST_F(CommandLine, everyCommandHasHelpAndVersion) {
    for (const std::string command : {"", "run", "scenes", "info", "export", "settings"}) {
        std::vector<std::string> words;
        if (!command.empty()) words.push_back(command);
        words.push_back("--help");
        const Finished help = cairn(words);
        EXPECT_EQ(help.code, 0) << command;
        EXPECT_NE(help.out.find("Usage: cairn " + command), std::string::npos) << help.out;
        words.back() = "--version";
        const Finished number = cairn(words);
        EXPECT_EQ(number.code, 0) << command;
        EXPECT_EQ(number.out, version_line) << command;
        EXPECT_EQ(number.error, "");
    }
}

TEST_F(CommandLine, scenesAreWrittenAsFilesAsTheyAreOrScaled) {
    EXPECT_EQ(cairn({"scenes", "tower:3", "--json", file("as_it_is.json")}).code, 0);
    EXPECT_EQ(read("as_it_is.json"), formatScene(builtInScene("tower:3")));
    EXPECT_EQ(cairn({"scenes", file("as_it_is.json"), "--json", file("large.json"), "--scale", "4,2,64"}).code, 0);
    EXPECT_EQ(read("large.json"), formatScene(scaled(builtInScene("tower:3"), {4, 2, 64})));
    const auto expectRefused = [&](std::vector<std::string> words, const std::string& said) {
        words.insert(words.begin(), "scenes");
        const Finished refused = cairn(words);
        EXPECT_NE(refused.code, 0) << said;
        EXPECT_NE(refused.error.find(said), std::string::npos) << refused.error;
    };
    expectRefused({"tower:3"}, "--json");
    expectRefused({"--json", file("x.json")}, "SCENE");
    expectRefused({"tower:3", "--scale", "4,2,64"}, "--json");
    expectRefused({"tower:3", "--json", file("x.json"), "--scale", "4,2"}, "--scale");
    expectRefused({"tower:3", "--json", file("x.json"), "--scale", "4,0,64"}, "the scale of times is 0");
    expectRefused({"tower:3", "--json", file("x.json"), "--scale", "1e-9,1,1"}, "between 1e-06 and");
    expectRefused({"no_such_scene", "--json", file("x.json")}, "no_such_scene");
}

TEST_F(CommandLine, companionsAnswerByTheirCommands) {
    for (const std::string command : {"view", "bench", "bench thesis", "validate"}) {
        std::vector<std::string> words{command.substr(0, command.find(' '))};
        if (command == "bench thesis") words.emplace_back("thesis");
        words.push_back("--help");
        const Finished help = cairn(words);
        EXPECT_EQ(help.code, 0) << command << help.error;
        EXPECT_NE(help.out.find("Usage: cairn " + command), std::string::npos) << help.out;
    }
}

TEST_F(CommandLine, aMissingCompanionIsNamedWithTheCommandThatBuildsIt) {
    std::filesystem::copy_file(CAIRN_PROGRAM, file("alone"));
    const auto expectMissing = [&](const std::string& arguments, const std::string& companion) {
        const int status =
            std::system(fmt::format("cd '{0}' && ./alone {1} 2> said", folder().string(), arguments).c_str());
        EXPECT_EQ(WEXITSTATUS(status), 1) << arguments;
        EXPECT_NE(read("said").find(fmt::format("'make {}'", companion)), std::string::npos) << read("said");
    };
    expectMissing("view stacks5", "cairn-view");
    expectMissing("bench peers", "cairn-bench");
    expectMissing("bench thesis", "cairn-bench-thesis");
    expectMissing("validate --list", "cairn-validate");
    write("any.h5", "");
    expectMissing("export any.h5 --png any.png", "cairn-view");
}

TEST_F(CommandLine, wrongOptionsAreRefused) {
    expectWrongUse({}, {"subcommand"});
    expectWrongUse({"nonsense"}, {});
    expectWrongUse({"run"}, {"SCENE"});
    expectWrongUse({"run", "tower:2", "--nonsense"}, {"--nonsense"});
    expectWrongUse({"run", "tower:2", "tower:3"}, {"tower:3"});
    expectWrongUse({"run", "tower:2", "--preset", "fast"}, {"fast", "performance", "accuracy"});
    expectWrongUse({"run", "tower:2", "--threads", "two"}, {"--threads", "two"});
    expectWrongUse({"run", "tower:2", "--threads", "0"}, {"threads", "0", "1024"});
    for (const std::string duration : {"-1", "0", "nan", "inf", "1e9"}) {
        expectWrongUse({"run", "tower:2", "--duration", duration}, {"--duration is", "above 0"});
    }
    expectWrongUse({"run", "tower:2", "--duration", "long"}, {"--duration", "long"});
    expectWrongUse({"run", "tower:2", "--steps-per-second", "0.0001"}, {"steps_per_second", "0.0001", "0.001"});
    expectWrongUse({"run", "tower:2", "--steps-per-second", "2e6"}, {"steps_per_second", "1000000"});
}

TEST_F(CommandLine, wrongSettingsAreRefused) {
    expectWrongUse({"run", "tower:2", "--set", "damping"}, {"'damping'", "field=value"});
    expectWrongUse({"run", "tower:2", "--set", "=1"}, {"'=1'", "field=value"});
    expectWrongUse({"run", "tower:2", "--set", "nonsense=1"}, {"nonsense", "sleep_threshold"});
    expectWrongUse({"run", "tower:2", "--set", "damping=2"}, {"damping", "2", "0.99"});
    expectWrongUse({"run", "tower:2", "--set", "damping=nan"}, {"damping"});
    expectWrongUse({"run", "tower:2", "--set", "correction=pushes"}, {"pushes", "propagated"});
    expectWrongUse({"run", "tower:2", "--set", "sleep_threshold=1"}, {"sleep_threshold"});
}

TEST_F(CommandLine, wrongScenesAreRefused) {
    expectWrongUse({"run", "nonsense"}, {"nonsense", "cairn scenes"});
    expectWrongUse({"run", "tower:none"}, {"tower", "none"});
    write("broken.json", "{\"name\": \"broken\",\n\"duration\": }");
    expectWrongUse({"run", "broken.json"}, {"broken.json", "2"});
    write("unknown.json",
          "{\"name\": \"x\", \"duration\": 1, \"gravity\": [0, 0, -10], \"materials\": {}, "
          "\"bodies\": [], \"surprise\": 1}");
    expectWrongUse({"run", "unknown.json"}, {"unknown.json", "surprise"});
    expectWrongUse({"info", "missing.json"}, {"missing.json"});
}

TEST_F(CommandLine, outputsMayNotOverwriteEachOtherOrTheScene) {
    write("scene.json", formatScene(builtInScene("tower:2")));
    const std::string scene = read("scene.json");
    expectWrongUse({"run", "scene.json", "--record", "./scene.json"}, {"scene itself"});
    expectWrongUse({"run", "scene.json", "--stats", "scene.json"}, {"scene itself"});
    expectWrongUse({"run", "scene.json", "--record", "a.h5", "--stats", "a.h5"}, {"a.h5"});
    EXPECT_EQ(read("scene.json"), scene);
    EXPECT_FALSE(std::filesystem::exists(file("a.h5")));
}

TEST_F(CommandLine, scenesAreListed) {
    const Finished done = cairn({"scenes"});
    EXPECT_EQ(done.code, 0);
    for (const BuiltInScene& scene : builtInScenes()) {
        EXPECT_NE(done.out.find(std::string(scene.name) + " "), std::string::npos) << scene.name;
        EXPECT_NE(done.out.find(std::string(scene.description)), std::string::npos) << scene.name;
    }
}

TEST_F(CommandLine, settingsAreListed) {
    const Finished plain = cairn({"settings"});
    const Finished markdown = cairn({"settings", "--markdown"});
    EXPECT_EQ(plain.code, 0);
    EXPECT_EQ(markdown.code, 0);
    EXPECT_TRUE(markdown.out.starts_with("# Settings\n"));
    for (const SettingField& field : settingFields()) {
        for (const std::string& text : {plain.out, markdown.out}) {
            EXPECT_NE(text.find(std::string(field.name)), std::string::npos) << field.name;
            EXPECT_NE(text.find(std::string(field.meaning)), std::string::npos) << field.name;
        }
        EXPECT_NE(markdown.out.find("| `" + std::string(field.name) + "` | " + std::string(field.unit) + " | "),
                  std::string::npos)
            << field.name;
    }
}

TEST_F(CommandLine, thePageOfTheSettingsIsUpToDate) {
    std::ifstream in(CAIRN_SOURCE_DIR "/docs/settings.md");
    const std::string page(std::istreambuf_iterator<char>(in), {});
    EXPECT_EQ(cairn({"settings", "--markdown"}).out, page)
        << "write it anew: cairn settings --markdown > docs/settings.md";
}

TEST_F(CommandLine, infoDescribesScenes) {
    write("scene.json", formatScene(builtInScene("tower:3")));
    for (const std::string name : {"scene.json", "tower:3"}) {
        const Finished done = cairn({"info", name});
        EXPECT_EQ(done.code, 0) << done.error;
        EXPECT_NE(done.out.find("4 (1 fixed), box 3, plane 1"), std::string::npos) << done.out;
        EXPECT_NE(done.out.find("0 0 -10 m/s²"), std::string::npos) << done.out;
    }
}

TEST_F(CommandLine, infoTellsWhatWasMendedOfAMesh) {
    write("scene.json", R"({"name":"m","duration":1,"gravity":[0,0,-10],"materials":{"oak":{"density":800}},"bodies":[
        {"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0],[0,1,0],[2,0,0]],
         "indices":[[0,1,2],[1,3,0],[0,1,4],[4,2,1]]},"material":"oak","fixed":true},
        {"shape":{"type":"height_field","heights":[[0,0,0],[0,1,0]],"spacing":1},"material":"oak","fixed":true}]})");
    const Finished done = cairn({"info", "scene.json"});
    EXPECT_NE(done.out.find("1 × 2 triangles, "), std::string::npos) << done.out << done.error;
    EXPECT_NE(done.out.find(
                  " MB, 4 open edges, 1 without an area left out, 1 given twice left out, 1 of the vertices welded"),
              std::string::npos)
        << done.out;
    EXPECT_NE(done.out.find("1 × 3 × 2 heights, 4 triangles, "), std::string::npos) << done.out;
}

TEST_F(CommandLine, infoAndExportRefuseWhatIsNoRecording) {
    write("text.h5", "not HDF5");
    const Finished info = cairn({"info", "text.h5"});
    EXPECT_EQ(info.code, 1);
    EXPECT_EQ(info.error, "cairn: error: text.h5: is not an HDF5 file, so not a recording\n");
    EXPECT_EQ(cairn({"export", "text.h5", "--csv", "a.csv"}).code, 1);
    EXPECT_FALSE(std::filesystem::exists(file("a.csv")));
    expectWrongUse({"export", "missing.h5", "--csv", "a.csv"}, {"missing.h5"});
    expectWrongUse({"export", "text.h5"}, {"--csv"});
}

TEST_F(CommandLine, aFullDiskAtTheStandardOutputIsReported) {
    const Finished done = runProgram(folder(), {"scenes"}, "/dev/full");
    EXPECT_EQ(done.code, 1);
    EXPECT_EQ(done.error, "cairn: error: standard output: cannot be written: No space left on device\n");
}

}  // namespace
}  // namespace cairn::test
