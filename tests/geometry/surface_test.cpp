#include <gtest/gtest.h>

#include <limits>

#include "geometry/surface_data.h"
#include "surface_maker.h"

namespace cairn {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

std::string refusalOf(std::vector<Vec3> vertices, std::vector<TriangleCorners> triangles) {
    try {
        const Mesh mesh(std::move(vertices), std::move(triangles));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(Mesh, RefusesWhatIsNoSurface) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(refusalOf({{0, 0, 0}, {nan, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}).find("vertex 1"), std::string::npos);
    EXPECT_NE(refusalOf({{0, 0, 0}, {2e9, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}).find("within"), std::string::npos);
    EXPECT_NE(refusalOf(square, {{0, 1, 4}}).find("the vertex 4"), std::string::npos);
    EXPECT_NE(refusalOf(square, {}).find("no triangle"), std::string::npos);
    EXPECT_NE(refusalOf(square, {{0, 0, 1}}).find("no triangle"), std::string::npos);
    EXPECT_NE(refusalOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}).find("(1 without one)"), std::string::npos);
    EXPECT_NE(refusalOf(std::vector<Vec3>(1000, Vec3(1, 2, 3)), {{0, 1, 2}, {5, 6, 7}}).find("no triangle"),
              std::string::npos);
    EXPECT_THROW(Mesh(square, {{0, 1, 2}}, SurfaceSides::one, Vec3(1, -1, 1)), InputError);
    EXPECT_THROW(Mesh(square, {{0, 1, 2}}, SurfaceSides::one, Vec3(1, endless, 1)), InputError);
}

TEST(Mesh, MendsWhatItCan) {
    std::vector<Vec3> vertices = square;
    vertices.insert(vertices.end(), {{1, 1, 0}, {0, 0, -0.0}, {7, 7, 7}});
    // Given twice, without an area, and with corners at one place.
    const Mesh mesh(vertices, {{0, 1, 2}, {1, 2, 0}, {0, 4, 3}, {0, 1, 1}, {0, 5, 2}, {2, 4, 3}});
    EXPECT_EQ(mesh.triangles().size(), 2U);
    EXPECT_EQ(mesh.vertices().size(), 4U);
    EXPECT_EQ(mesh.repairs().duplicate, 1U);
    EXPECT_EQ(mesh.repairs().degenerate, 3U);
    EXPECT_EQ(mesh.repairs().welded, 3U);
    EXPECT_EQ(mesh.repairs().open_edges, 4U);
    const Mesh again({mesh.vertices().begin(), mesh.vertices().end()},
                     {mesh.triangles().begin(), mesh.triangles().end()});
    EXPECT_EQ(again.triangles()[1], mesh.triangles()[1]) << "what is mended stays as it is";
    EXPECT_EQ(again.repairs().welded + again.repairs().duplicate + again.repairs().degenerate, 0U);
}

TEST(Mesh, TrianglesInOnePlaneAreOneFace) {
    EXPECT_EQ(testing::flatMesh(20, 2).data().faces.size(), 1U);
    EXPECT_EQ(testing::boxMesh({1, 2, 3}).data().faces.size(), 6U);
    EXPECT_EQ(testing::boxMesh({1, 2, 3}).repairs().open_edges, 0U);
    EXPECT_EQ(testing::foldedMesh(0.1, 5).data().faces.size(), 2U);
    const Mesh tilted = testing::irregularMesh(20, 2, 3, [](double x, double y) { return 0.3 * x - 0.7 * y + 5; });
    EXPECT_EQ(tilted.data().faces.size(), 1U);
    // What is folded back lies in the same plane and is another face.
    EXPECT_EQ(Mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.9, 0.8, 0}}, {{0, 1, 2}, {0, 2, 1}}).data().faces.size(), 2U);
}

TEST(Mesh, TheSameTrianglesOfTwoSidesAreGivenOnce) {
    EXPECT_EQ(Mesh(square, {{0, 1, 2}, {0, 2, 1}}, SurfaceSides::two).triangles().size(), 1U);
    EXPECT_EQ(Mesh(square, {{0, 1, 2}, {0, 2, 1}}, SurfaceSides::one).triangles().size(), 2U);
}

TEST(Mesh, CountsItsMemory) {
    const Mesh mesh = testing::flatMesh(100, 1);
    const double per_triangle = static_cast<double>(mesh.bytes()) / static_cast<double>(mesh.triangles().size());
    EXPECT_GT(per_triangle, 150);
    EXPECT_LT(per_triangle, 220);
}

TEST(HeightField, IsATriangulatedGridAboutTheOrigin) {
    const HeightField field(3, {0, 1, 2, 3, 4, 5}, {0.5, 2});
    EXPECT_EQ(field.rows(), 2U);
    EXPECT_EQ(field.triangles().size(), 4U);
    EXPECT_EQ(field.vertices()[0], Vec3(-0.5, -1, 0));
    EXPECT_EQ(field.vertices()[5], Vec3(0.5, 1, 5));
    for (std::uint32_t t = 0; t < 4; ++t) EXPECT_GT(field.data().face(t).normal.z(), 0);
}

TEST(HeightField, RefusesWhatFillsNoGrid) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(HeightField(1, {0, 0}, {1, 1}), InputError);
    EXPECT_THROW(HeightField(0, {0, 0}, {1, 1}), InputError);
    EXPECT_THROW(HeightField(2, {0, 0}, {1, 1}), InputError);
    EXPECT_THROW(HeightField(2, {0, 0, 0}, {1, 1}), InputError);
    EXPECT_THROW(HeightField(2, {0, 0, 0, nan}, {1, 1}), InputError);
    EXPECT_THROW(HeightField(2, {0, 0, 0, 0}, {1, 0}), InputError);
    EXPECT_THROW(HeightField(2, {0, 0, 0, 0}, {1, endless}), InputError);
}

TEST(Mesh, NoRayPassesBetweenTriangles) {
    // Aimed at vertices and at points of edges, as exactly as they can be.
    const Mesh mesh = testing::irregularMesh(10, 2, 7, [](double x, double y) { return 0.2 * x * y; });
    testing::Random random(5);
    for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& a = mesh.data().corner(t, k);
            const Vec3& b = mesh.data().corner(t, (k + 1) % 3);
            const Vec3 aim = random.below(3) == 0 ? a : Vec3(a + random.uniform(0, 1) * (b - a));
            if (std::max(std::abs(aim.x()), std::abs(aim.y())) > 0.999) continue;
            const Vec3 origin = aim + Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 3);
            const auto hit = castRay(mesh, {origin, (aim - origin).normalized()});
            ASSERT_TRUE(hit) << t;
            EXPECT_NEAR(hit->distance, (aim - origin).norm(), 1e-9);
        }
    }
}

TEST(Mesh, OfOneSideIsSeenFromThereOnly) {
    const LocalRay down{{0.1, 0.2, 1}, -Vec3::UnitZ()};
    const LocalRay up{{0.1, 0.2, -1}, Vec3::UnitZ()};
    EXPECT_TRUE(castRay(testing::flatMesh(4, 2), down));
    EXPECT_FALSE(castRay(testing::flatMesh(4, 2), up));
    const Mesh two = testing::irregularMesh(
        4, 2, 1, [](double, double) { return 0.0; }, SurfaceSides::two);
    EXPECT_EQ(castRay(two, down)->normal, Vec3::UnitZ());
    EXPECT_EQ(castRay(two, up)->normal, -Vec3::UnitZ());
}

TEST(Mesh, FeaturesOfATriangle) {
    using Kind = TriangleFeature::Kind;
    const std::array<Vec3, 3> corners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    EXPECT_EQ(closestOnTriangle(corners, {0.2, 0.2, 1}).feature.kind, Kind::inside);
    EXPECT_EQ(closestOnTriangle(corners, {0.5, -1, 1}).feature.kind, Kind::edge);
    EXPECT_EQ(closestOnTriangle(corners, {0.5, -1, 1}).feature.index, 0);
    EXPECT_EQ(closestOnTriangle(corners, {1, 1, 1}).feature.index, 1);
    EXPECT_EQ(closestOnTriangle(corners, {-1, 0.5, 1}).feature.index, 2);
    EXPECT_EQ(closestOnTriangle(corners, {2, -1, 1}).feature.kind, Kind::corner);
    EXPECT_EQ(closestOnTriangle(corners, {2, -1, 1}).point, corners[1]);
}

}  // namespace
}  // namespace cairn
