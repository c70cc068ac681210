#include "scene/built_in_tools.h"

#include <fmt/format.h>

#include <charconv>

namespace cairn {

double tidy(double value) {
    const std::string text = fmt::format("{:.9g}", value);
    double rounded = 0;
    std::from_chars(text.data(), text.data() + text.size(), rounded);
    return rounded + 0.0;  // minus zero becomes zero
}

Vec3 tidy(const Vec3& value) {
    return {tidy(value.x()), tidy(value.y()), tidy(value.z())};
}

Quat tidy(const Quat& value) {
    return {tidy(value.w()), tidy(value.x()), tidy(value.y()), tidy(value.z())};
}

Scene emptyScene(std::string name, double duration, const Vec3& gravity) {
    Scene scene;
    scene.name = std::move(name);
    scene.duration = duration;
    scene.gravity = gravity;
    scene.materials = {{"oak", 800}, {"iron", 7874}, {"granite", 2800}};
    scene.default_pair = {.restitution = 0.25, .static_friction = 0.2, .kinetic_friction = 0.2};
    return scene;
}

SceneBody fixedPlane(const Vec3& normal, double offset) {
    SceneBody body;
    body.shape = HalfSpace{normal, offset};
    body.material = "granite";
    body.fixed = true;
    return body;
}

SceneBody ground() {
    return fixedPlane(Vec3::UnitZ(), 0);
}

SceneBody fixedBox(const Vec3& size, const Vec3& position) {
    SceneBody body;
    body.shape = Box{tidy(size)};
    body.material = "granite";
    body.position = tidy(position);
    body.fixed = true;
    return body;
}

SceneBody dynamicBody(const Shape& shape, std::string material, const Vec3& position) {
    SceneBody body;
    body.shape = shape;
    body.material = std::move(material);
    body.position = tidy(position);
    return body;
}

Quat aboutAxis(const Vec3& axis, double angle) {
    return Quat(Eigen::AngleAxisd(angle, axis));
}

Quat randomOrientation(SplitMix64& random) {
    for (;;) {
        const double w = random.symmetric();
        const Vec3 v = random.symmetricVector();
        const double length_squared = w * w + v.squaredNorm();
        if (length_squared > 0.01 && length_squared <= 1) {
            const Vec3 unit = v / std::sqrt(length_squared);
            return tidy(Quat(w / std::sqrt(length_squared), unit.x(), unit.y(), unit.z()));
        }
    }
}

std::vector<Shape> stoneShapes(SplitMix64& random, int count, double radius) {
    std::vector<Shape> shapes;
    for (int i = 0; i < count; ++i) {
        const Vec3 middle(0.9, 0.78, 0.63);
        const Vec3 halves = radius * (middle + Vec3(0.1, 0.12, 0.12).cwiseProduct(random.symmetricVector()));
        std::vector<Vec3> points;
        while (points.size() < 16) {
            const Vec3 direction = random.symmetricVector();
            const double length = direction.norm();
            if (length < 0.3 || length > 1) continue;
            points.push_back(tidy(Vec3(halves.cwiseProduct(direction / length) * random.between(0.88, 1.0))));
        }
        shapes.emplace_back(ConvexHull(std::move(points)));
    }
    return shapes;
}

void addStones(Scene& scene, const StoneBed& bed, SplitMix64& random) {
    const std::vector<Shape> shapes = stoneShapes(random, 24, bed.radius);
    const double cell = 2.1 * bed.radius;
    for (int i = 0; i < bed.columns * bed.rows * bed.layers; ++i) {
        const Vec3 index(i % bed.columns - 0.5 * (bed.columns - 1), i / bed.columns % bed.rows - 0.5 * (bed.rows - 1),
                         i / (bed.columns * bed.rows));
        SceneBody stone =
            dynamicBody(shapes[random.next() % shapes.size()], bed.material, bed.pose.toOuter(cell * index));
        stone.orientation = randomOrientation(random);
        scene.bodies.push_back(std::move(stone));
    }
}

void addWall(Scene& scene, int rows, double x, double size) {
    const double spacing = 1.1 * size;
    for (int row = 0; row < rows; ++row) {
        const int boxes = rows - row;
        for (int i = 0; i < boxes; ++i) {
            const Vec3 position(x, (i - 0.5 * (boxes - 1)) * spacing, (row + 0.5) * size);
            scene.bodies.push_back(dynamicBody(Box{Vec3::Constant(size)}, "oak", position));
        }
    }
}

}  // namespace cairn
