#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "cases.h"
#include "granular_tools.h"
#include "incline_box.h"

namespace cairn::validation {

namespace repose_case {
namespace {

constexpr double tray = 10 * grain;  ///< inner width [m]
constexpr double rim = 1 * grain;    ///< height [m]

constexpr double outer = tray / 2 + 0.2 * grain;  ///< half of the outer width [m]: centres above the rim reach that far

/// Angle of the flanks of the heap that stays on a square tray with a rim when more is poured onto it than it holds
/// [°]: that of a pyramid with the volume of the grains whose centres are above the rim.
double heap(double friction, double rolling, std::uint64_t seed, const Plan& plan) {
    Grains grains(granularSettings(), grainLaw(friction, rolling), grainLaw(friction, rolling), seed);
    const double half = tray / 2;
    grains.addBlock(Vec3(-outer, -outer, -1), Vec3(outer, outer, 0));
    grains.addBlock(Vec3(-outer, -outer, 0), Vec3(outer, -half, rim));
    grains.addBlock(Vec3(-outer, half, 0), Vec3(outer, outer, rim));
    grains.addBlock(Vec3(-outer, -half, 0), Vec3(-half, half, rim));
    grains.addBlock(Vec3(half, -half, 0), Vec3(outer, half, rim));
    const int count = plan.isQuick() ? 250 : 450;
    grains.rain(Sphere{grain / 2}, count, 5.2 * grain, 0.05, 1.05 * grain);
    const double end = plan.isQuick() ? 3 : 8;
    while (grains.world.time() < end) {
        plan.alive();
        for (int i = 0; i < 48; ++i) grains.world.step();
        std::erase_if(grains.ids, [&](BodyId id) {
            if (grains.world.pose(id).position.z() > -2) return false;
            grains.world.removeBody(id);
            return true;
        });
    }
    double above = 0;
    for (const BodyId id : grains.ids) {
        if (grains.world.pose(id).position.z() > rim) ++above;
    }
    const double volume = above * std::numbers::pi / 6 * grain * grain * grain / 0.58;
    const double height = 3 * volume / (4 * outer * outer);
    return std::atan(height / outer) / degree;
}

Result run(const Plan& plan) {
    Result result;
    constexpr std::array<double, 3> frictions = {0.1, 0.4, 0.8};
    constexpr std::array<double, 3> rollings = {0, 0.05, 0.2};
    std::array<std::array<double, 3>, 3> angle{};
    for (std::size_t r = 0; r < rollings.size(); ++r) {
        Line line{fmt::format("µr = {:g} r", rollings[r]), {}, {}};
        for (std::size_t f = 0; f < frictions.size(); ++f) {
            Fillings heaps;
            for (const std::uint64_t seed : seedsOfFillings(plan, 3)) {
                heaps.add(heap(frictions[f], rollings[r] * grain / 2, seed, plan));
            }
            angle[r][f] = heaps.mean();
            result.show("angle of repose", "°", heaps.mean(),
                        fmt::format("µ = {:g}, rolling friction {:g} radii", frictions[f], rollings[r]), heaps.text());
            line.x.push_back(frictions[f]);
            line.y.push_back(angle[r][f]);
        }
        if (result.figures.empty()) result.figures.push_back({"Angle of repose", "µ", "angle [°]", {}});
        result.figures.front().lines.push_back(std::move(line));
    }
    for (std::size_t r = 0; r < rollings.size(); ++r) {
        result.atLeast("rise from µ = 0.1 to 0.8", "°", angle[r].back() - angle[r].front(), 3,
                       fmt::format("rolling friction {:g} radii", rollings[r]));
    }
    for (std::size_t f = 0; f < frictions.size(); ++f) {
        result.atLeast("rise from no rolling friction to 0.2 radii", "°", angle.back()[f] - angle.front()[f], 3,
                       fmt::format("µ = {:g}", frictions[f]));
    }
    result.atMost("angle at µ = 0.8 and 0.2 radii", "°", angle[2][2], 45);
    return result;
}

}  // namespace
}  // namespace repose_case

const Case repose{
    "repose",
    "Granular",
    "Heaps are the steeper the more their grains resist sliding and rolling",
    "the angle rises with µ and with rolling friction",
    "450 spheres of 10 cm poured onto a tray of 10 × 10 diameters with a rim of one; the angle is that of a "
    "pyramid over the outer width of the rim with the volume of the grains above it at a solid fraction of 0.58; the "
    "mean of three heaps each.",
    repose_case::run};

}  // namespace cairn::validation
