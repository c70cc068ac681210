/// A recording proves that a run can be repeated, or tells where it was not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "cairn/recording.h"
#include "temporary_folder.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

class Verify : public testing::Test {
  protected:
    /// Records a run with events. @param tamper changes the run, or the frame, behind the recording's back
    template <class Tamper>
    fs::path record(std::size_t hashes, const Tamper& tamper) {
        Scene scene = builtInScene("wall:4");
        scene.events.push_back({0.2, GiveImpulse{3, Vec3(0.5, 0.1, 0)}});
        scene.events.push_back({0.4, RemoveBody{5}});
        const Settings settings = settingsFor(scene);
        SceneRun run(scene, settings);
        const fs::path file = folder_ / "run.h5";
        RecordingWriter writer(file, scene, settings, {.hashes_per_frame = hashes});
        writer.append(captureFrame(run, {}));
        std::vector<std::uint64_t> now;
        for (int i = 1; i <= 30; ++i) {
            const Statistics statistics = run.simulationStep(now);
            Frame frame = captureFrame(run, statistics);
            if (hashes > 0) frame.step_hashes = now;
            tamper(i, run, frame);
            writer.append(frame);
        }
        writer.close();
        return file;
    }

  private:
    test::TemporaryFolder folder_;
};

constexpr auto honest = [](int, SceneRun&, Frame&) {};

TEST_F(Verify, ARecordingWithEventsIsRepeatedOnAnyNumberOfThreads) {
    for (const std::size_t hashes : {0U, 8U}) {
        const fs::path file = record(hashes, honest);
        const RecordingReader reader(file);
        EXPECT_EQ(reader.info().hashes_per_frame, hashes);
        for (const std::int64_t threads : {1, 3}) EXPECT_FALSE(verifyRecording(reader, threads).has_value());
    }
}

TEST_F(Verify, NamesTheFirstStepAndBodyThatDiffer) {
    // One bit of one velocity of the fastest body after frame 7, which ends with time step 56.
    const auto nudge = [](int i, SceneRun& run, Frame&) {
        if (i != 7) return;
        const BodyId id = *std::ranges::max_element(
            run.ids(), {}, [&](BodyId body) { return run.world().linearVelocity(body).norm(); });
        const Vec3 v = run.world().linearVelocity(id);
        run.world().setLinearVelocity(id, Vec3(std::nextafter(v.x(), 1.0), v.y(), v.z()));
    };
    for (const std::size_t hashes : {0U, 8U}) {
        const auto difference = verifyRecording(RecordingReader(record(hashes, nudge)));
        ASSERT_TRUE(difference.has_value());
        EXPECT_EQ(difference->step, hashes > 0 ? 57 : 64);
        ASSERT_TRUE(difference->body.has_value());
        EXPECT_NE(difference->what.find("recorded: position ("), std::string::npos);
    }
}

TEST_F(Verify, AFrameThatWasChangedNamesItsBody) {
    const auto forge = [](int i, SceneRun&, Frame& frame) {
        if (i == 20) frame.position[9].z() = std::nextafter(frame.position[9].z(), 10.0);
    };
    const auto difference = verifyRecording(RecordingReader(record(8, forge)));
    ASSERT_TRUE(difference.has_value());
    EXPECT_EQ(difference->step, 160);
    EXPECT_EQ(difference->body, 9U);
}

TEST_F(Verify, AHashThatWasChangedNamesItsStep) {
    const auto forge = [](int i, SceneRun&, Frame& frame) {
        if (i == 20) frame.step_hashes[2] ^= 1U;
    };
    const auto difference = verifyRecording(RecordingReader(record(8, forge)));
    ASSERT_TRUE(difference.has_value());
    EXPECT_EQ(difference->step, 155);
    EXPECT_FALSE(difference->body.has_value());
}

TEST_F(Verify, ANumberOfHashesThatWasNotAgreedIsRefused) {
    EXPECT_THROW(record(5, honest), InputError);
}

}  // namespace
}  // namespace cairn
