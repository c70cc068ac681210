#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace parabola_case {
namespace {

const Vec3 thrown(3, -4, 60);    ///< [m/s]
constexpr double duration = 10;  ///< [s]

/// Largest distance from the parabola, relative to the distance from the origin.
double deviation(double rate, bool exact) {
    Settings settings = accurateSettings(rate);
    settings.integration.exact_flight = exact;
    const Vec3 gravity(0, 0, -g);
    World world = makeWorld(settings, gravity, {});
    BodyDescription ball = body(Sphere{0.1}, 1, Vec3::Zero());
    ball.linear_velocity = thrown;
    const BodyId id = world.addBody(ball);
    double worst = 0;
    while (world.time() < duration - 0.5 / rate) {
        world.step();
        const double t = world.time();
        const Vec3 exact_position = thrown * t + gravity * (t * t / 2);
        worst = std::max(worst, (world.pose(id).position - exact_position).norm() / exact_position.norm());
    }
    return worst;
}

Result run(const Plan& plan) {
    Result result;
    measureOver(
        result, plan.rates(),
        {{"largest |Δx| / |x|, exact flight", "", Rule::at_most, 0, 1e-12, 240, "the rounding of every step adds up"}},
        [](double rate) { return std::vector{deviation(rate, true)}; });
    measureOver(result, plan.rates(), {{"the same with the thesis's order of stages", "", Rule::shown, 0, 0, 960}},
                [](double rate) { return std::vector{deviation(rate, false)}; });
    return result;
}

}  // namespace
}  // namespace parabola_case

const Case parabola{"parabola",
                    "Free flight",
                    "A thrown ball follows the parabola",
                    "x = v₀t + gt²/2",
                    "v₀ = (3, −4, 60) m/s for 10 s; the setting exact_flight. Without it positions follow the velocity "
                    "at the beginning of each step, as in the thesis.",
                    parabola_case::run};

}  // namespace cairn::validation
