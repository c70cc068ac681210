#include "demonstration_scenes.h"

#include <cmath>

namespace cairn::thesis {

namespace {

constexpr double ball_radius = 0.05;

SceneBody fixedBox(const Vec3& size, const Vec3& position) {
    SceneBody body;
    body.shape = Box{size};
    body.material = "granite";
    body.position = position;
    body.fixed = true;
    return body;
}

SceneBody ball(const char* material, const Vec3& position) {
    SceneBody body;
    body.shape = Sphere{ball_radius};
    body.material = material;
    body.position = position;
    return body;
}

Scene emptyScene(const char* name, double duration) {
    Scene scene;
    scene.name = name;
    scene.duration = duration;
    scene.materials = {{"oak", 800}, {"iron", 7874}, {"granite", 2800}};
    return scene;
}

/// A square layer of touching balls about the z axis.
void addLayer(Scene& scene, int side, double height) {
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const double first = -(side - 1) * ball_radius;
            scene.bodies.push_back(
                ball("oak", {first + 2 * ball_radius * column, first + 2 * ball_radius * row, height}));
        }
    }
}

}  // namespace

Scene endlessCradleScene(int balls, int moving) {
    constexpr double gap = 0.1;
    constexpr double wall = 0.2;
    Scene scene = emptyScene("endless cradle", 1);
    scene.default_pair = {.restitution = 1, .static_friction = 0, .kinetic_friction = 0};
    for (int i = 0; i < balls; ++i) {
        SceneBody body = ball("iron", {2 * ball_radius * i - (i < moving ? gap : 0), 0, 0});
        if (i < moving) body.linear_velocity = {1, 0, 0};
        scene.bodies.push_back(body);
    }
    // The gap to the right wall equals that to the left one after the first impact.
    const double right = 2 * ball_radius * (balls - 1) + ball_radius + 2 * gap;
    const double left = -ball_radius - 2 * gap;
    scene.bodies.push_back(fixedBox(Vec3::Constant(wall), {right + wall / 2, 0, 0}));
    scene.bodies.push_back(fixedBox(Vec3::Constant(wall), {left - wall / 2, 0, 0}));
    return scene;
}

Scene spinningBallScene(const Vec3& axis) {
    constexpr double inner = 6 * ball_radius;  // three balls side by side
    constexpr double wall = 0.1;
    constexpr double height = 0.1;
    constexpr double spin = 20;  // [rad/s]
    Scene scene = emptyScene("spinning ball", 4);
    scene.gravity = {0, 0, -10};
    SceneBody ground;
    ground.shape = HalfSpace{};
    ground.material = "granite";
    ground.fixed = true;
    scene.bodies.push_back(ground);
    const double offset = (inner + wall) / 2;
    for (const double side : {-offset, offset}) {
        scene.bodies.push_back(fixedBox({wall, inner + 2 * wall, height}, {side, 0, height / 2}));
        scene.bodies.push_back(fixedBox({inner, wall, height}, {0, side, height / 2}));
    }
    double level = ball_radius;
    for (const int side : {3, 2, 1}) {
        addLayer(scene, side, level);
        level += std::sqrt(2.0) * ball_radius;  // a ball in the hollow of four
    }
    scene.bodies[spinning_ball].angular_velocity = spin * axis;
    return scene;
}

}  // namespace cairn::thesis
