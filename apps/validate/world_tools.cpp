#include "world_tools.h"

#include <cmath>

namespace cairn::validation {

Settings accurateSettings(double steps_per_second, ResolutionKind resolver) {
    Settings settings = Settings::preset(Preset::accuracy, steps_per_second, g);
    settings.integration.exact_flight = true;
    settings.sleep.sleeping = false;
    settings.resolution.resolution = resolver;
    if (resolver == ResolutionKind::impulse_queue) settings.resolution.iterations = 0;
    if (resolver == ResolutionKind::accelerated_sweeps) {
        settings.resolution.iterations = 1000;
        settings.resolution.tolerance = 0;
        settings.resolution.resolution_threshold *= 1e-3;
    }
    return settings;
}

World makeWorld(const Settings& settings, const Vec3& gravity, const PairProperties& law) {
    World world(settings);
    world.setGravity(gravity);
    world.addMaterial({.name = "matter", .density = 1000});
    world.setDefaultPairProperties(law);
    return world;
}

BodyDescription body(const Shape& shape, double mass, const Vec3& position) {
    BodyDescription description;
    description.shape = shape;
    description.mass = mass;
    description.pose.position = position;
    return description;
}

BodyId addPlane(World& world, const Vec3& normal) {
    BodyDescription plane;
    plane.shape = HalfSpace{.normal = normal, .offset = 0};
    plane.fixed = true;
    return world.addBody(plane);
}

void runUntil(World& world, double time) {
    const auto steps = static_cast<std::int64_t>(std::llround(time * world.settings().steps_per_second));
    while (world.stepCount() < steps) world.step();
}

Incline::Incline(double angle, double heading)
    : normal(std::sin(angle) * std::cos(heading), std::sin(angle) * std::sin(heading), std::cos(angle)),
      downhill(std::cos(angle) * std::cos(heading), std::cos(angle) * std::sin(heading), -std::sin(angle)) {}

Quat Incline::orientation() const {
    Mat3 axes;
    axes << downhill, normal.cross(downhill), normal;
    return Quat(axes);
}

double threshold(double low, double high, double resolution, const std::function<bool(double)>& holds) {
    while (high - low > resolution) {
        const double middle = (low + high) / 2;
        (holds(middle) ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace cairn::validation
