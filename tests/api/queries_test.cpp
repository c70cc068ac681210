/// Questions to a world against asking all its bodies one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <thread>
#include <tuple>

#include "cairn/world.h"
#include "queries/inside.h"

namespace cairn {
namespace {

using testing::anyCompound;
using testing::anySolid;
using testing::Random;

/// Bodies of every kind in a small space, some removed again, and two half-spaces.
World crowd(std::uint64_t seed, int count, int threads = 1) {
    Settings settings = Settings::preset(Preset::performance);
    settings.parallel = {threads, true};
    World world(settings);
    const MaterialId stone = world.addMaterial({"stone", 1000});
    Random random(seed);
    world.addBody({.shape = HalfSpace{Vec3::UnitZ(), -4}, .material = stone, .fixed = true});
    world.addBody({.shape = HalfSpace{Vec3(1, 0, 0.3), -5}, .material = stone, .fixed = true});
    std::vector<BodyId> ids;
    for (int i = 0; i < count; ++i) {
        const Shape shape = i % 5 == 0 ? Shape(anyCompound(random, 2 + random.below(20), 1.5)) : anySolid(random, 1);
        ids.push_back(world.addBody({.shape = shape,
                                     .material = stone,
                                     .pose = {random.vector(3), random.orientation()},
                                     .fixed = i % 7 == 0}));
    }
    for (int i = 0; i < count; i += 11) world.removeBody(ids[static_cast<std::size_t>(i)]);
    return world;
}

std::vector<RayHit> allHits(const World& world, const Ray& ray) {
    std::vector<RayHit> hits;
    for (const BodyId id : world.bodies()) {
        const auto* compound = std::get_if<Compound>(&world.shape(id));
        if (compound == nullptr) {
            if (const auto hit = castRay(world.shape(id), world.pose(id), ray)) hits.push_back({*hit, id});
            continue;
        }
        for (std::uint32_t i = 0; i < compound->parts.size(); ++i) {
            // As a compound of one part, so that not even rounding differs.
            auto hit = castRay(Compound{{compound->parts[i]}}, world.pose(id), ray);
            if (!hit) continue;
            hit->part = i;
            hits.push_back({*hit, id});
        }
    }
    std::ranges::sort(hits, {}, [](const RayHit& h) { return std::tuple(h.distance, h.body, h.part); });
    return hits;
}

void expectSame(const RayHit& a, const RayHit& b) {
    EXPECT_EQ(a.body, b.body);
    EXPECT_EQ(a.part, b.part);
    EXPECT_NEAR(a.distance, b.distance, 1e-12);
    EXPECT_LT((a.normal - b.normal).norm(), 1e-9);
    EXPECT_LT((a.point - b.point).norm(), 1e-12);
}

TEST(WorldQueries, RaysHitWhatAskingEveryBodyFinds) {
    World world = crowd(41, 150);
    Random random(42);
    int hits = 0;
    for (int i = 0; i < 600; ++i) {
        if (i % 200 == 199) world.step();
        const Ray ray{random.vector(4), random.direction(), i % 3 == 0 ? 3.0 : 1e6};
        const std::vector<RayHit> expected = allHits(world, ray);
        const std::vector<RayHit> found = world.castRayThrough(ray);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t k = 0; k < found.size(); ++k) ASSERT_NO_FATAL_FAILURE(expectSame(found[k], expected[k]));
        const auto nearest = world.castRay(ray);
        ASSERT_EQ(nearest.has_value(), !expected.empty());
        if (!nearest) continue;
        ASSERT_NO_FATAL_FAILURE(expectSame(*nearest, expected.front()));
        ++hits;
    }
    EXPECT_GT(hits, 300);
}

TEST(WorldQueries, ShapesMeetWhatAskingEveryBodyFinds) {
    World world = crowd(43, 80);
    Random random(44);
    for (int i = 0; i < 60; ++i) {
        const Shape shape = i % 4 == 0 ? Shape(anyCompound(random, 3, 0.5)) : anySolid(random, 0.4);
        const Pose pose{random.vector(4), random.orientation()};
        const Vec3 way = random.vector(5);
        std::optional<std::tuple<double, BodyId, std::uint32_t>> first;
        std::vector<BodyId> overlapping;
        std::vector<std::tuple<double, BodyId>> near;
        for (const BodyId id : world.bodies()) {
            if (const auto hit = castShape(shape, pose, way, world.shape(id), world.pose(id))) {
                const std::tuple found{hit->distance, id, hit->part};
                first = first ? std::min(*first, found) : found;
            }
            if (overlap(shape, pose, world.shape(id), world.pose(id))) overlapping.push_back(id);
            const double distance = closestPoints(shape, pose, world.shape(id), world.pose(id)).distance;
            if (distance <= 0.7) near.emplace_back(distance, id);
        }
        std::ranges::sort(near);
        const auto hit = world.castShape(shape, pose, way);
        ASSERT_EQ(hit.has_value(), first.has_value());
        if (hit) {
            EXPECT_NEAR(hit->distance, std::get<0>(*first), 1e-12);
            EXPECT_EQ(hit->body, std::get<1>(*first));
            EXPECT_EQ(hit->part, std::get<2>(*first));
        }
        std::vector<BodyId> found;
        for (const Overlap& o : world.overlap(shape, pose)) {
            if (found.empty() || found.back() != o.body) found.push_back(o.body);
        }
        EXPECT_EQ(found, overlapping);
        const std::vector<NearBody> closest = world.closestPoints(shape, pose, 0.7);
        ASSERT_EQ(closest.size(), near.size());
        for (std::size_t k = 0; k < near.size(); ++k) {
            EXPECT_NEAR(closest[k].closest.distance, std::get<0>(near[k]), 1e-12);
            EXPECT_EQ(closest[k].body, std::get<1>(near[k]));
        }
    }
}

TEST(WorldQueries, OfEqualHitsTheLowestBodyAndPartAreFirst) {
    World world;
    const MaterialId stone = world.addMaterial({"stone", 1000});
    const BodyId first = world.addBody({.shape = Box{}, .material = stone});
    const Compound twice{{{Box{}, Pose{}}, {Box{}, Pose{}}}};
    const BodyId second = world.addBody({.shape = twice, .material = stone});
    world.addBody({.shape = Box{}, .material = stone});
    const Ray ray{Vec3(-5, 0, 0), Vec3::UnitX()};
    EXPECT_EQ(world.castRay(ray)->body, first);
    const std::vector<RayHit> hits = world.castRayThrough(ray);
    ASSERT_EQ(hits.size(), 4U);
    EXPECT_EQ(hits[1].body, second);
    EXPECT_EQ(hits[1].part, 0U);
    EXPECT_EQ(hits[2].part, 1U);
    const BodyId except[] = {first};
    EXPECT_EQ(world.castRay(ray, {.except = except})->body, second);
    EXPECT_EQ(world.overlap(Vec3(-0.1, -0.1, -0.1), Vec3(0.1, 0.1, 0.1), {.except = except}).size(), 3U);
    EXPECT_EQ(world.castShape(Sphere{0.1}, Pose{Vec3(-5, 0, 0)}, Vec3(10, 0, 0), {.except = except})->body, second);
}

TEST(WorldQueries, FollowEveryChangeOfTheWorld) {
    World world;
    const MaterialId stone = world.addMaterial({"stone", 1000});
    const Ray down{Vec3(0, 0, 10), -Vec3::UnitZ()};
    EXPECT_FALSE(world.castRay(down));
    const BodyId ball = world.addBody({.shape = Sphere{1}, .material = stone});
    EXPECT_EQ(world.castRay(down)->distance, 9);
    world.setPose(ball, Pose{Vec3(0, 0, 2)});
    EXPECT_EQ(world.castRay(down)->distance, 7);
    world.setLinearVelocity(ball, Vec3(0, 0, 2.4));
    world.step();
    EXPECT_EQ(world.castRay(down)->point.z(), world.pose(ball).position.z() + 1);
    RollbackState moment;
    world.keep(moment);
    const double height = world.castRay(down)->point.z();
    world.removeBody(ball);
    EXPECT_FALSE(world.castRay(down));
    // Its successor in the slot has the number that another body of another past had.
    world.addBody({.shape = Compound{std::vector<CompoundPart>(20, {Sphere{2}, Pose{}})}, .material = stone});
    EXPECT_EQ(world.castRay(down)->distance, 8);
    world.load(moment);
    EXPECT_EQ(world.castRay(down)->point.z(), height);
    world.addBody({.shape = Compound{std::vector<CompoundPart>(20, {Sphere{3}, Pose{}})},
                   .material = stone,
                   .pose = {Vec3(0, 0, 5), Quat::Identity()}});
    EXPECT_EQ(world.castRay(down)->distance, 2);
    EXPECT_EQ(World::restore(world.save()).castRay(down)->distance, 2);
}

TEST(WorldQueries, AreAnsweredOnManyThreadsAtOnce) {
    const World world = crowd(45, 300, 3);
    Random random(46);
    std::vector<Ray> rays;
    for (int i = 0; i < 3000; ++i) rays.push_back({random.vector(4), random.direction()});
    std::vector<std::vector<std::optional<RayHit>>> answers(4);
    std::vector<std::thread> threads;
    threads.reserve(answers.size());
    for (auto& answer : answers) threads.emplace_back([&] { answer = world.castRays(rays); });
    for (std::thread& thread : threads) thread.join();
    for (const auto& answer : answers) {
        ASSERT_EQ(answer.size(), rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const auto alone = world.castRay(rays[i]);
            ASSERT_EQ(answer[i].has_value(), alone.has_value());
            if (!alone) continue;
            EXPECT_EQ(answer[i]->body, alone->body);
            EXPECT_EQ(answer[i]->distance, alone->distance);
        }
    }
}

TEST(WorldQueries, OfTwoBodies) {
    World world;
    const MaterialId stone = world.addMaterial({"stone", 1000});
    const BodyId ground = world.addBody({.shape = HalfSpace{}, .material = stone, .fixed = true});
    const BodyId ball = world.addBody({.shape = Sphere{1}, .material = stone, .pose = Pose{Vec3(0, 0, 3)}});
    EXPECT_EQ(world.closestPoints(ball, ground).distance, 2);
    EXPECT_EQ(world.closestPoints(ground, ball).normal, -Vec3::UnitZ());
    EXPECT_THROW(world.closestPoints(ground, ground), InputError);
    world.removeBody(ball);
    EXPECT_THROW(world.closestPoints(ball, ground), StaleIdError);
}

TEST(WorldQueries, RefuseBadInput) {
    const World world = crowd(47, 10);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Ray bad[] = {{Vec3::Zero(), Vec3::Zero()}};
    EXPECT_THROW(world.castRay(bad[0]), InputError);
    EXPECT_THROW(world.castRays(bad), InputError);
    EXPECT_THROW(world.castShape(HalfSpace{}, Pose{}, Vec3::UnitX()), InputError);
    EXPECT_THROW(world.closestPoints(Sphere{}, Pose{}, nan), InputError);
    EXPECT_THROW(world.overlap(Vec3::Ones(), Vec3::Zero()), InputError);
    const GroupId unknown[] = {static_cast<GroupId>(3)};
    const QueryFilter filter{.groups = unknown};
    const std::array rays{Ray{Vec3::Zero(), Vec3::UnitX()}, Ray{Vec3::Zero(), Vec3::UnitY()}};
    EXPECT_THROW(world.castRay(rays[0], filter), InputError);
    EXPECT_THROW(world.castRays(rays, filter), InputError);
    EXPECT_THROW(world.overlap(Vec3::Zero(), Vec3::Ones(), filter), InputError);
    EXPECT_THROW(world.closestPoints(Sphere{}, Pose{}, 1, filter), InputError);
}

}  // namespace
}  // namespace cairn
