/// Recorded tosses of a cube: the reader's format, what it refuses, and the example that is shipped.
#include "validate/toss.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "temporary_folder.h"

namespace cairn::validation {
namespace {

const std::filesystem::path example = CAIRN_SOURCE_DIR "/examples/cube_toss/synthetic.csv";

Settings settingsOfTosses() {
    Settings settings = Settings::preset(Preset::accuracy, 148 * 16, 9.81);
    settings.integration.exact_flight = true;
    settings.sleep.sleeping = false;
    settings.resolution.resolution = ResolutionKind::accelerated_sweeps;
    settings.resolution.iterations = 1000;
    settings.resolution.tolerance = 0;
    return settings;
}

/// A file in a folder of its own, removed at the end.
class File {
  public:
    File(const std::string& name, const std::string& text) : path_(folder_ / name) { std::ofstream(path_) << text; }
    const std::filesystem::path& path() const { return path_; }

  private:
    test::TemporaryFolder folder_;
    std::filesystem::path path_;
};

constexpr const char* head = "time,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n";

TEST(Toss, ExampleIsReadWithItsPropertiesAndSamples) {
    const Toss toss = readToss(example);
    EXPECT_EQ(toss.name, "synthetic");
    EXPECT_EQ(toss.side, 0.1048);
    EXPECT_EQ(toss.mass, 0.37);
    EXPECT_EQ(toss.friction, 0.18);
    EXPECT_EQ(toss.restitution, 0.125);
    ASSERT_GT(toss.samples.size(), 50U);
    EXPECT_NEAR(toss.samples[1].time, 1.0 / 148, 1e-8);
}

TEST(Toss, IsReadAsItWasWritten) {
    const Toss toss = readToss(example);
    const File file("written.csv", formatTossCsv(toss));
    const Toss again = readToss(file.path());
    EXPECT_EQ(again.mass, toss.mass);
    ASSERT_EQ(again.samples.size(), toss.samples.size());
    for (std::size_t i = 0; i < toss.samples.size(); ++i) {
        EXPECT_NEAR(again.samples[i].time, toss.samples[i].time, 1e-8);
        EXPECT_TRUE(again.samples[i].pose.position.isApprox(toss.samples[i].pose.position, 1e-8));
        EXPECT_LT(again.samples[i].pose.orientation.angularDistance(toss.samples[i].pose.orientation), 1e-7);
        EXPECT_LT((again.samples[i].v - toss.samples[i].v).norm(), 1e-7);
        EXPECT_LT((again.samples[i].w - toss.samples[i].w).norm(), 1e-6);
    }
}

TEST(Toss, OfTheExampleIsFollowedByTheSimulation) {
    const Toss toss = readToss(example);
    const TossErrors errors = compareToss(toss, settingsOfTosses());
    ASSERT_EQ(errors.position.size(), toss.samples.size());
    EXPECT_LT(errors.meanPosition(), 0.05 * toss.side);
    // Another friction gives another toss.
    Toss rough = toss;
    rough.friction = 1;
    EXPECT_GT(compareToss(rough, settingsOfTosses()).meanPosition(), 2 * errors.meanPosition());
}

TEST(Toss, InJsonIsTheSame) {
    const File file("toss.json", R"({"side":0.2,"friction":0.3,"name":"mine",
        "samples":[[0,0,0,1,1,0,0,0,0,0,0,0,0,0],[0.1,0,0,0.95,1,0,0,0,0,0,-1,0,0,0]]})");
    const Toss toss = readToss(file.path());
    EXPECT_EQ(toss.side, 0.2);
    EXPECT_EQ(toss.friction, 0.3);
    EXPECT_EQ(toss.mass, 0.37) << "not given";
    ASSERT_EQ(toss.samples.size(), 2U);
    EXPECT_EQ(toss.samples[1].pose.position.z(), 0.95);
}

TEST(Toss, FilesThatAreNoneAreRefusedWithThePlace) {
    const std::string row = "0,0,0,1,1,0,0,0,0,0,0,0,0,0\n";
    const std::string later = "0.1,0,0,1,1,0,0,0,0,0,0,0,0,0\n";
    const std::vector<std::pair<std::string, std::string>> wrong = {
        {"time,x\n0,1\n", "line 1"},
        {head + row, "1 samples"},
        {head + row + row, "not later"},
        {head + row + "0.1,0,0,1,1,0,0\n", "7 numbers"},
        {head + row + "0.1,0,0,high,1,0,0,0,0,0,0,0,0,0\n", "'high'"},
        {head + row + "0.1,0,0,nan,1,0,0,0,0,0,0,0,0,0\n", "not finite"},
        {head + row + "0.1,0,0,1,2,0,0,0,0,0,0,0,0,0\n", "unit quaternion"},
        {"# side = -1\n" + std::string(head) + row + later, "side is -1"},
        {"# colour = 3\n" + std::string(head) + row + later, "'colour'"},
        {"# restitution = 2\n" + std::string(head) + row + later, "restitution is 2"},
        {"", "0 samples"},
    };
    for (const auto& [text, part] : wrong) {
        const File file("wrong.csv", text);
        try {
            readToss(file.path());
            ADD_FAILURE() << "accepted: " << text;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }
    for (const char* text : {"", "[]", "{\"samples\":[[1]]}", "{\"samples\":7}", "{\"side\":\"big\",\"samples\":[]}"}) {
        const File file("wrong.json", text);
        EXPECT_THROW(readToss(file.path()), InputError) << text;
    }
    EXPECT_THROW(readToss("/no/such/file.csv"), IoError);
}

}  // namespace
}  // namespace cairn::validation
