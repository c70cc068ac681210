/// Concave solids in scene files.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "scene_testing.h"
#include "solid_maker.h"

namespace cairn {
namespace {

/// A solid with the triangles of an angle of three cubes and further members.
std::string angleShape(std::string_view rest, std::size_t left_out = 0) {
    const testing::Triangles angle = testing::cubes({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
    std::string vertices;
    std::string indices;
    for (const Vec3& v : angle.vertices) vertices += fmt::format(",[{},{},{}]", v.x(), v.y(), v.z());
    for (std::size_t i = left_out; i < angle.corners.size(); ++i) {
        indices += fmt::format(",[{},{},{}]", angle.corners[i][0], angle.corners[i][1], angle.corners[i][2]);
    }
    return fmt::format(R"({{"type":"solid","vertices":[{}],"indices":[{}]{}}})", vertices.substr(1), indices.substr(1),
                       rest);
}

std::string sceneOf(std::string_view shape) {
    return testing::sceneWithBody(fmt::format(R"({{"shape":{},"material":"oak","position":[0,0,9]}})", shape));
}

const Compound& compoundOf(const Scene& scene) {
    return std::get<Compound>(scene.bodies.at(3).shape);
}

TEST(SolidInAScene, BecomesACompoundThatIsWrittenAndReadAsItIs) {
    const Scene scene = parseScene(sceneOf(angleShape(R"(,"scale":0.5)")), "test.json");
    EXPECT_EQ(compoundOf(scene).parts.size(), 2U);
    EXPECT_NEAR(compoundOf(scene).solid->volume, 3.0 / 8, 1e-15);
    const std::string text = formatScene(scene);
    const Scene again = parseScene(text, "again.json");
    EXPECT_EQ(formatScene(again), text);
    EXPECT_EQ(compoundOf(again).solid->inertia, compoundOf(scene).solid->inertia);
    EXPECT_EQ(compoundOf(again).solid->centre, compoundOf(scene).solid->centre);
    EXPECT_EQ(compoundOf(again).solid->volume, compoundOf(scene).solid->volume);
}

TEST(SolidInAScene, TakesItsOptions) {
    const Scene one = parseScene(sceneOf(angleShape(R"(,"most_parts":1)")), "test.json");
    EXPECT_EQ(compoundOf(one).parts.size(), 1U);
    const Scene coarse = parseScene(sceneOf(angleShape(R"(,"largest_error":0.2)")), "test.json");
    EXPECT_EQ(compoundOf(coarse).parts.size(), 1U);
    const Scene hull = parseScene(sceneOf(angleShape(R"(,"hull_if_open":true)", 1)), "test.json");
    EXPECT_FALSE(compoundOf(hull).solid.has_value());
}

TEST(SolidInAScene, IsRefusedWithWhatIsWrong) {
    const auto refusal = [](std::string_view shape) { return testing::parseMessage(sceneOf(shape)); };
    EXPECT_NE(
        refusal(angleShape("", 1)).find("bodies[3].shape is refused: a mesh is not watertight: it has 3 open edges"),
        std::string::npos)
        << refusal(angleShape("", 1));
    EXPECT_NE(refusal(angleShape(R"(,"most_parts":0)")).find("most_parts"), std::string::npos);
    EXPECT_NE(refusal(angleShape(R"(,"largest_error":2)")).find("largest_error is 2"), std::string::npos);
    EXPECT_NE(refusal(R"({"type":"solid"})").find("either file or vertices"), std::string::npos);
    EXPECT_NE(refusal(R"({"type":"solid","file":"no.stl"})").find("no.stl"), std::string::npos);
    const auto compound = [](std::string_view solid) {
        return fmt::format(R"({{"type":"compound","parts":[{{"shape":{{"type":"sphere","radius":1}}}}],"solid":{}}})",
                           solid);
    };
    EXPECT_NE(refusal(compound(R"({"volume":1,"centre_of_mass":[0,0,0],"inertia":[1,1,3]})")).find("that of no body"),
              std::string::npos);
    EXPECT_NE(refusal(compound(R"({"volume":0,"centre_of_mass":[0,0,0],"inertia":[1,1,1]})")).find("solid.volume"),
              std::string::npos);
}

}  // namespace
}  // namespace cairn
