#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace cradle_case {
namespace {

constexpr double radius = 0.05;  ///< [m]

/// Largest error of all velocities after k balls hit n − k resting ones [m/s].
double collide(int n, int k) {
    const Settings settings = accurateSettings(960, ResolutionKind::impulse_queue);
    World world = makeWorld(settings, Vec3::Zero(), contactLaw(1, 0));
    std::vector<BodyId> balls;
    for (int i = 0; i < n; ++i) {
        const bool moving = i < k;
        BodyDescription ball = body(Sphere{radius}, 1, Vec3(2 * radius * i - (moving ? 0.05 : 0), 0, 0));
        if (moving) ball.linear_velocity = Vec3(1, 0, 0);
        balls.push_back(world.addBody(ball));
    }
    runUntil(world, 0.2);
    double worst = 0;
    for (int i = 0; i < n; ++i) {
        const double expected = i >= n - k ? 1 : 0;
        worst = std::max(worst, std::abs(world.linearVelocity(balls[i]).x() - expected));
    }
    return worst;
}

Result run(const Plan& plan) {
    Result result;
    for (int n = 2; n <= 10; ++n) {
        double worst = 0;
        for (int k = 1; k < n; ++k) {
            plan.alive();
            worst = std::max(worst, collide(n, k));
        }
        result.atMost("largest error of a velocity, every k", "m/s", worst, 1e-12, fmt::format("n = {}", n));
    }
    const std::vector<double> real = {-0.071, -0.030, -0.015, 0.127, 0.989};
    for (std::size_t i = 0; i < real.size(); ++i) {
        result.show(fmt::format("real cradle of five balls by Hertz's contacts, ball {}", i + 1), "m/s", real[i],
                    "reference");
    }
    return result;
}

}  // namespace
}  // namespace cradle_case

const Case cradle{
    "cradle",
    "Newton's cradle",
    "As many balls leave as arrive",
    "sequential impacts, e = 1: k balls in, k balls out",
    "Touching balls in a row without gravity; k from 1 to n − 1 arrive at 1 m/s. A real cradle disperses a "
    "little, since its contacts overlap in time.",
    cradle_case::run};

}  // namespace cairn::validation
