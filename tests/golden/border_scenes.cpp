#include "golden/making.h"

namespace cairn::golden {
namespace {

constexpr double ball_radius = 0.05;
constexpr double block_size = 0.2;
constexpr double slab_height = 0.2;

/// Of iron, so heavy that what lies on it hardly moves it; its upper face is at slab_height.
SceneBody slab(double length) {
    SceneBody body = bodyOf(Box{{length, length, slab_height}}, {0, 0, slab_height / 2});
    body.material = "iron";
    return body;
}

/// A ball on the slab. @param spin part of its speed that it rolls with; 1 = it does not slide
SceneBody ballOnSlab(double x, double y, double speed, double spin) {
    SceneBody ball = bodyOf(Sphere{ball_radius}, {x, y, slab_height + ball_radius});
    ball.linear_velocity = {speed, 0, 0};
    ball.angular_velocity = {0, spin * speed / ball_radius, 0};
    return ball;
}

/// The number of a place in a square of places around the origin.
struct Grid {
    int side;
    double spacing;

    Vec3 at(int index) const {
        const double middle = 0.5 * (side - 1);
        return {(index % side - middle) * spacing, (index / side - middle) * spacing, 0};
    }
};

/// The smallest square that holds so many places.
int sideFor(int places) {
    int side = 1;
    while (side * side < places) ++side;
    return side;
}

}  // namespace

Scene crowdedSlab(std::string name, int columns, int balls) {
    constexpr double small_size = 0.12;  // stays within the box below when it turns, so that four corners touch
    constexpr double speed = 0.3;
    Scene scene = groundScene(std::move(name));
    const Grid grid{sideFor(columns + balls), 0.3};
    scene.bodies.push_back(slab(grid.spacing * (grid.side + 1)));
    for (int i = 0; i < columns; ++i) {
        const auto n = 4 * static_cast<std::size_t>(i);
        const Vec3 velocity = speed * Vec3(scatter(n), scatter(n + 1), 0);
        double height = slab_height;
        const auto put = [&](const Shape& shape, double size, double turning) {
            SceneBody body = bodyOf(shape, grid.at(i) + Vec3(0, 0, height + size / 2));
            body.linear_velocity = velocity;
            body.angular_velocity = {0, 0, turning};
            scene.bodies.push_back(body);
            height += size;
        };
        put(Box{Vec3::Constant(block_size)}, block_size, 0);
        put(Box{Vec3::Constant(small_size)}, small_size, 3 * scatter(n + 2));
        put(Sphere{ball_radius}, 2 * ball_radius, 3 * scatter(n + 3));
    }
    for (int i = columns; i < columns + balls; ++i) {
        const Vec3 place = grid.at(i);
        const auto n = static_cast<std::size_t>(i);
        scene.bodies.push_back(ballOnSlab(place.x(), place.y(), speed * scatter(n), scatter(n + 1)));
    }
    return scene;
}

Scene rollingBalls(std::string name, int sliding) {
    constexpr int balls = 96;
    Scene scene = groundScene(std::move(name));
    const Grid grid{sideFor(balls), 0.15};
    scene.bodies.push_back(slab(4));
    for (int i = 0; i < balls; ++i) {
        // The last of a row slides, away from the others.
        const bool slides = i % grid.side == grid.side - 1 && i / grid.side < sliding;
        const Vec3 place = grid.at(i);
        scene.bodies.push_back(ballOnSlab(place.x(), place.y(), slides ? 1.5 : 0.3, slides ? 0 : 1));
    }
    return scene;
}

Scene partlyAsleep(std::string name, int asleep) {
    constexpr int bodies = 40;
    Scene scene = groundScene(std::move(name));
    const Grid grid{sideFor(bodies), 0.3};
    scene.bodies.push_back(slab(3));
    for (int i = 0; i < bodies - 1; ++i) {
        const Vec3 place = grid.at(i);
        if (i < asleep - 1) {
            scene.bodies.push_back(
                bodyOf(Box{Vec3::Constant(block_size)}, place + Vec3(0, 0, slab_height + block_size / 2)));
        } else {
            scene.bodies.push_back(ballOnSlab(place.x(), place.y(), 0.2, 1));
        }
    }
    for (int i = 1; i <= asleep; ++i) scene.bodies[static_cast<std::size_t>(i)].asleep = true;
    return scene;
}

Scene pyramid() {
    constexpr int rows = 5;
    constexpr double spacing = 1.1 * block_size;
    Scene scene = groundScene("pyramid");
    for (int row = 0; row < rows; ++row) {
        const Grid grid{rows - row, spacing};
        for (int i = 0; i < grid.side * grid.side; ++i) {
            const Vec3 place = grid.at(i) + Vec3(0, 0, (row + 0.5) * block_size);
            scene.bodies.push_back(bodyOf(Box{Vec3::Constant(block_size)}, place));
        }
    }
    SceneBody ball = bodyOf(Sphere{0.15}, {-1, 0.03, 0.45});
    ball.material = "iron";
    ball.linear_velocity = {6, 0, 0};
    scene.bodies.push_back(ball);
    return scene;
}

Scene jointedPyramid() {
    Scene scene = pyramid();
    scene.name = "pyramid with a joint";
    const Vec3 middle = 0.5 * (scene.bodies[1].position + scene.bodies[2].position);
    scene.joints.push_back({1, 2, {.kind = JointKind::ball, .anchor = middle}});
    return scene;
}

}  // namespace cairn::golden
