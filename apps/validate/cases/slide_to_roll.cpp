#include <cmath>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace {

constexpr double v0 = 5;  ///< [m/s]
constexpr double friction = 0.2;
constexpr double radius = 0.1;  ///< [m]

struct Roll {
    double speed = 0;     ///< of rolling [m/s]
    double time = 0;      ///< when rolling begins [s]
    double distance = 0;  ///< until then [m]
};

Roll roll(double rate) {
    World world = makeWorld(accurateSettings(rate), Vec3(0, 0, -g), contactLaw(0, friction));
    addPlane(world);
    BodyDescription ball = body(Sphere{radius}, 1, Vec3(0, 0, radius));
    ball.linear_velocity = Vec3(v0, 0, 0);
    const BodyId id = world.addBody(ball);
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

Result run(const Plan& plan) {
    Result result;
    const double time = 2 * v0 / (7 * friction * g);
    const double distance = 12 * v0 * v0 / (49 * friction * g);
    std::vector<double> rates = plan.rates();
    measureOver(result, rates,
                {{"speed of rolling", "m/s", Rule::relative, 5 * v0 / 7, 1e-4, 240},
                 {"distance until it rolls", "m", Rule::relative, distance, 2e-3, 960,
                  "ends with the time step in which rolling begins: one time step is 0.12 %"}},
                [](double rate) {
                    const Roll r = roll(rate);
                    return std::vector{r.speed, r.distance};
                });
    for (const double rate : rates) {
        result.absolute("time until it rolls", "s", time, roll(rate).time, 1 / rate, timeStepText(rate),
                        "within one time step");
    }
    return result;
}

}  // namespace

const Case slide_to_roll{"slide-to-roll",
                         "Rolling",
                         "A sliding ball begins to roll",
                         "v = 5v₀/7, t = 2v₀/(7µg), s = 12v₀²/(49µg)",
                         "Ball, radius 0.1 m, v₀ = 5 m/s without spin, µ = 0.2, on a plane.",
                         run};

}  // namespace cairn::validation
