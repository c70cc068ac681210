#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace bouncing_case {
namespace {

constexpr double height = 1;    ///< [m]
constexpr double radius = 0.1;  ///< [m]
constexpr int bounces = 10;
/// Of detection [m]: the tenth bounce at e = 0.5 is only 1 µm high, and within the margin a ball counts as touching.
constexpr double margin = 1e-9;
/// Slower impacts do not bounce [m/s]: the tenth one at e = 0.5 has 8.7 mm/s. All further bounces together last 0.1 %
/// of the time, but each takes a time step at least.
constexpr double rest = 5e-3;

struct Bounces {
    std::vector<double> heights;  ///< between the bounces [m]
    double time = 0;              ///< until it rests [s]
    Line path{"height", {}, {}};
};

Bounces bounce(double rate, double restitution, double duration, const Plan& plan) {
    Settings settings = accurateSettings(rate);
    settings.detection.contact_margin = margin;
    settings.resolution.restitution_speed = RestitutionSpeed::touching;
    settings.resolution.restitution_threshold = rest;
    World world = makeWorld(settings, Vec3(0, 0, -g), contactLaw(restitution, 0));
    addPlane(world);
    const BodyId id = world.addBody(body(Sphere{radius}, 1, Vec3(0, 0, radius + height)));
    Bounces found;
    double before = 0;
    double peak = 0;
    while (world.time() < duration) {
        world.step();
        if (world.stepCount() % 4096 == 0) plan.alive();
        const double v = world.linearVelocity(id).z();
        const double z = world.pose(id).position.z() - radius;
        peak = std::max(peak, z + std::max(v, 0.0) * std::max(v, 0.0) / (2 * g));
        if (before < 0 && v > 0) {
            found.heights.push_back(0);
            peak = z + v * v / (2 * g);
        }
        if (!found.heights.empty()) found.heights.back() = peak;
        if (std::abs(v) > 0.01 * restitution) found.time = world.time();
        if (world.stepCount() % std::max<std::int64_t>(1, static_cast<std::int64_t>(rate / 100)) == 0) {
            found.path.x.push_back(world.time());
            found.path.y.push_back(z);
        }
        before = v;
    }
    return found;
}

void measure(Result& result, const Plan& plan, double restitution) {
    const double fall = std::sqrt(2 * height / g);
    const double total = fall * (1 + restitution) / (1 - restitution);
    std::vector<double> rates = {240, 960, 3840};
    if (!plan.isQuick()) rates.push_back(15360);
    Line path;
    const auto worstHeight = [&](const Bounces& found) {
        double worst = 0;
        for (int n = 0; n < bounces; ++n) {
            const double expected = height * std::pow(restitution, 2 * (n + 1));
            const double measured = n < static_cast<int>(found.heights.size()) ? found.heights[n] : 0;
            worst = std::max(worst, std::abs(measured / expected - 1));
        }
        return worst;
    };
    measureOver(
        result, rates,
        {{fmt::format("heights of ten bounces, worst relative error, e = {}", restitution), "", Rule::at_most, 0, 1e-3},
         {fmt::format("time until it rests, e = {}", restitution), "s", Rule::relative, total, 0.01, 960,
          "bounces take a time step at least; impacts below 5 mm/s end them"}},
        [&](double rate) {
            Bounces found = bounce(rate, restitution, 1.2 * total, plan);
            if (rate == 960) path = found.path;
            return std::vector{worstHeight(found), found.time};
        });
    path.label = fmt::format("e = {}", restitution);
    if (result.figures.empty()) result.figures.push_back({"Height at Δt = 1/960 s", "time [s]", "height [m]", {}});
    result.figures.front().lines.push_back(std::move(path));
}

Result run(const Plan& plan) {
    Result result;
    for (const double restitution : {0.5, 0.8, 0.9}) measure(result, plan, restitution);
    return result;
}

}  // namespace
}  // namespace bouncing_case

const Case bouncing{
    "bouncing",
    "Bouncing",
    "A ball bounces lower and lower",
    "hₙ = e²ⁿh; total time √(2h/g)·(1 + e)/(1 − e): 1.3546, 4.0637 and 8.5789 s",
    "h = 1 m, e = 0.5, 0.8, 0.9, contact margin 1 nm, restitution_speed 'touching': the impact happens somewhere "
    "within a time step, and restitution takes the speed at that moment.",
    bouncing_case::run};

}  // namespace cairn::validation
