#include <cmath>

#include "cases.h"
#include "incline_box.h"

namespace cairn::validation {

namespace static_over_kinetic_case {
namespace {

constexpr double friction_static = 0.5;
constexpr double friction_kinetic = 0.3;

/// Acceleration within 0.5 s of a box that begins at rest [m/s²].
double acceleration(double rate, double angle) {
    InclineBox setup(accurateSettings(rate), angle, 0.3,
                     {.restitution = 0, .static_friction = friction_static, .kinetic_friction = friction_kinetic});
    runUntil(setup.world, 0.5);
    return setup.world.linearVelocity(setup.box).norm() / setup.world.time();
}

Result run(const Plan& plan) {
    Result result;
    const double limit = std::atan(friction_static);
    const double above = limit + 0.02 * degree;
    const double jump = g * (std::sin(above) - friction_kinetic * std::cos(above));
    measureOver(result, plan.rates(),
                {{"acceleration 0.02° below atan µs", "m/s²", Rule::absolute, 0, 1e-4, 240},
                 {"acceleration 0.02° above atan µs", "m/s²", Rule::relative, jump, 1e-4, 240}},
                [&](double rate) {
                    return std::vector{acceleration(rate, limit - 0.02 * degree), acceleration(rate, above)};
                });
    Line measured{"measured", {}, {}};
    Line expected{"expected", {}, {}, true};
    for (double angle = 20 * degree; angle < 34 * degree; angle += 0.5 * degree) {
        plan.alive();
        measured.x.push_back(angle / degree);
        measured.y.push_back(acceleration(960, angle));
        expected.x.push_back(angle / degree);
        expected.y.push_back(angle < limit ? 0 : g * (std::sin(angle) - friction_kinetic * std::cos(angle)));
    }
    result.figures.push_back({"The jump from static to kinetic friction", "θ [°]", "a [m/s²]", {measured, expected}});
    return result;
}

}  // namespace
}  // namespace static_over_kinetic_case

const Case static_over_kinetic{"static-over-kinetic",
                               "Incline",
                               "Static friction above kinetic friction shows its jump",
                               "a = 0 below tan θ = µs, g (sin θ − µk cos θ) above",
                               "µs = 0.5, µk = 0.3.",
                               static_over_kinetic_case::run};

}  // namespace cairn::validation
