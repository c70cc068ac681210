#include <cmath>

#include "cairn/version.h"
#include "record/recording_fixture.h"

namespace cairn::test {
namespace {

TEST(Recording, givesBackEveryNumberOfEveryFrame) {
    const TemporaryFolder folder;
    recordFrames(folder / "a.h5", 200);  // more than a chunk of the series of numbers
    const RecordingReader reader(folder / "a.h5");
    ASSERT_EQ(reader.info().frames, 200U);
    for (std::size_t i = 0; i < 200; ++i) expectSameFrame(reader.frame(i), madeUpFrame(i, 4));
}

TEST(Recording, keepsSceneSettingsVersionAndMachine) {
    const TemporaryFolder folder;
    const Scene scene = smallScene();
    Settings settings = settingsFor(scene);
    setFieldFromText(settings, "damping", "0.125");
    setFieldFromText(settings, "sleeping", "false");
    setFieldFromText(settings, "resolution", "sweep");
    RecordingWriter(folder / "a.h5", scene, settings).close();
    const RecordingInfo info = RecordingReader(folder / "a.h5").info();
    EXPECT_EQ(formatScene(info.scene), formatScene(scene));
    EXPECT_EQ(info.bodies, 4U);
    EXPECT_EQ(info.frames, 0U);
    EXPECT_EQ(info.version, version);
    EXPECT_TRUE(contains(info.machine, " threads, ")) << info.machine;
    // The texts make the same settings again, so they hold every field with every digit.
    Settings again;
    ASSERT_EQ(info.settings.size(), settingFields().size());
    for (const auto& [name, value] : info.settings) setFieldFromText(again, name, value);
    for (const SettingField& field : settingFields()) {
        EXPECT_EQ(field.get(again), field.get(settings)) << field.name;
    }
}

TEST(Recording, keepsDiagnosticsIfTheyAreAskedFor) {
    const TemporaryFolder folder;
    const Scene scene = smallScene();
    Settings settings = settingsFor(scene);
    settings.diagnostics.diagnostics = true;
    RecordingWriter writer(folder / "a.h5", scene, settings);
    const auto frameOf = [&](std::size_t index) {
        Frame frame = madeUpFrame(index, scene.bodies.size());
        double next = static_cast<double>(index) * 100 + 0.5;
        for (const DiagnosticsField& field : diagnosticsFields()) {
            field.of(frame.statistics.diagnostics) = std::sqrt(next++);
        }
        return frame;
    };
    for (std::size_t i = 0; i < 3; ++i) writer.append(frameOf(i));
    writer.close();
    const RecordingReader reader(folder / "a.h5");
    ASSERT_EQ(reader.info().frames, 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        Diagnostics got = reader.frame(i).statistics.diagnostics;
        Diagnostics expected = frameOf(i).statistics.diagnostics;
        for (const DiagnosticsField& field : diagnosticsFields()) {
            EXPECT_EQ(field.of(got), field.of(expected)) << field.name;
        }
    }
}

TEST(Recording, takesFramesInAnyOrderWhenRead) {
    const TemporaryFolder folder;
    recordFrames(folder / "a.h5", 5);
    RecordingReader first(folder / "a.h5");
    const RecordingReader reader(std::move(first));
    for (const std::size_t i : {4U, 0U, 3U, 0U}) expectSameFrame(reader.frame(i), madeUpFrame(i, 4));
}

TEST(Recording, refusesAFrameThatIsNotThere) {
    const TemporaryFolder folder;
    recordFrames(folder / "a.h5", 3);
    const RecordingReader reader(folder / "a.h5");
    const std::string message = messageOf<InputError>([&] { reader.frame(3); });
    EXPECT_TRUE(contains(message, "no frame 3") && contains(message, "3 frames")) << message;
}

TEST(Recording, holdsASceneWithoutBodies) {
    const TemporaryFolder folder;
    Scene scene = smallScene();
    scene.bodies.clear();
    RecordingWriter writer(folder / "empty.h5", scene, settingsFor(scene));
    for (std::size_t i = 0; i < 3; ++i) writer.append(madeUpFrame(i, 0));
    writer.close();
    const RecordingReader reader(folder / "empty.h5");
    ASSERT_EQ(reader.info().frames, 3U);
    for (std::size_t i = 0; i < 3; ++i) expectSameFrame(reader.frame(i), madeUpFrame(i, 0));
}

TEST(Recording, refusesFramesOfAnotherSceneAndAfterClose) {
    const TemporaryFolder folder;
    const Scene scene = smallScene();
    RecordingWriter writer(folder / "a.h5", scene, settingsFor(scene));
    Frame frame = madeUpFrame(0, 4);
    frame.asleep.pop_back();
    const std::string message = messageOf<InputError>([&] { writer.append(frame); });
    EXPECT_TRUE(contains(message, "3 entries in asleep") && contains(message, "4 bodies")) << message;
    writer.append(madeUpFrame(0, 4));
    writer.close();
    EXPECT_THROW(writer.append(madeUpFrame(1, 4)), InputError);
    EXPECT_EQ(RecordingReader(folder / "a.h5").info().frames, 1U);
}

TEST(Recording, isClosedByTheDestructor) {
    const TemporaryFolder folder;
    {
        const Scene scene = smallScene();
        RecordingWriter writer(folder / "a.h5", scene, settingsFor(scene));
        writer.append(madeUpFrame(0, 4));
    }
    EXPECT_EQ(RecordingReader(folder / "a.h5").info().frames, 1U);
}

TEST(Recording, replacesAnOlderFile) {
    const TemporaryFolder folder;
    recordFrames(folder / "a.h5", 9);
    recordFrames(folder / "a.h5", 2);
    EXPECT_EQ(RecordingReader(folder / "a.h5").info().frames, 2U);
}

TEST(CaptureFrame, takesTheStateOfTheWorld) {
    Scene scene = smallScene();
    scene.bodies[1].linear_velocity = Vec3(1, 2, 3);
    scene.bodies[2].angular_velocity = Vec3(3, 2, 1);
    scene.bodies[3].asleep = true;
    SceneRun run(scene, settingsFor(scene));
    Statistics statistics;
    statistics.contacts = 17;
    const Frame frame = captureFrame(run, statistics);
    EXPECT_EQ(frame.time, 0);
    ASSERT_EQ(frame.position.size(), 4U);
    EXPECT_EQ(frame.position[3], Vec3(2, 0, 2));
    EXPECT_EQ(frame.linear_velocity[1], Vec3(1, 2, 3));
    EXPECT_EQ(frame.angular_velocity[2], Vec3(3, 2, 1));
    EXPECT_EQ(frame.asleep, (std::vector<std::uint8_t>{0, 0, 0, 1}));
    EXPECT_EQ(frame.statistics.contacts, 17);
    EXPECT_EQ(frame.kinetic_energy, run.world().kineticEnergy());
    EXPECT_EQ(frame.potential_energy, run.world().potentialEnergy());
    const Statistics step = run.simulationStep();
    EXPECT_NEAR(captureFrame(run, step).time, 1.0 / 30, 1e-12);
    EXPECT_LT(captureFrame(run, step).position[1].z(), 2.1);
}

TEST(CaptureFrame, marksRemovedBodiesAndRecordsThem) {
    const TemporaryFolder folder;
    Scene scene = smallScene();
    scene.events = {{0, RemoveBody{2}}};
    SceneRun run(scene, settingsFor(scene));
    const Statistics step = run.simulationStep();
    RecordingWriter writer(folder / "a.h5", scene, settingsFor(scene));
    writer.append(captureFrame(run, step));
    writer.close();
    const Frame frame = RecordingReader(folder / "a.h5").frame(0);
    EXPECT_TRUE(frame.position[2].array().isNaN().all());
    EXPECT_TRUE(frame.position[1].allFinite());
    EXPECT_TRUE(frame.position[3].allFinite());
}

}  // namespace
}  // namespace cairn::test
