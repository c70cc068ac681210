#include "golden/making.h"

namespace cairn::golden {
namespace {

/// Heights of hills, row after row. @param side points along each side
std::vector<double> hills(std::size_t side, double high) {
    std::vector<double> heights;
    for (std::size_t i = 0; i < side * side; ++i) heights.push_back(high * scatter(i));
    return heights;
}

/// The same hills as triangles between points at the whole numbers times a spacing, about the origin.
Mesh hillMesh(std::size_t side, double spacing, double high) {
    const std::vector<double> heights = hills(side, high);
    std::vector<Vec3> vertices;
    std::vector<TriangleCorners> triangles;
    const double middle = 0.5 * static_cast<double>(side - 1);
    for (std::size_t i = 0; i < side * side; ++i) {
        const double x = (static_cast<double>(i % side) - middle) * spacing;
        const double y = (static_cast<double>(i / side) - middle) * spacing;
        vertices.emplace_back(x, y, heights[i]);
        if (i % side + 1 == side || i / side + 1 == side) continue;
        const auto a = static_cast<std::uint32_t>(i);
        const auto row = static_cast<std::uint32_t>(side);
        triangles.push_back({a, a + 1, a + row + 1});
        triangles.push_back({a, a + row + 1, a + row});
    }
    return Mesh(std::move(vertices), std::move(triangles));
}

/// Three boxes wide, five long and three high with a hole in each layer, so many that it has a tree over them.
Compound lattice(double size) {
    Compound compound;
    for (int i = 0; i < 45; ++i) {
        if (i % 15 == 7) continue;
        const Vec3 place(i % 3 - 1.0, i % 15 / 3 - 2.0, i / 15 - 1.0);
        compound.parts.push_back({.shape = Box{Vec3::Constant(size)}, .pose = {size * place, Quat::Identity()}});
    }
    return compound;
}

}  // namespace

Scene swayingGravity() {
    Scene scene = groundScene("swaying gravity");
    scene.gravity_law = SineMotion{.amplitude = {3, 0, 2}, .frequency = 2.5, .phase = 0.4};
    for (int stack = 0; stack < 3; ++stack) {
        for (int i = 0; i < 4; ++i) {
            scene.bodies.push_back(bodyOf(Box{Vec3::Constant(0.2)}, {0.7 * stack, 0.02 * (i % 2), (i + 0.5) * 0.2}));
        }
    }
    for (std::size_t i = 0; i < 12; ++i) {
        const Vec3 place(0.35 * static_cast<double>(i % 6) - 0.2, 0.5 + 0.3 * static_cast<double>(i / 6), 0.1);
        scene.bodies.push_back(bodyOf(i % 3 == 0 ? Shape(Cylinder{0.1, 0.2}) : Shape(Sphere{0.1}), place));
    }
    return scene;
}

Scene terrain() {
    Scene scene = groundScene("terrain");
    scene.bodies.clear();
    SceneBody hilly = bodyOf(HeightField(24, hills(24, 0.08), {0.25, 0.25}), Vec3::Zero());
    hilly.fixed = true;
    scene.bodies.push_back(hilly);
    SceneBody shaken = bodyOf(hillMesh(10, 0.2, 0.05), {-0.4, 0, 0.3});
    shaken.orientation = Quat(1, 0, 0.15, 0.05).normalized();
    shaken.motion = TableMotion{.times = {0, 0.2, 0.5},
                                .displacements = {{0, 0, 0}, {0.1, 0, 0.02}, {0, 0, 0}},
                                .turns = {},
                                .end = TableEnd::repeat};
    shaken.fixed = true;
    scene.bodies.push_back(shaken);
    for (std::size_t i = 0; i < 30; ++i) {
        const Vec3 place(0.3 * static_cast<double>(i % 6) - 0.9, 0.3 * static_cast<double>(i / 6) - 0.6, 0.75);
        SceneBody body = bodyOf(anyShape(i, 0.07), place);
        body.orientation = scatteredOrientation(5 * i);
        body.linear_velocity = {scatter(i), scatter(i + 3), -2};
        scene.bodies.push_back(body);
    }
    SceneBody large = bodyOf(lattice(0.12), {1.6, 0.2, 0.5});
    large.orientation = scatteredOrientation(2);
    large.linear_velocity = {-1, 0, -1};
    scene.bodies.push_back(large);
    return scene;
}

}  // namespace cairn::golden
