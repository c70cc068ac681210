#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <sstream>

#include "record/recording_fixture.h"

namespace cairn::test {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
    return parts;
}

double toNumber(const std::string& text) {
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    EXPECT_TRUE(result.ec == std::errc{} && result.ptr == text.data() + text.size()) << text;
    return value;
}

TEST(CsvExport, givesBackEveryDigitOfEveryBodyInEveryFrame) {
    const TemporaryFolder folder;
    recordFrames(folder / "a.h5", 3);
    exportCsv(RecordingReader(folder / "a.h5"), folder / "a.csv");
    const std::vector<std::string> lines = split(readWhole(folder / "a.csv"), '\n');
    ASSERT_EQ(lines.size(), 1U + 3 * 4);
    EXPECT_EQ(lines[0], "frame,time,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,asleep");
    for (std::size_t f = 0; f < 3; ++f) {
        const Frame frame = madeUpFrame(f, 4);
        for (std::size_t b = 0; b < 4; ++b) {
            const std::vector<std::string> cells = split(lines[1 + f * 4 + b], ',');
            const Quat& q = frame.orientation[b];
            const Vec3 p = frame.position[b];
            const Vec3 v = frame.linear_velocity[b];
            const Vec3 w = frame.angular_velocity[b];
            const std::array<double, 17> expected = {static_cast<double>(f),
                                                     frame.time,
                                                     static_cast<double>(b),
                                                     p.x(),
                                                     p.y(),
                                                     p.z(),
                                                     q.w(),
                                                     q.x(),
                                                     q.y(),
                                                     q.z(),
                                                     v.x(),
                                                     v.y(),
                                                     v.z(),
                                                     w.x(),
                                                     w.y(),
                                                     w.z(),
                                                     static_cast<double>(frame.asleep[b])};
            ASSERT_EQ(cells.size(), expected.size());
            for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(toNumber(cells[i]), expected[i]) << i;
        }
    }
}

TEST(CsvExport, writesRemovedBodiesAsNotANumber) {
    const TemporaryFolder folder;
    const Scene scene = smallScene();
    Frame frame = madeUpFrame(0, 4);
    frame.position[1] = Vec3::Constant(std::nan(""));
    RecordingWriter writer(folder / "a.h5", scene, settingsFor(scene));
    writer.append(frame);
    writer.close();
    exportCsv(RecordingReader(folder / "a.h5"), folder / "a.csv");
    EXPECT_TRUE(split(readWhole(folder / "a.csv"), '\n').at(2).starts_with("0,0,1,nan,nan,nan,"));
}

TEST(CsvExport, reportsAFullDiskAndAMissingFolder) {
    const TemporaryFolder folder;
    recordFrames(folder / "a.h5", 30);
    const RecordingReader reader(folder / "a.h5");
    EXPECT_EQ(messageOf<IoError>([&] { exportCsv(reader, "/dev/full"); }),
              "/dev/full: cannot be written: No space left on device");
    const std::string path = (folder / "no/a.csv").string();
    EXPECT_EQ(messageOf<IoError>([&] { exportCsv(reader, path); }),
              path + ": cannot be written: No such file or directory");
}

/// The value of an attribute of the first element after a place that has it.
std::string attribute(const std::string& xml, const std::string& name, std::size_t from = 0) {
    const std::size_t begin = xml.find(" " + name + "=\"", from);
    if (begin == std::string::npos) return {};
    const std::size_t value = begin + name.size() + 3;
    return xml.substr(value, xml.find('"', value) - value);
}

/// A .vtp file taken apart as VTK does it: descriptions, then blocks of a size and bytes.
class Vtp {
  public:
    explicit Vtp(const std::filesystem::path& file) : text_(readWhole(file)) {
        const std::string marker = "<AppendedData encoding=\"raw\">\n_";
        data_ = text_.find(marker) + marker.size();
        points = std::stoul(attribute(text_, "NumberOfPoints"));
        polygons = std::stoul(attribute(text_, "NumberOfPolys"));
    }

    template <typename Value>
    std::vector<Value> array(const std::string& name, const std::string& type) {
        const std::size_t at = text_.find("Name=\"" + name + "\"");
        EXPECT_NE(at, std::string::npos) << name;
        EXPECT_EQ(attribute(text_, "type", text_.rfind('<', at)), type);
        const std::size_t block = data_ + std::stoul(attribute(text_, "offset", at));
        std::uint64_t size = 0;
        std::memcpy(&size, text_.data() + block, sizeof(size));
        EXPECT_LE(block + sizeof(size) + size, text_.size());
        end_ = std::max(end_, block + sizeof(size) + size);
        std::vector<Value> values(size / sizeof(Value));
        std::memcpy(values.data(), text_.data() + block + sizeof(size), size);
        return values;
    }

    /// What follows the last array that was read.
    std::string rest() const { return text_.substr(end_); }

    std::size_t points = 0;
    std::size_t polygons = 0;

  private:
    std::string text_;
    std::size_t data_ = 0;
    std::size_t end_ = 0;
};

/// Volume of the closed surface that a body's polygons make, and their number.
struct BodySurface {
    double volume = 0;
    std::size_t polygons = 0;
};

TEST(VtkExport, drawsEveryBodyClosedWhereItIs) {
    const TemporaryFolder folder;
    recordFrames(folder / "a.h5", 3);
    const RecordingReader reader(folder / "a.h5");
    exportVtk(reader, folder / "out.pvd");
    Vtp vtp(folder / "out/out_000002.vtp");
    const auto points = vtp.array<float>("Points", "Float32");
    const auto corners = vtp.array<std::int32_t>("connectivity", "Int32");
    const auto ends = vtp.array<std::int32_t>("offsets", "Int32");
    const auto body = vtp.array<std::int32_t>("body", "Int32");
    const auto material = vtp.array<std::int32_t>("material", "Int32");
    const auto asleep = vtp.array<std::uint8_t>("asleep", "UInt8");
    const auto fixed = vtp.array<std::uint8_t>("fixed", "UInt8");
    const auto speed = vtp.array<float>("speed", "Float32");
    EXPECT_EQ(vtp.rest(), "\n</AppendedData>\n</VTKFile>\n");
    ASSERT_EQ(points.size(), 3 * vtp.points);
    ASSERT_EQ(ends.size(), vtp.polygons);
    for (const std::size_t size : {body.size(), material.size(), asleep.size(), fixed.size(), speed.size()}) {
        ASSERT_EQ(size, vtp.polygons);
    }
    const Frame frame = reader.frame(2);
    const auto point = [&](std::int32_t i) {
        const auto at = static_cast<std::size_t>(i) * 3;
        return Vec3(points.at(at), points.at(at + 1), points.at(at + 2));
    };
    std::array<BodySurface, 4> surfaces;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const auto b = static_cast<std::size_t>(body[i]);
        ASSERT_LT(b, surfaces.size());
        ++surfaces[b].polygons;
        const std::size_t begin = i == 0 ? 0 : static_cast<std::size_t>(ends[i - 1]);
        const auto end = static_cast<std::size_t>(ends[i]);
        ASSERT_GE(end, begin + 3);
        // The divergence theorem, with tetrahedra from the body's centre: positive only if seen from outside.
        const Vec3 origin = frame.position[b];
        const Vec3 first = point(corners.at(begin)) - origin;
        for (std::size_t c = begin + 1; c + 1 < end; ++c) {
            const Vec3 second = point(corners.at(c)) - origin;
            const Vec3 third = point(corners.at(c + 1)) - origin;
            const double volume = first.dot(second.cross(third)) / 6;
            if (b != 0) {
                EXPECT_GT(volume, 0) << "polygon " << i;
            }
            surfaces[b].volume += volume;
        }
        EXPECT_EQ(material[i], b == 0 ? 0 : 1);
        EXPECT_EQ(asleep[i], frame.asleep[b]);
        EXPECT_EQ(fixed[i], b == 0 ? 1 : 0);
        EXPECT_NEAR(speed[i], frame.linear_velocity[b].norm(), 1e-4);
    }
    EXPECT_EQ(surfaces[0].polygons, 1U);
    EXPECT_EQ(surfaces[1].polygons, 6U);
    EXPECT_NEAR(surfaces[1].volume, 0.2 * 0.4 * 0.6, 1e-4);
    // Flat polygons inside a round body: less than its volume, but not much.
    const double ball = 4.0 / 3 * std::numbers::pi * 0.25 * 0.25 * 0.25;
    EXPECT_LT(surfaces[2].volume, ball);
    EXPECT_GT(surfaces[2].volume, 0.85 * ball);
    const double capsule = 4.0 / 3 * std::numbers::pi * 0.1 * 0.1 * 0.1 + std::numbers::pi * 0.1 * 0.1 * 0.5;
    EXPECT_LT(surfaces[3].volume, capsule);
    EXPECT_GT(surfaces[3].volume, 0.85 * capsule);
}

TEST(VtkExport, drawsPlanesUnderAllBodies) {
    const TemporaryFolder folder;
    Scene scene = smallScene();
    scene.bodies[0].shape = HalfSpace{Vec3(0, 0, 2), 0.5};  // the normal may have any length
    scene.bodies[3].position = Vec3(40, -30, 5);
    SceneRun run(scene, settingsFor(scene));
    RecordingWriter writer(folder / "a.h5", scene, settingsFor(scene));
    writer.append(captureFrame(run, {}));
    writer.close();
    exportVtk(RecordingReader(folder / "a.h5"), folder / "out");
    const auto points = Vtp(folder / "out/out_000000.vtp").array<float>("Points", "Float32");
    Eigen::AlignedBox3d square;
    for (std::size_t i = 0; i < 4; ++i) square.extend(Vec3(points[3 * i], points[3 * i + 1], points[3 * i + 2]));
    EXPECT_EQ(square.min().z(), 0.5);
    EXPECT_EQ(square.max().z(), 0.5);
    EXPECT_TRUE(square.contains(Vec3(0, 0, 0.5)));
    EXPECT_TRUE(square.contains(Vec3(40, -30, 0.5)));
}

TEST(VtkExport, listsEveryFrameWithItsTime) {
    const TemporaryFolder folder;
    recordFrames(folder / "a.h5", 4);
    const RecordingReader reader(folder / "a.h5");
    exportVtk(reader, folder / "a & <b>");  // OUT stands for OUT.pvd
    const std::string pvd = readWhole(folder / "a & <b>.pvd");
    std::size_t at = 0;
    for (std::size_t f = 0; f < 4; ++f) {
        at = pvd.find("<DataSet ", at + 1);
        ASSERT_NE(at, std::string::npos);
        EXPECT_EQ(toNumber(attribute(pvd, "timestep", at)), reader.frame(f).time);
        const std::string name = "a & <b>/a & <b>_00000" + std::to_string(f) + ".vtp";
        EXPECT_TRUE(std::filesystem::exists(folder / name));
        EXPECT_EQ(attribute(pvd, "file", at), "a &amp; &lt;b>/a &amp; &lt;b>_00000" + std::to_string(f) + ".vtp");
    }
    EXPECT_EQ(pvd.find("<DataSet ", at + 1), std::string::npos);
}

TEST(VtkExport, leavesOutRemovedBodies) {
    const TemporaryFolder folder;
    const Scene scene = smallScene();
    Frame frame = madeUpFrame(0, 4);
    frame.position[1] = Vec3::Constant(std::nan(""));
    RecordingWriter writer(folder / "a.h5", scene, settingsFor(scene));
    writer.append(frame);
    writer.close();
    exportVtk(RecordingReader(folder / "a.h5"), folder / "a.pvd");
    const auto body = Vtp(folder / "a/a_000000.vtp").array<std::int32_t>("body", "Int32");
    for (const std::int32_t b : body) EXPECT_NE(b, 1);
    EXPECT_EQ(body.back(), 3);
}

TEST(VtkExport, reportsAFolderThatCannotBeMade) {
    const TemporaryFolder folder;
    recordFrames(folder / "a.h5", 1);
    std::ofstream(folder / "out") << "a file where the folder should be";
    const std::string message =
        messageOf<IoError>([&] { exportVtk(RecordingReader(folder / "a.h5"), folder / "out.pvd"); });
    EXPECT_TRUE(contains(message, (folder / "out").string() + ": cannot be made: ")) << message;
}

}  // namespace
}  // namespace cairn::test
