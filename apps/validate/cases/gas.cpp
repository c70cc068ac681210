#include <algorithm>
#include <cmath>

#include "cases.h"
#include "gas_tools.h"

namespace cairn::validation {

namespace gas_case {
namespace {

constexpr double radius = 0.05;   ///< [m]
constexpr double fraction = 0.1;  ///< of the cage
constexpr double speed = 1;       ///< [m/s]

/// Maxwell's distribution of speeds, as a probability.
double maxwell(double v, double kT) {
    const double x = v / std::sqrt(2 * kT);
    return std::erf(x) - 2 / std::sqrt(std::numbers::pi) * x * std::exp(-x * x);
}

/// p of the two-sided Kolmogorov–Smirnov test. @param sorted [m/s]
double kolmogorovSmirnov(const std::vector<double>& sorted, double kT) {
    const auto n = static_cast<double>(sorted.size());
    double distance = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const double f = maxwell(sorted[i], kT);
        distance = std::max(
            {distance, std::abs(f - static_cast<double>(i) / n), std::abs(f - static_cast<double>(i + 1) / n)});
    }
    const double x = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance;
    double p = 0;
    for (int k = 1; k < 100; ++k) p += 2 * (k % 2 == 1 ? 1 : -1) * std::exp(-2 * k * k * x * x);
    return std::clamp(p, 0.0, 1.0);
}

/// Pressure over density and kT of hard spheres. @source Carnahan and Starling 1969, doi:10.1063/1.1672048
double carnahanStarling(double eta) {
    return (1 + eta + eta * eta - eta * eta * eta) / std::pow(1 - eta, 3);
}

void simulate(Result& result, double rate, double duration, const Plan& plan) {
    // kT = m·speed²/3; the mean approach in an impact is √(π·kT/m).
    Gas gas(gasSettings(rate, std::sqrt(std::numbers::pi / 3) * speed), 10, radius, fraction, speed, contactLaw(1, 0));
    const double energy = gas.world.kineticEnergy();
    const Vec3 momentum = gas.world.linearMomentum();
    const double scale = static_cast<double>(gas.balls.size()) * speed;
    Vec3 given = Vec3::Zero();
    double pressed = 0;
    double density = 0;
    double counted = 0;
    double worst_energy = 0;
    double worst_momentum = 0;
    const double settled = 0.25 * duration;
    while (gas.world.time() < duration) {
        plan.alive();
        gas.world.step();
        const auto [impulse, inward] = gas.wallImpulse();
        given += impulse;
        worst_energy = std::max(worst_energy, std::abs(gas.world.kineticEnergy() / energy - 1));
        worst_momentum = std::max(worst_momentum, (gas.world.linearMomentum() - momentum - given).norm() / scale);
        if (gas.world.time() < settled) continue;
        pressed += inward;
        density += gas.densityInside();
        ++counted;
    }
    const std::string setup = timeStepText(rate);
    result.atMost("energy, largest relative error", "", worst_energy, 1e-10, setup);
    result.atMost("momentum with the walls' impulse, largest error over N m v", "", worst_momentum, 1e-12, setup);
    std::vector<double> speeds;
    for (const BodyId id : gas.balls) speeds.push_back(gas.world.linearVelocity(id).norm());
    std::sort(speeds.begin(), speeds.end());
    const double kT = gas.temperature();
    result.atLeast("Kolmogorov–Smirnov against Maxwell's speeds, p", "", kolmogorovSmirnov(speeds, kT), 0.01, setup);
    const double middle = 2 * gas.innerHalf();
    const double pressure = pressed / (counted / rate) / (6 * middle * middle);
    density /= counted;
    const double eta = density * 4 / 3 * std::numbers::pi * std::pow(radius, 3);
    result.relative("pressure on the walls", "Pa", density * kT * carnahanStarling(eta), pressure, 0.01, setup,
                    "in the middle of the walls, away from the edges, with the density in the middle of the cage");
    Line measured{"measured", {}, {}};
    Line expected{"Maxwell", {}, {}, true};
    for (std::size_t i = 0; i < speeds.size(); i += 5) {
        measured.x.push_back(speeds[i]);
        measured.y.push_back((static_cast<double>(i) + 0.5) / static_cast<double>(speeds.size()));
        expected.x.push_back(speeds[i]);
        expected.y.push_back(maxwell(speeds[i], kT));
    }
    result.figures = {
        {"Distribution of speeds at the end", "speed [m/s]", "part that is slower", {measured, expected}}};
}

Result run(const Plan& plan) {
    Result result;
    if (plan.isQuick()) {
        simulate(result, 960, 2, plan);
    } else {
        simulate(result, 960, 300, plan);
        simulate(result, 3840, 100, plan);
    }
    return result;
}

}  // namespace
}  // namespace gas_case

const Case gas{"gas",
               "Gas",
               "1000 elastic balls are a gas",
               "energy and momentum; Maxwell–Boltzmann; pressure by Carnahan and Starling",
               "Balls of 10 cm and 1 kg fill 10 % of a cage; no gravity, e = 1, no friction; all begin with 1 m/s.",
               gas_case::run};

}  // namespace cairn::validation
