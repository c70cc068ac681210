#include <cmath>

#include "scene/built_in_tools.h"

namespace cairn {

Scene stacksScene(std::string name, int walls) {
    Scene scene = emptyScene(std::move(name), 6, {0, 0, -10});
    scene.bodies.push_back(ground());
    for (int wall = 0; wall < walls; ++wall) addWall(scene, 10, 0.5 * wall, 0.1);
    // Awake, settling would take as long as the impact (thesis §5.1).
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) scene.bodies[i].asleep = true;
    constexpr double radius = 0.132;
    constexpr double speed = 12;
    SceneBody bullet = dynamicBody(Sphere{radius}, "iron", {-8.582, 0, radius});
    bullet.linear_velocity = {speed, 0, 0};
    bullet.angular_velocity = {0, tidy(speed / radius), 0};  // it rolls
    scene.bodies.push_back(bullet);
    return scene;
}

Scene wellScene(std::string name, double radius, double well_height, int side, int layers) {
    Scene scene = emptyScene(std::move(name), 6, {0, 0, -10});
    scene.bodies.push_back(ground());
    const double middle = tidy(well_height / 2);
    for (const double x : {-0.55, 0.55}) scene.bodies.push_back(fixedBox({0.1, 1.2, well_height}, {x, 0, middle}));
    for (const double y : {-0.55, 0.55}) scene.bodies.push_back(fixedBox({1, 0.1, well_height}, {0, y, middle}));
    // A lattice with gaps, shaken a little: exact columns would stay columns.
    const double spacing = 2.3 * radius;
    const double jitter = 0.05 * radius;
    const double first = -0.5 * (side - 1) * spacing;
    SplitMix64 random(42);
    for (int layer = 0; layer < layers; ++layer) {
        for (int row = 0; row < side; ++row) {
            for (int column = 0; column < side; ++column) {
                const Vec3 lattice(first + column * spacing, first + row * spacing, 0.4 + radius + layer * spacing);
                scene.bodies.push_back(dynamicBody(Sphere{radius}, "oak", lattice + jitter * random.symmetricVector()));
            }
        }
    }
    return scene;
}

Scene cageScene(std::string name, const Vec3& size, double body_size, int side, int layers) {
    Scene scene = emptyScene(std::move(name), 8, Vec3::Zero());
    scene.events.push_back({1, SetGravity{{0, 0, -10}}});
    scene.bodies.push_back(fixedPlane({0, 0, 1}, 0));
    scene.bodies.push_back(fixedPlane({0, 0, -1}, -size.z()));
    scene.bodies.push_back(fixedPlane({1, 0, 0}, tidy(-size.x() / 2)));
    scene.bodies.push_back(fixedPlane({-1, 0, 0}, tidy(-size.x() / 2)));
    scene.bodies.push_back(fixedPlane({0, 1, 0}, tidy(-size.y() / 2)));
    scene.bodies.push_back(fixedPlane({0, -1, 0}, tidy(-size.y() / 2)));
    const Vec3 cell(size.x() / side, size.y() / side, size.z() / layers);
    const Vec3 corner(-size.x() / 2, -size.y() / 2, 0);
    SplitMix64 random(7);
    for (int layer = 0; layer < layers; ++layer) {
        const Shape shape = layer % 2 == 0 ? Shape(Sphere{body_size / 2}) : Shape(Box{Vec3::Constant(body_size)});
        for (int row = 0; row < side; ++row) {
            for (int column = 0; column < side; ++column) {
                const Vec3 index(column + 0.5, row + 0.5, layer + 0.5);
                SceneBody body = dynamicBody(shape, "oak", corner + index.cwiseProduct(cell));
                body.linear_velocity = tidy(random.symmetricVector());
                scene.bodies.push_back(std::move(body));
            }
        }
    }
    return scene;
}

}  // namespace cairn
