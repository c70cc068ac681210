#include <fmt/format.h>

#include <cmath>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace {

constexpr double radius = 0.1;  ///< [m]
constexpr double normal_speed = 2;
constexpr double restitution = 0.8;
constexpr double friction = 0.25;

struct Rebound {
    double tangential = 0, normal = 0, spin = 0;
};

/// @param ratio vₜ/vₙ before
Rebound rebound(double ratio) {
    World world = makeWorld(accurateSettings(960), Vec3::Zero(), contactLaw(restitution, friction));
    addPlane(world);
    // The ball touches at the end of the first time step, so that the lever arm of the impulse is the whole radius.
    BodyDescription ball = body(Sphere{radius}, 1, Vec3(0, 0, radius + normal_speed / 960));
    ball.linear_velocity = Vec3(ratio * normal_speed, 0, -normal_speed);
    const BodyId id = world.addBody(ball);
    runUntil(world, 0.1);
    return {world.linearVelocity(id).x(), world.linearVelocity(id).z(), world.angularVelocity(id).y()};
}

Rebound expected(double ratio) {
    const double before = ratio * normal_speed;
    const double slipping = friction * (1 + restitution) * normal_speed;
    const double change = std::min(slipping, 2 * before / 7);
    return {before - change, restitution * normal_speed, 2.5 * change / radius};
}

Result run(const Plan&) {
    Result result;
    const double limit = 3.5 * friction * (1 + restitution);
    Line measured{"measured", {}, {}};
    Line formula{"expected", {}, {}};
    for (const double part : {0.1, 0.3, 0.5, 0.7, 0.9, 0.999, 1.001, 1.1, 1.5, 2.0, 4.0}) {
        const double ratio = part * limit;
        const Rebound m = rebound(ratio);
        const Rebound e = expected(ratio);
        const double error = std::max(
            {std::abs(m.tangential - e.tangential), std::abs(m.normal - e.normal), radius * std::abs(m.spin - e.spin)});
        result.atMost("largest error of vₜ, vₙ and ωr", "m/s", error, 1e-10,
                      fmt::format("vₜ/vₙ = {:.3f} ({})", ratio, part < 1 ? "sticks" : "slips"));
        measured.x.push_back(ratio);
        measured.y.push_back(m.tangential / normal_speed);
        formula.x.push_back(ratio);
        formula.y.push_back(e.tangential / normal_speed);
    }
    result.figures.push_back({"Tangential velocity after the impact", "vₜ/vₙ before", "vₜ'/vₙ", {measured, formula}});
    return result;
}

}  // namespace

const Case oblique_impact{"oblique-impact",
                          "Impacts",
                          "A ball hits a plate at an angle",
                          "slips: vₜ' = vₜ − µ(1 + e)vₙ; sticks: vₜ' = 5vₜ/7; limit vₜ/vₙ = 7µ(1 + e)/2",
                          "e = 0.8, µ = 0.25, vₙ = 2 m/s, no gravity.",
                          run};

}  // namespace cairn::validation
