/// Contacts with impulses and forces of joints in recordings, and frames at any rate.
#include "record/recording_fixture.h"

namespace cairn::test {
namespace {

/// A ball of 1 kg that lies on the ground, and one that hangs on a rod.
Scene forceScene() {
    return parseScene(R"({"name":"forces","duration":1,"gravity":[0,0,-10],"materials":{"oak":{"density":800}},
        "contacts":{"default":{"restitution":0}},"bodies":[
        {"shape":{"type":"plane","normal":[0,0,1],"offset":0},"material":"oak","fixed":true},
        {"shape":{"type":"sphere","radius":0.1},"material":"oak","mass":1,"position":[0,0,0.1]},
        {"shape":{"type":"sphere","radius":0.1},"material":"oak","mass":2,"position":[2,0,1]}],
        "joints":[{"type":"distance","a":2,"anchor":[2,0,1],"anchor_b":[2,0,2]}],
        "settings":{"sleeping":false,"damping":0.0}})",
                      "forces");
}

/// Records a run of one second.
void record(const std::filesystem::path& file, const RecordingOptions& options) {
    const Scene scene = forceScene();
    SceneRun run(scene, settingsFor(scene));
    RecordingWriter writer(file, scene, run.world().settings(), options);
    writer.append(captureFrame(run, {}, options));
    while (run.world().time() < 1 - 1e-9) {
        run.step();
        if (isFrameDue(run, options.frame_rate)) writer.append(captureFrame(run, {}, options));
    }
    writer.close();
}

TEST(RecordedForces, AreTheWeightsOfWhatLiesAndHangs) {
    const TemporaryFolder folder;
    record(folder / "a.h5", {.contacts = true, .joints = true});
    const RecordingReader reader(folder / "a.h5");
    EXPECT_TRUE(reader.info().contacts);
    EXPECT_TRUE(reader.info().joints);
    ASSERT_EQ(reader.info().frames, 31U);
    EXPECT_TRUE(reader.frame(0).contact_a.empty()) << "before the first step nothing was detected";
    const Frame last = reader.frame(30);
    ASSERT_EQ(last.contact_a.size(), 1U);
    EXPECT_EQ(last.contact_a[0], 0);
    EXPECT_EQ(last.contact_b[0], 1);
    const double steps = settingsFor(forceScene()).steps_per_second;
    EXPECT_NEAR((last.contact_impulse[0] * steps).z(), -10, 1e-6) << "on the ground";
    EXPECT_NEAR(last.contact_point[0].x(), 0, 1e-9);
    ASSERT_EQ(last.joint_force.size(), 1U);
    EXPECT_NEAR(last.joint_force[0].z(), 20, 1e-6);
}

TEST(RecordedForces, AreLinesForParaView) {
    const TemporaryFolder folder;
    record(folder / "a.h5", {.frame_rate = 10, .contacts = true, .joints = true});
    exportVtk(RecordingReader(folder / "a.h5"), folder / "out");
    EXPECT_TRUE(contains(readWhole(folder / "out_forces.pvd"), "out/out_forces_000010.vtp"));
    const std::string text = readWhole(folder / "out/out_forces_000010.vtp");
    EXPECT_TRUE(contains(text, "NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"2\""))
        << "the ball on the ground and the one on the rod: " << text.substr(0, 300);
    EXPECT_TRUE(contains(text, "Name=\"normal_force\""));
}

TEST(RecordedForces, AreLeftOutUnlessAskedFor) {
    const TemporaryFolder folder;
    record(folder / "a.h5", {});
    const RecordingReader reader(folder / "a.h5");
    EXPECT_FALSE(reader.info().contacts);
    EXPECT_TRUE(reader.frame(30).contact_a.empty());
    EXPECT_TRUE(reader.frame(30).joint_force.empty());
    exportVtk(reader, folder / "out");
    EXPECT_FALSE(std::filesystem::exists(folder / "out_forces.pvd"));
    const Scene scene = forceScene();
    RecordingWriter writer(folder / "b.h5", scene, settingsFor(scene));
    const SceneRun run(scene, settingsFor(scene));
    const Frame frame = captureFrame(run, {}, {.joints = true});
    EXPECT_TRUE(contains(messageOf<InputError>([&] { writer.append(frame); }), "entries of its joints"));
}

TEST(FrameRate, TakesTheFirstTimeStepAtOrAfterEachMoment) {
    const TemporaryFolder folder;
    // 180 steps per second; 100 does not divide them, 180 is one frame per step, 0.5 none within the second.
    const double step = settingsFor(forceScene()).timeStep();
    for (const double rate : {10.0, 100.0, 1 / step, 0.5}) {
        record(folder / "a.h5", {.frame_rate = rate});
        const RecordingReader reader(folder / "a.h5");
        EXPECT_EQ(reader.info().frame_rate, rate);
        ASSERT_EQ(reader.info().frames, static_cast<std::size_t>(rate + 1e-6) + 1);
        for (std::size_t i = 0; i < reader.info().frames; ++i) {
            const double late = reader.frame(i).time - static_cast<double>(i) / rate;
            EXPECT_GT(late, -1e-6) << rate;
            EXPECT_LT(late, step) << rate;
        }
        EXPECT_FALSE(verifyRecording(reader).has_value()) << rate;
    }
}

TEST(FrameRate, IsRefusedWhereItFitsNoTimeSteps) {
    const TemporaryFolder folder;
    const Scene scene = forceScene();
    const Settings settings = settingsFor(scene);
    const auto message = [&](const RecordingOptions& options) {
        return messageOf<InputError>([&] { RecordingWriter(folder / "a.h5", scene, settings, options); });
    };
    EXPECT_TRUE(contains(message({.frame_rate = 0}), "the frame rate is 0; it must be at least 0.001"));
    EXPECT_TRUE(contains(message({.frame_rate = 1e6}), "the frame rate is 1000000"));
    EXPECT_TRUE(contains(message({.hashes_per_frame = 2, .frame_rate = 100}), "take a rate that divides them"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
}

}  // namespace
}  // namespace cairn::test
