#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "cairn/scene.h"
#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace cradle_swing_case {
namespace {

constexpr std::size_t balls = 5;
constexpr double length = 1;       ///< of the rods [m]
constexpr double amplitude = 0.3;  ///< [rad]
using Velocities = std::array<double, balls>;

/// Velocities after one of five steel balls struck the others, which touch, through Hertz's contacts F ∝ δ^(3/2): the
/// contacts overlap in time, so that not all goes through to the last ball. Runge–Kutta in units in which masses and
/// stiffness are 1; the outcome does not depend on them.
Velocities hertz() {
    struct State {
        Velocities x{}, v{};
    };
    const auto rate = [](const State& s) {
        State d;
        d.x = s.v;
        for (std::size_t i = 0; i + 1 < balls; ++i) {
            const double overlap = s.x[i] - s.x[i + 1];
            const double force = overlap > 0 ? overlap * std::sqrt(overlap) : 0;
            d.v[i] -= force;
            d.v[i + 1] += force;
        }
        return d;
    };
    const auto plus = [](const State& s, const State& d, double h) {
        State sum = s;
        for (std::size_t i = 0; i < balls; ++i) {
            sum.x[i] += h * d.x[i];
            sum.v[i] += h * d.v[i];
        }
        return sum;
    };
    State s;
    s.v[0] = 1;
    constexpr double h = 1e-3;
    for (int step = 0; step < 40'000; ++step) {
        const State a = rate(s);
        const State b = rate(plus(s, a, h / 2));
        const State c = rate(plus(s, b, h / 2));
        const State d = rate(plus(s, c, h));
        s = plus(plus(plus(plus(s, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
    }
    return s.v;
}

/// Error of the energy over that of one raised ball.
struct EnergyError {
    double at_rest = 0;  ///< largest at the ends of the periods, when the balls turn
    double ever = 0;     ///< largest of all time steps, those in which balls touch included
};

EnergyError swing(const Scene& scene, const Settings& settings, int periods, const Plan& plan) {
    SceneRun run(scene, settings);
    const World& world = run.world();
    const double gravity = world.gravity().norm();
    constexpr double radius = 0.05;
    // Of a ball on a rod that turns with it, in the second order of the amplitude.
    const double period = 2 * std::numbers::pi * std::sqrt((length + 0.4 * radius * radius / length) / gravity) *
                          (1 + amplitude * amplitude / 16);
    const auto energy = [&] { return world.kineticEnergy() + world.potentialEnergy(); };
    const double begin = energy();
    const double raised = world.mass(run.ids().front()) * gravity * length * (1 - std::cos(amplitude));
    EnergyError error;
    for (int i = 1; i <= periods; ++i) {
        plan.alive();
        while (world.time() < i * period) {
            run.step();
            error.ever = std::max(error.ever, std::abs(energy() - begin) / raised);
        }
        error.at_rest = std::max(error.at_rest, std::abs(energy() - begin) / raised);
    }
    return error;
}

Result run(const Plan& plan) {
    Result result;
    const int periods = plan.isQuick() ? 5 : 100;
    // Two balls strike within the same time steps, in which the rods stretch: the scene's own time step is too long for
    // them, and the error falls with its square.
    for (const auto& [aside, finest] : {std::pair(1, 1), std::pair(2, plan.isQuick() ? 1 : 8)}) {
        const Scene scene = builtInScene(fmt::format("cradle_swing:5:{}", aside));
        for (int refinement = 1; refinement <= finest; refinement *= 2) {
            Settings settings = settingsFor(scene);
            settings.steps_per_second = refinement * settings.steps_per_second;
            const EnergyError error = swing(scene, settings, periods, plan);
            const std::string setup = fmt::format("{}, {}", scene.name, timeStepText(settings.steps_per_second));
            const std::size_t first = result.quantities.size();
            result.atMost(
                fmt::format("energy at the ends of {} periods, largest error over that of a raised ball", periods), "",
                error.at_rest, 1e-6, setup);
            if (refinement < finest) result.onlyShowFrom(first);
            result.show("energy in any time step, largest error likewise", "", error.ever, setup,
                        "within a time step in which balls strike each other the rods stretch");
        }
    }
    const Velocities computed = hertz();
    constexpr Velocities published = {-0.071, -0.030, -0.015, 0.127, 0.989};
    for (std::size_t i = 0; i < balls; ++i) {
        result.absolute(fmt::format("reference: ball {} of a cradle of steel balls, by Hertz's contacts", i + 1), "m/s",
                        published[i], computed[i], 1e-3, "integrated here",
                        "what a real cradle does at the first impact; rigid impacts in sequence give 0, 0, 0, 0, 1");
    }
    return result;
}

}  // namespace
}  // namespace cradle_swing_case

const Case cradle_swing{"cradle-swing",
                        "Newton's cradle",
                        "A cradle on rods swings on",
                        "energy is kept; five balls with F ∝ δ^(3/2) as the reference for real ones",
                        "Built-in scene of five elastic balls on rods of 1 m, pulled aside by 0.3 rad.",
                        cradle_swing_case::run};

}  // namespace cairn::validation
