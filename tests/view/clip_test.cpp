/// @file Clips hold what the recording holds, to the accuracy they promise.
#include "view/clip.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "temporary_folder.h"
#include "view/gzip.h"
#include "view/html_export.h"

namespace cairn::view {
namespace {

/// Undoes what clip.cpp does, written from docs/view-protocol.md.
class ClipReader {
  public:
    explicit ClipReader(const std::string& clip) : bytes_(gunzip(clip)) {
        EXPECT_EQ(bytes_.substr(0, 8), "CAIRNCLP");
        at_ = 8;
        EXPECT_EQ(number<std::uint32_t>(), 3U);
        const auto size = number<std::uint32_t>();
        header = nlohmann::json::parse(bytes_.substr(at_, size));
        at_ += size;
        for (std::string& stream : streams) {
            const auto length = number<std::uint64_t>();
            stream = bytes_.substr(at_, length);
            at_ += length;
        }
        EXPECT_EQ(at_, bytes_.size());
    }

    /// @return [row][component·bodies + body]
    static std::vector<std::vector<double>> rows(const std::string& stream, std::size_t width, double unit, int order) {
        std::vector<std::vector<std::int64_t>> whole;
        std::size_t at = 0;
        while (at < stream.size()) {
            std::vector<std::int64_t> row(width);
            for (std::size_t i = 0; i < width; ++i) {
                std::uint64_t zigzag = 0;
                for (int shift = 0;; shift += 7) {
                    const auto byte = static_cast<unsigned char>(stream.at(at++));
                    zigzag |= static_cast<std::uint64_t>(byte & 127U) << shift;
                    if (byte < 128) break;
                }
                const auto difference =
                    static_cast<std::int64_t>(zigzag >> 1) ^ -static_cast<std::int64_t>(zigzag & 1U);
                const std::size_t n = whole.size();
                std::int64_t predicted = n == 0 ? 0 : whole[n - 1][i];
                if (order == 2 && n > 1) predicted += whole[n - 1][i] - whole[n - 2][i];
                row[i] = predicted + difference;
            }
            whole.push_back(row);
        }
        std::vector<std::vector<double>> out;
        for (const auto& row : whole) {
            out.emplace_back();
            for (const std::int64_t value : row) out.back().push_back(static_cast<double>(value) * unit);
        }
        return out;
    }

    nlohmann::json header;
    std::array<std::string, 8>
        streams;  ///< times, flags, positions, orientations, velocities, spins, samples, contacts

  private:
    template <typename Number>
    Number number() {
        Number value;
        std::memcpy(&value, bytes_.data() + at_, sizeof(Number));
        at_ += sizeof(Number);
        return value;
    }

    std::string bytes_;
    std::size_t at_ = 0;
};

class Clip : public testing::Test {
  protected:
    std::filesystem::path record(const Scene& scene, int steps, const RecordingOptions& options = {}) {
        const auto file = folder_ / "run.h5";
        const Settings settings = settingsFor(scene);
        SceneRun run(scene, settings);
        RecordingWriter writer(file, scene, settings, options);
        writer.append(captureFrame(run, {}, options));
        for (int i = 0; i < steps; ++i) {
            const Statistics statistics = run.simulationStep();
            writer.append(captureFrame(run, statistics, options));
        }
        writer.close();
        return file;
    }

  private:
    test::TemporaryFolder folder_;
};

TEST_F(Clip, KeepsPosesMotionAndFlagsOfEveryFrame) {
    const auto file = record(builtInScene("tower:6"), 20);
    const RecordingReader recording(file);
    const ClipReader clip(makeClip(recording));
    const std::size_t n = recording.info().bodies;
    EXPECT_EQ(clip.header["frames"], recording.info().frames);
    ASSERT_EQ(clip.header["bodies"].size(), n);
    EXPECT_NEAR(clip.header["bodies"][n - 1]["mass"].get<double>(),
                SceneRun(recording.info().scene, settingsFor(recording.info().scene))
                    .world()
                    .mass(BodyId{static_cast<std::uint32_t>(n - 1), 0}),
                1e-9);
    const auto positions = ClipReader::rows(clip.streams[2], 3 * n, ClipUnits::position, 2);
    const auto orientations = ClipReader::rows(clip.streams[3], 4 * n, ClipUnits::orientation, 1);
    const auto velocities = ClipReader::rows(clip.streams[4], 3 * n, ClipUnits::velocity, 1);
    const auto spins = ClipReader::rows(clip.streams[5], 3 * n, ClipUnits::spin, 1);
    ASSERT_EQ(positions.size(), recording.info().frames);
    for (std::size_t f = 0; f < recording.info().frames; ++f) {
        const Frame frame = recording.frame(f);
        for (std::size_t body = 0; body < n; ++body) {
            Quat q;
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_NEAR(positions[f][k * n + body], frame.position[body][static_cast<int>(k)],
                            0.51 * ClipUnits::position);
                EXPECT_NEAR(velocities[f][k * n + body], frame.linear_velocity[body][static_cast<int>(k)],
                            0.51 * ClipUnits::velocity);
                EXPECT_NEAR(spins[f][k * n + body], frame.angular_velocity[body][static_cast<int>(k)],
                            0.51 * ClipUnits::spin);
            }
            for (std::size_t k = 0; k < 4; ++k) q.coeffs()[static_cast<int>(k)] = orientations[f][k * n + body];
            EXPECT_LT(q.normalized().angularDistance(frame.orientation[body]), 2e-3);
            const auto flags = static_cast<unsigned char>(clip.streams[1][f * n + body]);
            EXPECT_EQ(flags & 1U, 1U);
            EXPECT_EQ((flags & 2U) != 0, frame.asleep[body] != 0);
            EXPECT_EQ((flags & 4U) != 0, recording.info().scene.bodies[body].fixed);
        }
    }
}

TEST_F(Clip, MarksRemovedBodies) {
    Scene scene = builtInScene("tower:3");
    const std::size_t last = scene.bodies.size() - 1;
    scene.events.push_back({0.2, RemoveBody{last}});
    const auto file = record(scene, 12);
    const RecordingReader recording(file);
    const ClipReader clip(makeClip(recording));
    EXPECT_EQ(clip.streams[1][last] & 1, 1);
    EXPECT_EQ(clip.streams[1][12 * scene.bodies.size() + last] & 1, 0);
}

/// A place of the header: in the frame of a body, or of the world.
Vec3 placed(const nlohmann::json& body, const nlohmann::json& point, const Frame& frame) {
    const Vec3 local(point[0], point[1], point[2]);
    if (body.is_null()) return local;
    const auto i = body.get<std::size_t>();
    return frame.position[i] + frame.orientation[i] * local;
}

TEST_F(Clip, PlacesJointsByTheirBodies) {
    const Scene scene = builtInScene("cradle_swing:3:1");
    const auto file = record(scene, 10);
    const RecordingReader recording(file);
    const ClipReader clip(makeClip(recording));
    const nlohmann::json& joints = clip.header["joints"];
    ASSERT_EQ(joints.size(), scene.joints.size());
    ASSERT_GT(joints.size(), 0U);
    const Frame frame = recording.frame(10);
    for (const nlohmann::json& joint : joints) {
        EXPECT_EQ(joint["kind"], static_cast<int>(JointKind::hinge));
        EXPECT_EQ(joint["breaks"], false);
        const Vec3 gap = placed(joint["a"], joint["anchorA"], frame) - placed(joint["b"], joint["anchorB"], frame);
        EXPECT_LT(gap.norm(), 1e-5);
    }
}

TEST_F(Clip, ThePageHoldsTheClip) {
    const auto file = record(builtInScene("tower:3"), 3);
    const auto html = std::filesystem::path(file).replace_extension(".html");
    exportHtml(RecordingReader(file), html);
    EXPECT_GT(std::filesystem::file_size(html), 300000U);
    EXPECT_LT(std::filesystem::file_size(html), 2000000U);
    EXPECT_THROW(exportHtml(RecordingReader(file), "/nonexistent/folder/a.html"), IoError);
}

TEST_F(Clip, HasContactsSensorsAndLaws) {
    const Scene scene =
        parseScene(R"({"name":"c","duration":1,"gravity":[0,0,-10],"materials":{"oak":{"density":800}},"bodies":[
        {"shape":{"type":"plane","normal":[0,0,1],"offset":0},"material":"oak","fixed":true},
        {"shape":{"type":"sphere","radius":0.1},"material":"oak","position":[0,0,0.1]},
        {"shape":{"type":"box","size":[1,1,1]},"material":"oak","fixed":true,"sensor":true},
        {"shape":{"type":"box","size":[1,1,1]},"material":"oak","position":[9,0,0],"fixed":true,
         "motion":{"type":"constant","spin":[0,0,2]},"surface_velocity":[1,0,0]}]})",
                   "c");
    const auto file = record(scene, 1, {.contacts = true});
    const ClipReader clip(makeClip(RecordingReader(file)));
    EXPECT_TRUE(clip.header.at("contacts").get<bool>());
    ASSERT_EQ(clip.streams[7].size(), 4U + 4 + 48) << "none in the first frame, one in the second";
    std::array<std::uint32_t, 4> begin{};
    std::memcpy(begin.data(), clip.streams[7].data(), sizeof(begin));
    EXPECT_EQ(begin, (std::array<std::uint32_t, 4>{0, 1, 0, 1})) << "numbers, then bodies";
    const nlohmann::json& bodies = clip.header.at("bodies");
    EXPECT_FALSE(bodies.at(1).contains("sensor") || bodies.at(1).contains("law"));
    EXPECT_TRUE(bodies.at(2).at("sensor").get<bool>());
    EXPECT_EQ(bodies.at(3).at("law").at("spin"), nlohmann::json({0.0, 0.0, 2.0}));
    EXPECT_EQ(bodies.at(3).at("law").at("surface"), nlohmann::json({1.0, 0.0, 0.0}));
}

TEST(Gzip, RoundTripsAndRefusesBrokenData) {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += static_cast<char>(i * i % 251);
    const std::string packed = gzip(text);
    EXPECT_LT(packed.size(), text.size());
    EXPECT_EQ(gunzip(packed), text);
    EXPECT_EQ(gunzip(gzip("")), "");
    EXPECT_THROW(gunzip(packed.substr(0, packed.size() / 2)), IoError);
    EXPECT_THROW(gunzip("nothing of the kind"), IoError);
    EXPECT_THROW(gunzip(""), IoError);
}

}  // namespace
}  // namespace cairn::view
