/// Questions about surfaces against asking all their triangles one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "cairn/query.h"
#include "surface_maker.h"

namespace cairn {
namespace {

Mesh roughMesh(SurfaceSides sides = SurfaceSides::two) {
    const auto height = [](double x, double y) { return 0.2 * std::sin(4 * x) + 0.1 * std::cos(7 * y); };
    return testing::irregularMesh(12, 3, 4, height, sides);
}

/// Each triangle as a mesh of its own.
std::vector<Mesh> trianglesOf(const Mesh& mesh) {
    std::vector<Mesh> all;
    for (const TriangleCorners& t : mesh.triangles()) {
        const auto v = mesh.vertices();
        all.push_back(Mesh({v[t[0]], v[t[1]], v[t[2]]}, {{0, 1, 2}}, mesh.sides()));
    }
    return all;
}

const Pose tilted{Vec3(0.3, -0.2, 0.5), Quat(0.9, 0.1, -0.3, 0.2).normalized()};

TEST(SurfaceQueries, RaysHitTheNearestTriangle) {
    const Mesh mesh = roughMesh();
    const std::vector<Mesh> triangles = trianglesOf(mesh);
    testing::Random random(2);
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
        const Ray ray{random.vector(3), random.direction(), random.uniform(0.5, 6)};
        const auto hit = castRay(mesh, tilted, ray);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Mesh& triangle : triangles) {
            if (const auto one = castRay(triangle, tilted, ray)) nearest = std::min(nearest, one->distance);
        }
        ASSERT_EQ(hit.has_value(), nearest <= ray.reach) << i;
        if (!hit) continue;
        EXPECT_DOUBLE_EQ(hit->distance, nearest);
        EXPECT_LE(hit->normal.dot(ray.direction), 0);
        EXPECT_DOUBLE_EQ(castRay(triangles[hit->part], tilted, ray)->distance, nearest) << "the triangle is named";
        ++hits;
    }
    EXPECT_GT(hits, 10);
}

TEST(SurfaceQueries, ShapesAreClosestToTheNearestTriangleAndStopAtIt) {
    const Mesh mesh = roughMesh();
    const std::vector<Mesh> triangles = trianglesOf(mesh);
    testing::Random random(3);
    for (const auto& [name, shape] : testing::solids()) {
        for (int i = 0; i < 20; ++i) {
            const Pose pose{random.vector(2), random.orientation()};
            const Vec3 way = 4 * random.direction();
            double distance = std::numeric_limits<double>::infinity();
            double reach = distance;
            bool meet = false;
            for (const Mesh& triangle : triangles) {
                distance = std::min(distance, closestPoints(shape, pose, triangle, tilted).distance);
                meet = meet || overlap(shape, pose, triangle, tilted);
                if (const auto hit = castShape(shape, pose, way, triangle, tilted)) {
                    reach = std::min(reach, hit->distance);
                }
            }
            EXPECT_NEAR(closestPoints(shape, pose, mesh, tilted).distance, distance, 1e-9) << name;
            EXPECT_NEAR(closestPoints(mesh, tilted, shape, pose).distance, distance, 1e-9) << name;
            EXPECT_EQ(overlap(shape, pose, mesh, tilted), meet) << name;
            const auto hit = castShape(shape, pose, way, mesh, tilted);
            ASSERT_EQ(hit.has_value(), reach < std::numeric_limits<double>::infinity()) << name;
            if (hit) {
                EXPECT_NEAR(hit->distance, reach, 1e-7) << name;
            }
        }
    }
}

TEST(SurfaceQueries, ContactsNameTheTriangle) {
    const Mesh plane = testing::flatMesh(10, 2);
    const Pose pose{Vec3(0.1, 0.2, 0.0995), Quat::Identity()};
    const auto contacts = contactsOf(Box{{0.4, 0.3, 0.2}}, pose, plane, Pose{}, 1e-4);
    ASSERT_EQ(contacts.size(), 4U);
    for (const ShapeContact& contact : contacts) {
        EXPECT_EQ(contact.part_a, 0U);
        const Vec3 above = contact.point + Vec3(0, 0, 1);
        EXPECT_EQ(castRay(plane, Pose{}, {above, -Vec3::UnitZ()})->part, contact.part_b);
    }
    const auto swapped = contactsOf(plane, Pose{}, Box{{0.4, 0.3, 0.2}}, pose, 1e-4);
    ASSERT_EQ(swapped.size(), 4U);
    EXPECT_EQ(swapped[0].normal, -Vec3::UnitZ());
    EXPECT_TRUE(contactsOf(plane, Pose{}, HalfSpace{}, Pose{}, 1).empty());
}

TEST(SurfaceQueries, ASurfaceIsNotCast) {
    EXPECT_THROW(castShape(roughMesh(), Pose{}, Vec3(1, 0, 0), Sphere{1}, Pose{}), InputError);
    EXPECT_THROW(closestPoints(roughMesh(), Pose{}, HalfSpace{}, Pose{}), InputError);
}

}  // namespace
}  // namespace cairn
