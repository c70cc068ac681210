/// @file Bodies that move on a ground, and the same on another, to be compared.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "cairn/world.h"
#include "surface_maker.h"

namespace cairn::testing {

struct PlacedGround {
    Shape shape;
    Pose pose{};
};

struct OnSurface {
    World world;
    MaterialId oak;

    OnSurface(const PlacedGround& ground, double friction,
              const Settings& settings = Settings::preset(Preset::accuracy))
        : world(settings), oak(world.addMaterial({"oak", 800})) {
        world.setDefaultPairProperties({0.3, friction, friction});
        world.setGravity(Vec3(0, 0, -10));
        world.addBody({.shape = ground.shape, .material = oak, .pose = ground.pose, .fixed = true});
    }
    void run(double seconds) {
        const double end = world.time() + seconds;
        while (world.time() < end - 1e-9) world.step();
    }
};

/// How a body moves on the ground.
struct Start {
    Pose pose{};
    Vec3 v = Vec3::Zero();
    Vec3 w = Vec3::Zero();
    double friction = 0.5;
};

/// A body that falls on some ground, and how often it struck it.
struct Falling : OnSurface {
    BodyId body;
    int impacts = 0;
    bool touches = false;

    Falling(const PlacedGround& ground, const Shape& shape, const Start& start,
            const Settings& settings = Settings::preset(Preset::accuracy))
        : OnSurface(ground, start.friction, settings),
          body(world.addBody({.shape = shape,
                              .material = oak,
                              .pose = start.pose,
                              .linear_velocity = start.v,
                              .angular_velocity = start.w})) {}
    void step() {
        world.step();
        const bool touched = touches;
        touches = std::ranges::any_of(world.contacts(), [](const ContactInfo& c) { return !c.impulse.isZero(0); });
        if (touches && !touched) ++impacts;
    }
};

/// [m, m/s, rad/s]
inline double apart(const Falling& a, const Falling& b) {
    const Pose p = a.world.pose(a.body);
    const Pose q = b.world.pose(b.body);
    return (p.position - q.position).norm() + (p.orientation.coeffs() - q.orientation.coeffs()).norm() +
           (a.world.linearVelocity(a.body) - b.world.linearVelocity(b.body)).norm() +
           (a.world.angularVelocity(a.body) - b.world.angularVelocity(b.body)).norm();
}

/// Runs a body on a ground and on its triangles. @return how far the states are apart at the end [m, m/s, rad/s]
inline double difference(const Shape& shape, const Start& start, const PlacedGround& plain,
                         const PlacedGround& triangles, double seconds,
                         const Settings& settings = Settings::preset(Preset::accuracy)) {
    Falling on_plain(plain, shape, start, settings);
    Falling on_triangles(triangles, shape, start, settings);
    on_plain.run(seconds);
    on_triangles.run(seconds);
    EXPECT_GT(on_plain.world.pose(on_plain.body).position.z(), 0);
    return apart(on_plain, on_triangles);
}

/// A start whose pose is changed by 1e-12.
inline Start nearlyAs(const Start& start, Random& random) {
    const auto small = [&]() -> Vec3 {
        return 1e-12 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    };
    Start other = start;
    other.pose.position += small();
    const Vec3 turn = small();
    other.pose.orientation = (Quat(1, turn.x() / 2, turn.y() / 2, turn.z() / 2) * start.pose.orientation).normalized();
    return other;
}

/// Every impact multiplies differences, so that after some of them those of rounding are large: until the third impact
/// the states are the same, and afterwards as near as those of bodies that began elsewhere by 1e-12.
inline void expectSameTumbling(const char* name, const Shape& shape, const Start& start, const PlacedGround& plain,
                               const PlacedGround& triangles, double seconds) {
    constexpr int runs = 10;
    Random random(8);
    Falling on_plain(plain, shape, start);
    Falling on_triangles(triangles, shape, start);
    std::vector<std::unique_ptr<Falling>> others;
    for (int i = 0; i < runs; ++i) others.push_back(std::make_unique<Falling>(plain, shape, nearlyAs(start, random)));
    double spread = 1e-9;
    while (on_plain.world.time() < seconds) {
        for (Falling* one : {&on_plain, &on_triangles}) one->step();
        for (const auto& other : others) other->step();
        if (on_plain.impacts >= 3) {
            for (const auto& other : others) spread = std::max(spread, apart(on_plain, *other));
        }
        ASSERT_LE(apart(on_plain, on_triangles), spread)
            << name << ", " << on_plain.world.time() << " s, impact " << on_plain.impacts;
    }
    EXPECT_GE(on_plain.impacts, 3) << name;
}

/// The axis of what lies is level.
inline Quat lying() {
    return Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3(1, 0.3, 0).normalized()));
}

/// Of the middle of one of solids() that stands on the ground [m].
inline double heightOf(const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
    if (const auto* box = std::get_if<Box>(&shape)) return 0.5 * box->size.z();
    if (const auto* capsule = std::get_if<Capsule>(&shape)) return 0.5 * capsule->length + capsule->radius;
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return 0.5 * cylinder->length;
    return 0.25;
}

}  // namespace cairn::testing
