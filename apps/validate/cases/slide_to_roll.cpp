#include <cmath>
#include <numbers>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace slide_to_roll_case {
namespace {

constexpr double v0 = 5;  ///< [m/s]
constexpr double friction = 0.2;
constexpr double radius = 0.1;  ///< [m]

struct Roll {
    double speed = 0;     ///< of rolling [m/s]
    double time = 0;      ///< when rolling begins [s]
    double distance = 0;  ///< until then [m]
};

/// Of a round body whose z axis lies across its way.
Roll roll(double rate, const Shape& shape) {
    World world = makeWorld(accurateSettings(rate), Vec3(0, 0, -g), contactLaw(0, friction));
    addPlane(world);
    BodyDescription round = body(shape, 1, Vec3(0, 0, radius));
    round.pose.orientation = Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));
    round.linear_velocity = Vec3(v0, 0, 0);
    const BodyId id = world.addBody(round);
    Roll roll;
    while (world.time() < 1.5) {
        world.step();
        const double v = world.linearVelocity(id).x();
        const double slip = v - world.angularVelocity(id).y() * radius;
        if (roll.time == 0 && slip < 1e-6) {
            roll.time = world.time();
            roll.distance = world.pose(id).position.x();
        }
    }
    roll.speed = world.linearVelocity(id).x();
    return roll;
}

/// @param k I/(m r²)
void measure(Result& result, const Plan& plan, const Shape& shape, const std::string& name, double k) {
    const double speed = v0 / (1 + k);
    const double time = (v0 - speed) / (friction * g);
    const double distance = (v0 + speed) / 2 * time;
    const std::vector<double> rates = plan.rates();
    measureOver(result, rates,
                {{"speed of rolling, " + name, "m/s", Rule::relative, speed, 1e-4, 240},
                 {"distance until it rolls, " + name, "m", Rule::relative, distance, 2e-3, 960,
                  "ends with the time step in which rolling begins: one time step is 0.12 %"}},
                [&](double rate) {
                    const Roll r = roll(rate, shape);
                    return std::vector{r.speed, r.distance};
                });
    for (const double rate : rates) {
        result.absolute("time until it rolls, " + name, "s", time, roll(rate, shape).time, 1 / rate, timeStepText(rate),
                        "within one time step");
    }
}

Result run(const Plan& plan) {
    Result result;
    measure(result, plan, Sphere{radius}, "ball", 0.4);
    measure(result, plan, Cylinder{.radius = radius, .length = 0.3}, "cylinder", 0.5);
    return result;
}

}  // namespace
}  // namespace slide_to_roll_case

const Case slide_to_roll{"slide-to-roll",
                         "Rolling",
                         "A sliding ball or cylinder begins to roll",
                         "v = v₀/(1 + k), t = (v₀ − v)/(µg), s = t(v₀ + v)/2; k = I/(m r²): 5v₀/7 and 2v₀/3",
                         "Ball, and cylinder of 0.3 m, radius 0.1 m, v₀ = 5 m/s without spin, µ = 0.2, on a plane.",
                         slide_to_roll_case::run};

}  // namespace cairn::validation
