#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace oblique_impact_case {
namespace {

constexpr double radius = 0.1;  ///< [m]
constexpr double normal_speed = 2;
constexpr double restitution = 0.8;
constexpr double friction = 0.25;
constexpr double limit = 3.5 * friction * (1 + restitution);  ///< of vₜ/vₙ, up to which the ball sticks
/// vₜ/vₙ over that limit.
constexpr std::array sticking = {0.1, 0.3, 0.5, 0.7, 0.9, 0.999};
constexpr std::array slipping = {1.001, 1.1, 1.5, 2.0, 4.0};

struct Rebound {
    double tangential = 0, normal = 0, spin = 0;
};

/// @param ratio vₜ/vₙ before @param rate steps per second
Rebound rebound(double ratio, double rate) {
    World world = makeWorld(accurateSettings(rate), Vec3::Zero(), contactLaw(restitution, friction));
    addPlane(world);
    // The ball touches at the end of the first time step, so that the lever arm of the impulse is the whole radius.
    BodyDescription ball = body(Sphere{radius}, 1, Vec3(0, 0, radius + normal_speed / rate));
    ball.linear_velocity = Vec3(ratio * normal_speed, 0, -normal_speed);
    const BodyId id = world.addBody(ball);
    runUntil(world, 0.1);
    return {world.linearVelocity(id).x(), world.linearVelocity(id).z(), world.angularVelocity(id).y()};
}

Rebound expected(double ratio) {
    const double before = ratio * normal_speed;
    const double slid = friction * (1 + restitution) * normal_speed;
    const double change = std::min(slid, 2 * before / 7);
    return {before - change, restitution * normal_speed, 2.5 * change / radius};
}

/// Largest error of vₜ, vₙ and ωr [m/s].
double errorOf(const Rebound& measured, double ratio) {
    const Rebound e = expected(ratio);
    return std::max({std::abs(measured.tangential - e.tangential), std::abs(measured.normal - e.normal),
                     radius * std::abs(measured.spin - e.spin)});
}

/// vₜ/vₙ up to which the ball rolls off, by bisection.
double stickingLimit(double rate) {
    return threshold(0.5 * limit, 2 * limit, 1e-6, [&](double ratio) {
        const Rebound m = rebound(ratio, rate);
        return std::abs(m.tangential - radius * m.spin) < 1e-9;
    });
}

Result run(const Plan& plan) {
    Result result;
    const auto worst = [](std::span<const double> parts, double rate) {
        double error = 0;
        for (const double part : parts) error = std::max(error, errorOf(rebound(part * limit, rate), part * limit));
        return error;
    };
    measureOver(result, plan.rates(),
                {{"largest error of vₜ, vₙ and ωr, six angles at which it sticks", "m/s", Rule::at_most, 0, 1e-10, 240},
                 {"largest error of vₜ, vₙ and ωr, five angles at which it slips", "m/s", Rule::at_most, 0, 1e-10, 240},
                 {"vₜ/vₙ up to which it sticks", "", Rule::absolute, limit, 2e-6, 240, "bisection to 10⁻⁶"}},
                [&](double rate) {
                    return std::vector{worst(sticking, rate), worst(slipping, rate), stickingLimit(rate)};
                });
    Line measured{"measured", {}, {}};
    Line formula{"expected", {}, {}, true};
    for (const double part : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.999, 1.001, 1.1, 1.5, 2.0, 3.0, 4.0}) {
        const double ratio = part * limit;
        measured.x.push_back(ratio);
        measured.y.push_back(rebound(ratio, 960).tangential / normal_speed);
        formula.x.push_back(ratio);
        formula.y.push_back(expected(ratio).tangential / normal_speed);
    }
    result.figures.push_back({"Tangential velocity after the impact", "vₜ/vₙ before", "vₜ'/vₙ", {measured, formula}});
    return result;
}

}  // namespace
}  // namespace oblique_impact_case

const Case oblique_impact{"oblique-impact",
                          "Impacts",
                          "A ball hits a plate at an angle",
                          "slips: vₜ' = vₜ − µ(1 + e)vₙ; sticks: vₜ' = 5vₜ/7; limit vₜ/vₙ = 7µ(1 + e)/2",
                          "e = 0.8, µ = 0.25, vₙ = 2 m/s, no gravity; vₜ/vₙ from 0.1 to 4 times the limit.",
                          oblique_impact_case::run};

}  // namespace cairn::validation
