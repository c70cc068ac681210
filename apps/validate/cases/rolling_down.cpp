#include <cmath>
#include <numbers>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace rolling_down_case {
namespace {

constexpr double angle = 20 * std::numbers::pi / 180;
constexpr double friction = 0.5;
constexpr double radius = 0.1;  ///< [m]
constexpr double watched = 1;   ///< [s]

/// Acceleration and distance after one second. @param k becomes I/(m r²) of the shape
std::vector<double> roll(double rate, const Shape& shape, double& k) {
    const Incline incline(angle, 0.3);
    World world = makeWorld(accurateSettings(rate), Vec3(0, 0, -g), contactLaw(0, friction));
    addPlane(world, incline.normal);
    BodyDescription description = body(shape, 1, incline.normal * radius);
    Mat3 axes;  // the shape's z axis, about which it rolls, lies across
    axes << incline.downhill, incline.normal, incline.downhill.cross(incline.normal);
    description.pose.orientation = Quat(axes);
    const BodyId id = world.addBody(description);
    k = world.principalInertia(id).z() / (radius * radius);
    runUntil(world, watched);
    const double v = world.linearVelocity(id).dot(incline.downhill);
    const double s = (world.pose(id).position - description.pose.position).dot(incline.downhill);
    return {v / world.time(), s};
}

void measure(Result& result, const Plan& plan, const Shape& shape, const std::string& name) {
    double k = 0;
    roll(240, shape, k);
    const double expected = g * std::sin(angle) / (1 + k);
    measureOver(result, plan.rates(),
                {{"acceleration, " + name, "m/s²", Rule::relative, expected, 1e-4, 240},
                 {"distance after 1 s, " + name, "m", Rule::relative, expected / 2, 1e-4, 960}},
                [&](double rate) { return roll(rate, shape, k); });
}

Result run(const Plan& plan) {
    Result result;
    measure(result, plan, Sphere{radius}, "sphere");
    measure(result, plan, Cylinder{.radius = radius, .length = 0.3}, "cylinder");
    measure(result, plan, Capsule{radius, 0.3}, "capsule");
    return result;
}

}  // namespace
}  // namespace rolling_down_case

const Case rolling_down{
    "rolling-down",
    "Rolling",
    "Round bodies roll down an incline",
    "a = g sin θ / (1 + k), k = I/(m r²)",
    "Radius 0.1 m; cylinder and capsule 0.3 m long between their caps; θ = 20°, µ = 0.5, from rest, 1 s.",
    rolling_down_case::run};

}  // namespace cairn::validation
