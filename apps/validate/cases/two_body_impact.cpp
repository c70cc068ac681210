#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace two_body_impact_case {
namespace {

constexpr double radius = 0.1;  ///< [m]

struct Outcome {
    double v1 = 0, v2 = 0;  ///< [m/s]
    double momentum = 0;    ///< relative error
};

Outcome collide(double ratio, double restitution, double rate) {
    World world = makeWorld(accurateSettings(rate), Vec3::Zero(), contactLaw(restitution, 0.3));
    BodyDescription first = body(Sphere{radius}, ratio, Vec3(-radius - 0.01, 0, 0));
    first.linear_velocity = Vec3(1, 0, 0);
    const BodyId a = world.addBody(first);
    const BodyId b = world.addBody(body(Sphere{radius}, 1, Vec3(radius, 0, 0)));
    runUntil(world, 0.1);
    return {world.linearVelocity(a).x(), world.linearVelocity(b).x(), std::abs(world.linearMomentum().x() / ratio - 1)};
}

/// Of both velocities, relative to the larger one.
double errorOf(const Outcome& outcome, double ratio, double restitution) {
    const double v1 = (ratio - restitution) / (ratio + 1);
    const double v2 = ratio * (1 + restitution) / (ratio + 1);
    return std::max(std::abs(outcome.v1 - v1), std::abs(outcome.v2 - v2)) / std::max(std::abs(v1), std::abs(v2));
}

Result run(const Plan& plan) {
    Result result;
    for (const double restitution : {0.0, 0.5, 1.0}) {
        for (const double ratio : {1.0, 10.0, 1e3, 1e6, 1e-3, 1e-6}) {
            double velocities = 0;
            double momentum = 0;
            for (const double rate : plan.rates()) {
                const Outcome outcome = collide(ratio, restitution, rate);
                velocities = std::max(velocities, errorOf(outcome, ratio, restitution));
                momentum = std::max(momentum, outcome.momentum);
            }
            const std::string setup = fmt::format("m₁/m₂ = {:g}, e = {}, worst time step", ratio, restitution);
            const bool stopped = ratio < 1 && restitution == 0;
            result.atMost("error of both velocities, relative to the larger", "", velocities, 1e-12, setup,
                          stopped ? "only this part of the speed is left, and the impulses that take the rest are "
                                    "rounded at 1e-16 of all"
                                  : "");
            result.atMost("momentum, relative error", "", momentum, 1e-12, setup);
        }
    }
    return result;
}

}  // namespace
}  // namespace two_body_impact_case

const Case two_body_impact{"two-body-impact",
                           "Impacts",
                           "Two balls collide",
                           "v₁' = (m₁ − e m₂)/(m₁ + m₂) v, v₂' = m₁(1 + e)/(m₁ + m₂) v",
                           "Central impact without gravity, mass ratios from 10⁻⁶ to 10⁶, e = 0, 0.5 and 1.",
                           two_body_impact_case::run};

}  // namespace cairn::validation
