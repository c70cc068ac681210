#include <cmath>

#include "cases.h"
#include "gas_tools.h"

namespace cairn::validation {

namespace haff_case {
namespace {

constexpr double radius = 0.05;    ///< [m]
constexpr double fraction = 0.05;  ///< of the cage
constexpr double restitution = 0.9;

/// Part of the balls' surroundings that is inside the cage: a ball near a wall has no neighbours behind it. The mean of
/// Π(1 − x|kᵢ|) over all directions k. @param x diameter over the width that the centres reach
double partInside(double x) {
    constexpr double one = 1.0 / 2;                   // mean of |k₁|
    const double two = 2 / (3 * std::numbers::pi);    // of |k₁k₂|
    const double three = 1 / (4 * std::numbers::pi);  // of |k₁k₂k₃|
    return 1 - 3 * one * x + 3 * two * x * x - three * x * x * x;
}

Result run(const Plan& plan) {
    Result result;
    const double rate = plan.isQuick() ? 480 : 960;
    const double duration = plan.isQuick() ? 6 : 20;
    // With a thousand the rate of one run is off by up to 4 % by chance.
    const int per_edge = plan.isQuick() ? 10 : 16;
    Gas gas(gasSettings(rate, std::sqrt(std::numbers::pi / 3)), per_edge, radius, fraction, 1, contactLaw(1, 0));
    // The speeds become Maxwell's while the balls are still elastic.
    runUntil(gas.world, 4);
    gas.world.setPairProperties(MaterialId{0}, MaterialId{0}, contactLaw(restitution, 0));
    const double begin = gas.world.time();
    const double kT = gas.temperature();
    // Where the centres can be.
    const double reach = 2 * (gas.half - radius);
    const double density = static_cast<double>(gas.balls.size()) / std::pow(reach, 3);
    const double eta = density * 4 / 3 * std::numbers::pi * std::pow(radius, 3);
    const double chi = (1 - eta / 2) / std::pow(1 - eta, 3);
    const double collisions =
        16 * radius * radius * density * chi * std::sqrt(std::numbers::pi * kT) * partInside(2 * radius / reach);
    const double cooling = (1 - restitution * restitution) / 6 * collisions;
    Line measured{"measured", {}, {}};
    Line expected{"Haff's law", {}, {}, true};
    Line fit{"1/√T", {}, {}};
    double st = 0, sr = 0, stt = 0, str = 0, n = 0;
    while (gas.world.time() - begin < duration) {
        plan.alive();
        runUntil(gas.world, gas.world.time() + 0.1);
        const double t = gas.world.time() - begin;
        const double relative = gas.temperature() / kT;
        measured.x.push_back(t);
        measured.y.push_back(relative);
        expected.x.push_back(t);
        expected.y.push_back(std::pow(1 + cooling * t, -2));
        const double root = 1 / std::sqrt(relative);
        st += t, sr += root, stt += t * t, str += t * root, ++n;
    }
    const double slope = (n * str - st * sr) / (n * stt - st * st);
    result.relative("rate of cooling 1/τ", "1/s", cooling, slope, 0.03, timeStepText(rate), "slope of √(T₀/T)");
    result.figures.push_back({"Cooling", "time [s]", "T/T₀", {measured, expected}, true});
    return result;
}

}  // namespace
}  // namespace haff_case

const Case haff{
    "haff",
    "Gas",
    "A gas of inelastic balls cools by Haff's law",
    "T = T₀/(1 + t/τ)², 1/τ = (1 − e²)/6 · 4d²nχ√(πkT₀/m), χ = (1 − η/2)/(1 − η)³",
    "4096 balls of 10 cm and 1 kg fill 5 % of a cage with elastic walls; e = 0.9 between balls. n is their number "
    "over the volume that their centres reach; ν is less by the part of their surroundings that is in the "
    "walls.",
    haff_case::run};

}  // namespace cairn::validation
