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
