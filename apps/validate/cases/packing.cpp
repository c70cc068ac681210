#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cases.h"
#include "granular_tools.h"

namespace cairn::validation {

namespace packing_case {
namespace {

constexpr double width = 8 * grain;  ///< of the shaft
constexpr int portion = 80;          ///< grains that are poured at once

bool isInside(const World& world, BodyId id, const Vec3& point) {
    const Pose pose = world.pose(id);
    const Vec3 local = pose.orientation.conjugate() * (point - pose.position);
    if (std::holds_alternative<Sphere>(world.shape(id))) return local.norm() < grain / 2;
    return local.cwiseAbs().maxCoeff() < grain / 2;
}

/// Part of the volume well inside that grains fill, by random points.
double solidFraction(Grains& grains) {
    const double reach = width / 2 - 1.5 * grain;
    const double lower = 1.5 * grain;
    const double upper = grains.level() - grain;
    constexpr int points = 20'000;
    int filled = 0;
    for (int i = 0; i < points; ++i) {
        const double x = grains.random.uniform(-reach, reach);
        const double y = grains.random.uniform(-reach, reach);
        const Vec3 point(x, y, grains.random.uniform(lower, upper));
        filled += std::any_of(grains.ids.begin(), grains.ids.end(),
                              [&](BodyId id) { return isInside(grains.world, id, point); });
    }
    return static_cast<double>(filled) / points;
}

double pack(const Shape& shape, double friction, std::uint64_t seed, const Plan& plan) {
    Settings settings = granularSettings();
    Grains grains(settings, grainLaw(friction), grainLaw(friction), seed);
    grains.addWall(Vec3::UnitZ(), 0);
    grains.addShaft(width);
    // In portions from little above those that lie: what falls from high mixes and presses the grains below.
    for (int poured = 0; poured < (plan.isQuick() ? 240 : 800); poured += portion) {
        grains.rain(shape, portion, width, grains.top() + grain, 1.8 * grain, Turned::any_way);
        const double end = grains.world.time() + 0.4;
        while (grains.world.time() < end) grains.world.step();
    }
    grains.settle(plan.isQuick() ? 2 : 4, plan);
    return solidFraction(grains);
}

/// @param range where it was measured
void packAll(Result& result, const Shape& shape, const char* name, double loosest, double densest, const char* range,
             const Plan& plan) {
    const std::array<double, 4> frictions = {0, 0.1, 0.3, 1};
    Line line{name, {}, {}};
    for (const double friction : frictions) {
        Fillings fraction;
        for (const std::uint64_t seed : seedsOfFillings(plan, 3)) fraction.add(pack(shape, friction, seed, plan));
        result.absolute(fmt::format("solid fraction of {}", name), "", (loosest + densest) / 2, fraction.mean(),
                        (densest - loosest) / 2 + 0.005, fmt::format("µ = {:g}", friction),
                        fmt::format("{:g} to {:g} ({}) and 0.005; {}", loosest, densest, range, fraction.text()));
        line.x.push_back(friction);
        line.y.push_back(fraction.mean());
    }
    result.atLeast(fmt::format("{}: fraction without friction less that with µ = 1", name), "",
                   line.y.front() - line.y.back(), 0.02);
    if (result.figures.empty()) result.figures.push_back({"Packing and friction", "µ", "solid fraction", {}});
    result.figures.front().lines.push_back(std::move(line));
}

Result run(const Plan& plan) {
    Result result;
    packAll(result, Sphere{grain / 2}, "spheres", 0.55, 0.64, "real grains", plan);
    packAll(result, Box{Vec3::Constant(grain)}, "cubes", 0.54, 0.67,
            "plastic dice, settled in a fluid and vibrated; rougher grains pack looser", plan);
    return result;
}

}  // namespace
}  // namespace packing_case

const Case packing{"packing",
                   "Granular",
                   "Poured grains pack the looser the rougher they are",
                   "random loose to random close packing: spheres 0.55 (Jerkins et al. 2008, "
                   "doi:10.1103/PhysRevLett.101.018301) to 0.64, cubes 0.54 to 0.67 (Baker and Kudrolli 2010, "
                   "doi:10.1103/PhysRevE.82.061304)",
                   "800 grains of 10 cm poured, turned any way, into a shaft of 8 × 8 diameters in portions of 80; the "
                   "fraction is measured 1.5 diameters from the walls, as the mean of three fillings. Performance "
                   "preset at 1/480 s with overlaps of at most 1 % of a grain.",
                   packing_case::run};

}  // namespace cairn::validation
