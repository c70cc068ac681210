#include <cmath>

#include "golden/making.h"

namespace cairn::golden {
namespace {

ConvexHull wedge(double size) {
    return ConvexHull({{-size, -size, -size},
                       {size, -size, -size},
                       {size, size, -size},
                       {-size, size, -size},
                       {-0.5 * size, 0, size},
                       {0.7 * size, 0.2 * size, 0.8 * size}});
}

/// A box and a capsule that cross, with a ball on the end.
Compound mallet(double size) {
    Compound compound;
    compound.parts.push_back({.shape = Box{{size, 0.6 * size, 0.6 * size}}});
    compound.parts.push_back({.shape = Capsule{0.2 * size, size}, .pose = {{0, 0, -0.5 * size}, Quat::Identity()}});
    compound.parts.push_back({.shape = Sphere{0.3 * size}, .pose = {{0, 0, -size}, Quat::Identity()}});
    return compound;
}

SceneBody wallAt(const Vec3& normal, double distance) {
    SceneBody wall;
    wall.shape = HalfSpace{normal, -distance};
    wall.material = "oak";
    wall.fixed = true;
    return wall;
}

constexpr double box_size = 0.2;

BodyDescription ballOf(double radius, const Vec3& position, const Vec3& velocity, const Scales& by) {
    BodyDescription ball;
    ball.shape = Sphere{radius * by.length};
    ball.pose.position = position * by.length;
    ball.linear_velocity = velocity * (by.length / by.time);
    return ball;
}

}  // namespace

Scene groundScene(std::string name) {
    Scene scene;
    scene.name = std::move(name);
    scene.duration = 4;
    scene.gravity = {0, 0, -10};
    scene.materials = {{"oak", 800}, {"iron", 7874}};
    scene.default_pair = {.restitution = 0.25, .static_friction = 0.2, .kinetic_friction = 0.2};
    scene.bodies.push_back(wallAt(Vec3::UnitZ(), 0));
    return scene;
}

SceneBody bodyOf(const Shape& shape, const Vec3& position) {
    SceneBody body;
    body.shape = shape;
    body.material = "oak";
    body.position = position;
    return body;
}

double scatter(std::size_t index) {
    const double turns = 0.6180339887498949 * static_cast<double>(index * index + index + 1);
    return 2 * (turns - std::floor(turns)) - 1;
}

Shape anyShape(std::size_t index, double size) {
    switch (index % 6) {
        case 0:
            return Sphere{size};
        case 1:
            return Box{{1.4 * size, 1.1 * size, 0.8 * size}};
        case 2:
            return Capsule{0.5 * size, size};
        case 3:
            return Cylinder{0.7 * size, size};
        case 4:
            return wedge(0.6 * size);
        default:
            return mallet(0.9 * size);
    }
}

Quat scatteredOrientation(std::size_t index) {
    return Quat(1.1 + scatter(index), scatter(index + 1), scatter(index + 2), scatter(index + 3)).normalized();
}

Scene mixedHeap() {
    constexpr std::size_t side = 4;
    constexpr std::size_t bodies = 96;
    constexpr double cell = 0.22;
    constexpr double inner = 0.5 * side * cell;
    Scene scene = groundScene("mixed heap");
    for (const double sign : {-1.0, 1.0}) {
        scene.bodies.push_back(wallAt({sign, 0, 0}, inner));
        scene.bodies.push_back(wallAt({0, sign, 0}, inner));
    }
    for (std::size_t i = 0; i < bodies; ++i) {
        const Vec3 place((static_cast<double>(i % side) + 0.5) * cell - inner,
                         (static_cast<double>(i / side % side) + 0.5) * cell - inner,
                         (static_cast<double>(i / side / side) + 0.5) * cell);
        SceneBody body = bodyOf(anyShape(i + i / 7, 0.08), place);
        body.orientation = scatteredOrientation(i);
        body.linear_velocity = {0.5 * scatter(7 * i), 0.5 * scatter(7 * i + 1), -2.5};
        body.angular_velocity = {scatter(i + 2), scatter(i + 3), scatter(i + 4)};
        if (i % 5 == 0) body.material = "iron";
        scene.bodies.push_back(body);
    }
    return scene;
}

Scene rollingFriction() {
    Scene scene = groundScene("rolling friction");
    scene.default_pair = {.restitution = 0.1,
                          .static_friction = 0.5,
                          .kinetic_friction = 0.3,
                          .rolling_friction = 0.005,
                          .spinning_friction = 0.003};
    for (std::size_t i = 0; i < 30; ++i) {
        const std::size_t lane = i % 10;
        SceneBody body =
            bodyOf(Sphere{0.1}, {0.5 * static_cast<double>(i / 10), 0.35 * static_cast<double>(lane), 0.1});
        if (lane % 3 == 1) body.shape = Cylinder{0.1, 0.2};
        if (lane % 3 == 2) body.shape = Capsule{0.1, 0.15};
        if (lane % 3 != 0) body.orientation = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitY());
        // The first of each lane runs into the others; some roll, some slide, some spin on the spot.
        if (i < 10) body.linear_velocity = {3, 0, 0};
        if (i < 10 && lane % 2 == 0) body.angular_velocity = {0, 30, 0};
        if (i >= 20 && lane % 3 == 0) body.angular_velocity = {0, 0, 10};
        scene.bodies.push_back(body);
    }
    // A ball on three, which roll apart below it.
    for (const Vec3& place : {Vec3(4, 0, 0.1), Vec3(4.2, 0, 0.1), Vec3(4.1, 0.1732, 0.1), Vec3(4.1, 0.0577, 0.2633)}) {
        scene.bodies.push_back(bodyOf(Sphere{0.1}, place));
    }
    return scene;
}

Scene zeroGravity() {
    Scene scene = groundScene("zero gravity");
    scene.gravity.setZero();
    scene.default_pair = {.restitution = 0.8, .static_friction = 0.3, .kinetic_friction = 0.3};
    for (std::size_t i = 0; i < 80; ++i) {
        const Vec3 place(static_cast<double>(i % 4) - 1.5, static_cast<double>(i / 4 % 4) - 1.5,
                         static_cast<double>(i / 16) - 2);
        SceneBody body = bodyOf(anyShape(i, 0.15), 0.4 * place + Vec3(0, 0, 2));
        body.orientation = scatteredOrientation(3 * i);
        body.linear_velocity = -2 * place + 0.3 * Vec3(scatter(i), scatter(i + 5), scatter(i + 9));
        body.angular_velocity = 5 * Vec3(scatter(2 * i), scatter(2 * i + 1), scatter(2 * i + 2));
        scene.bodies.push_back(body);
    }
    return scene;
}

Scene settlingStacks() {
    Scene scene = groundScene("settling stacks");
    for (int stack = 0; stack < 6; ++stack) {
        for (int i = 0; i < 5; ++i) {
            const Vec3 place(0.6 * stack, 0.01 * ((i * 2 + stack) % 3), (i + 0.5) * box_size);
            scene.bodies.push_back(bodyOf(Box{Vec3::Constant(box_size)}, place));
        }
    }
    return scene;
}

const std::array<Action, 1> throw_ball = {{{0.4, [](SceneRun& run, const Scales& by) {
                                                run.world().addBody(ballOf(0.15, {-0.4, 0, 0.6}, {6, 0, 0}, by));
                                            }}}};

Scene changingPile() {
    Scene scene = groundScene("changing pile");
    for (int layer = 0; layer < 4; ++layer) {
        for (int i = 0; i < 9; ++i) {
            const Vec3 place(0.21 * (i % 3) + 0.03 * layer, 0.21 * (i / 3), (layer + 0.5) * box_size);
            scene.bodies.push_back(bodyOf(Box{Vec3::Constant(box_size)}, place));
        }
    }
    return scene;
}

const std::array<Action, 8> change_bodies = {{
    {0.02, [](SceneRun& run, const Scales&) { run.world().removeBody(run.ids()[5]); }},
    {0.05,
     [](SceneRun& run, const Scales& by) {
         for (int i = 0; i < 6; ++i)
             run.world().addBody(ballOf(0.08, {0.1 * i, 0.1, 1.1 + 0.1 * (i % 2)}, {0, 0, -2}, by));
     }},
    {0.1,
     [](SceneRun& run, const Scales&) {
         run.world().removeBody(run.ids()[1]);
         run.world().removeBody(run.ids()[11]);
     }},
    {0.13, [](SceneRun& run, const Scales&) { run.world().setFixed(run.ids()[20], true); }},
    {0.16,
     [](SceneRun& run, const Scales& by) {
         World& world = run.world();
         const BodyId added = world.addBody(ballOf(0.1, {-0.3, 0.2, 0.3}, {3, 0, 0}, by));
         world.setConstantForce(added, impulse({5, 0, 0}, by) / by.time);
         world.applyImpulseAt(run.ids()[30], impulse({1, 2, 0}, by),
                              world.centreOfMass(run.ids()[30]) + Vec3(0, 0, 0.05) * by.length);
     }},
    {0.2,
     [](SceneRun& run, const Scales& by) {
         run.world().setPose(run.ids()[36], {Vec3(0.2, 0.2, 1.5) * by.length, Quat(0.9, 0.1, 0.3, 0.2)});
     }},
    {0.22, [](SceneRun& run, const Scales&) { run.world().setFixed(run.ids()[20], false); }},
    {0.25,
     [](SceneRun& run, const Scales& by) {
         World& world = run.world();
         for (const BodyId id : world.bodies()) {
             if (id.generation > 0) world.removeBody(id);
         }
         world.setGravity(Vec3(1, 0, -10) * (by.length / by.time / by.time));
     }},
}};

}  // namespace cairn::golden
