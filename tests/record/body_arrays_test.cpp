/// Bodies that stand in HDF5 files.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <fstream>
#include <string>
#include <vector>

#include "recording_fixture.h"

namespace cairn {
namespace {

constexpr const char* scene_text = R"({"name":"grains","duration":1,"gravity":[0,0,-10],
"materials":{"oak":{"density":800}},
"templates":{"ball":{"shape":{"type":"sphere","radius":0.1},"material":"oak","linear_damping":0.5},
"heavy":{"shape":{"type":"sphere","radius":0.1},"material":"oak","mass":3},
"bare":{"material":"oak"},
"crate":{"shape":{"type":"box","size":[0.1,0.2,0.3]},"material":"oak"}},
"bodies":[{"shape":{"type":"plane","normal":[0,0,1],"offset":0},"material":"oak","fixed":true}]REST})";

/// An HDF5 file, of which groups and arrays are made.
class Arrays {
  public:
    explicit Arrays(const std::filesystem::path& path)
        : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
    ~Arrays() { H5Fclose(file_); }
    Arrays(const Arrays&) = delete;
    Arrays& operator=(const Arrays&) = delete;

    void add(const char* group, const char* name, const std::vector<double>& values, hsize_t columns) const {
        const hid_t at = H5Lexists(file_, group, H5P_DEFAULT) > 0
                             ? H5Gopen2(file_, group, H5P_DEFAULT)
                             : H5Gcreate2(file_, group, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        const std::vector<hsize_t> extents{values.size() / columns, columns};
        const hid_t space = H5Screate_simple(columns == 1 ? 1 : 2, extents.data(), nullptr);
        const hid_t set = H5Dcreate2(at, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        H5Dclose(set);
        H5Sclose(space);
        H5Gclose(at);
    }

  private:
    hid_t file_;
};

class BodyArrays : public testing::Test {
  protected:
    void writeScene(const std::string& rest = "") const {
        std::string text = scene_text;
        std::ofstream(folder_ / "scene.json") << text.replace(text.find("REST"), 4, rest);
    }
    SceneSource read() const { return readSceneSource(folder_ / "scene.json", folder_ / "bodies.h5"); }
    std::string refusal() const {
        return test::messageOf<InputError>([&] { read(); });
    }

    test::TemporaryFolder folder_;
};

/// Rows 0, 1, 2 … of numbers that tell where they stand.
std::vector<double> rows(std::size_t count, std::size_t columns) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count * columns; ++i) values.push_back(0.25 * static_cast<double>(i));
    return values;
}

TEST_F(BodyArrays, AreToldAfterTheBodiesOfTheScene) {
    constexpr std::size_t count = 10000;  // more than a slice
    writeScene();
    {
        const Arrays arrays(folder_ / "bodies.h5");
        arrays.add("crate", "position", {5, 6, 7}, 3);
        arrays.add("crate", "orientation", {0, 1, 0, 0}, 4);
        arrays.add("crate", "linear_velocity", {1, 2, 3}, 3);
        arrays.add("crate", "angular_velocity", {4, 5, 6}, 3);
        arrays.add("ball", "position", rows(count, 3), 3);
        std::vector<double> scale(count, 1.0);
        scale.back() = 2;
        arrays.add("ball", "scale", scale, 1);
    }
    const SceneSource source = read();
    EXPECT_TRUE(source.isTold());
    const Scene scene = source.whole();
    ASSERT_EQ(scene.bodies.size(), 1 + count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        const double x = 0.75 * static_cast<double>(i);
        ASSERT_EQ(scene.bodies[1 + i].position, Vec3(x, x + 0.25, x + 0.5));
        ASSERT_EQ(std::get<Sphere>(scene.bodies[1 + i].shape).radius, i + 1 == count ? 0.2 : 0.1);
    }
    EXPECT_EQ(scene.bodies[1].linear_damping, 0.5);
    const SceneBody& crate = scene.bodies.back();
    EXPECT_EQ(std::get<Box>(crate.shape).size, Vec3(0.1, 0.2, 0.3));
    EXPECT_EQ(crate.orientation.coeffs(), Quat(0, 1, 0, 0).coeffs());
    EXPECT_EQ(crate.linear_velocity, Vec3(1, 2, 3));
    EXPECT_EQ(crate.angular_velocity, Vec3(4, 5, 6));
    EXPECT_EQ(formatScene(source), formatScene(scene));
}

TEST_F(BodyArrays, OfOtherShapesAreRefused) {
    writeScene();
    const auto write = [&](const char* group, const char* name, const std::vector<double>& values, hsize_t columns) {
        const Arrays arrays(folder_ / "bodies.h5");
        arrays.add(group, "position", {5, 6, 7}, 3);
        arrays.add(group, name, values, columns);
    };
    const auto refused = [&](const char* group, const char* name, const std::vector<double>& values, hsize_t columns) {
        write(group, name, values, columns);
        return refusal();
    };
    EXPECT_NE(refused("stone", "scale", {1}, 1).find("known are ball, bare, crate, heavy"), std::string::npos);
    EXPECT_NE(refused("bare", "scale", {1}, 1).find("needs a template with a shape"), std::string::npos);
    EXPECT_NE(refused("heavy", "scale", {1}, 1).find("leave them to the density"), std::string::npos);
    EXPECT_NE(refused("ball", "scale", {1, 1}, 1).find("'ball/scale' is of 2 bodies"), std::string::npos);
    EXPECT_NE(refused("ball", "scale", {-1}, 1).find("row 0 of 'ball/scale'"), std::string::npos);
    EXPECT_NE(refused("ball", "orientation", {1, 2, 3}, 3).find("a row of 4"), std::string::npos);
    write("heavy", "linear_velocity", {1, 2, 3}, 3);
    EXPECT_EQ(read().whole().bodies.size(), 2U);
    writeScene(R"(,"includes":[])");
    EXPECT_NE(refusal().find("cannot take bodies"), std::string::npos);
    std::filesystem::remove(folder_ / "bodies.h5");
    writeScene();
    EXPECT_THROW(read(), IoError);
    { const Arrays none(folder_ / "bodies.h5"); }
    EXPECT_EQ(read().whole().bodies.size(), 1U);
}

}  // namespace
}  // namespace cairn
