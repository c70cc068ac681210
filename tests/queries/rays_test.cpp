/// Rays against single shapes.
#include <gtest/gtest.h>

#include "cairn/query.h"
#include "queries/inside.h"

namespace cairn {
namespace {

using testing::anyCompound;
using testing::anySolid;
using testing::depthIn;
using testing::Random;

/// Asks many points of the ray whether they are inside.
void expectFirstHit(const Shape& shape, const Ray& ray, const std::optional<SurfaceHit>& hit) {
    const double end = hit ? hit->distance : ray.reach;
    const double size = 1e-9 * (1 + ray.origin.norm());
    for (int i = 0; i < 200; ++i) {
        const double distance = end * i / 200.0;
        ASSERT_LT(depthIn(shape, ray.origin + distance * ray.direction), size) << distance << " of " << end;
    }
    if (!hit) return;
    ASSERT_LE((hit->point - ray.origin - hit->distance * ray.direction).norm(), size);
    ASSERT_NEAR(depthIn(shape, hit->point), 0, size);
    ASSERT_NEAR(hit->normal.norm(), 1, 1e-12);
    ASSERT_LE(hit->normal.dot(ray.direction), 0);
    // Just above the surface all is outside.
    ASSERT_LT(depthIn(shape, hit->point + 1e-6 * hit->normal), 0);
}

TEST(RayOnShape, FindsTheFirstPointOfEveryKindOfShape) {
    Random random(11);
    int hits = 0;
    for (int i = 0; i < 4000; ++i) {
        const Shape shape =
            i % 7 == 0 ? Shape(HalfSpace{random.direction(), random.uniform(-1, 1)}) : anySolid(random, 1);
        const Vec3 origin = 3 * random.vector(1);
        if (depthIn(shape, origin) >= -1e-6) continue;
        const Vec3 target = random.vector(0.5);
        const Ray ray{origin, (target - origin).normalized(), 10};
        const auto hit = castRay(shape, Pose{}, ray);
        ASSERT_NO_FATAL_FAILURE(expectFirstHit(shape, ray, hit)) << "case " << i;
        hits += hit ? 1 : 0;
    }
    EXPECT_GT(hits, 1500);
}

TEST(RayOnShape, MeetsAtOnceWhereItBeginsInside) {
    Random random(12);
    int inside = 0;
    for (int i = 0; i < 2000; ++i) {
        const Shape shape = anySolid(random, 1);
        const Vec3 origin = random.vector(0.5);
        if (depthIn(shape, origin) < 1e-9) continue;
        ++inside;
        const Ray ray{origin, random.direction()};
        const auto hit = castRay(shape, Pose{}, ray);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->distance, 0);
        EXPECT_EQ(hit->point, origin);
        EXPECT_LT((hit->normal + ray.direction).norm(), 1e-15);
    }
    EXPECT_GT(inside, 200);
}

TEST(RayOnShape, IsTheSameInEveryFrame) {
    Random random(13);
    for (int i = 0; i < 1000; ++i) {
        const Shape shape = i % 2 == 0 ? anySolid(random, 1) : Shape(anyCompound(random, 5, 1));
        const Pose pose{random.vector(10), random.orientation()};
        const Ray ray{3 * random.vector(1), random.direction()};
        const auto here = castRay(shape, Pose{}, ray);
        const auto there = castRay(shape, pose, {pose.toOuter(ray.origin), 7 * (pose.orientation * ray.direction)});
        ASSERT_EQ(here.has_value(), there.has_value());
        if (!here) continue;
        EXPECT_NEAR(here->distance, there->distance, 1e-9);
        EXPECT_LT((pose.orientation * here->normal - there->normal).norm(), 1e-6);
        EXPECT_EQ(here->part, there->part);
    }
}

TEST(RayOnShape, AlongFacesEdgesAndAxes) {
    const Box box{{2, 2, 2}};
    const auto along = [](const Vec3& origin, const Vec3& direction) { return Ray{origin, direction}; };
    EXPECT_EQ(castRay(box, Pose{}, along({-5, 1, 0}, Vec3::UnitX()))->distance, 4);  // in a face
    EXPECT_EQ(castRay(box, Pose{}, along({-5, 1, 1}, Vec3::UnitX()))->distance, 4);  // in an edge
    EXPECT_FALSE(castRay(box, Pose{}, along({-5, 1.0000001, 0}, Vec3::UnitX())));    // beside it
    EXPECT_FALSE(castRay(box, Pose{}, along({-5, 0, 0}, -Vec3::UnitX())));           // away
    const Cylinder cylinder{1, 2};
    EXPECT_EQ(castRay(cylinder, Pose{}, along({0, 0, 5}, -Vec3::UnitZ()))->distance, 4);
    EXPECT_EQ(castRay(cylinder, Pose{}, along({1, 0, 5}, -Vec3::UnitZ()))->distance, 4);  // in its side
    EXPECT_FALSE(castRay(cylinder, Pose{}, along({1.0000001, 0, 5}, -Vec3::UnitZ())));
    const Capsule capsule{1, 2};
    EXPECT_EQ(castRay(capsule, Pose{}, along({0, 0, 5}, -Vec3::UnitZ()))->distance, 3);
    EXPECT_EQ(castRay(capsule, Pose{}, along({5, 0, 1}, -Vec3::UnitX()))->distance, 4);
    EXPECT_FALSE(castRay(Sphere{1}, Pose{}, along({-5, 1.0000001, 0}, Vec3::UnitX())));
    EXPECT_NEAR(castRay(Sphere{1}, Pose{}, along({-1e9, 0.5, 0}, Vec3::UnitX()))->distance, 1e9 - std::sqrt(0.75),
                1e-6);
}

TEST(RayOnShape, EndsAtItsReach) {
    EXPECT_TRUE(castRay(Sphere{1}, Pose{}, {{-5, 0, 0}, Vec3::UnitX(), 4}));
    EXPECT_FALSE(castRay(Sphere{1}, Pose{}, {{-5, 0, 0}, Vec3::UnitX(), 3.999999}));
    EXPECT_TRUE(castRay(Sphere{1}, Pose{}, {{-1, 0, 0}, Vec3::UnitX(), 0}));
}

TEST(RayOnShape, RefusesWhatIsNoRay) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Sphere ball{1};
    EXPECT_THROW(castRay(ball, Pose{}, {Vec3::Zero(), Vec3::Zero()}), InputError);
    EXPECT_THROW(castRay(ball, Pose{}, {Vec3(nan, 0, 0), Vec3::UnitX()}), InputError);
    EXPECT_THROW(castRay(ball, Pose{}, {Vec3::Zero(), Vec3(nan, 0, 0)}), InputError);
    EXPECT_THROW(castRay(ball, Pose{}, {Vec3::Zero(), Vec3::UnitX(), -1}), InputError);
    EXPECT_THROW(castRay(ball, Pose{}, {Vec3::Zero(), Vec3::UnitX(), nan}), InputError);
    EXPECT_THROW(castRay(Sphere{-1}, Pose{}, {Vec3::Zero(), Vec3::UnitX()}), InputError);
    EXPECT_THROW(castRay(ball, Pose{Vec3(nan, 0, 0)}, {Vec3::Zero(), Vec3::UnitX()}), InputError);
    EXPECT_THROW(castRay(ball, Pose{Vec3::Zero(), Quat(0, 0, 0, 0)}, {Vec3::Zero(), Vec3::UnitX()}), InputError);
}

}  // namespace
}  // namespace cairn
