#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace arch_case {
namespace {

constexpr double radius = 1;   ///< of the middle line [m]
constexpr double depth = 0.5;  ///< [m]

/// A voussoir between two angles from the right springing.
ConvexHull voussoir(double begin, double end, double thickness) {
    std::vector<Vec3> points;
    for (const double angle : {begin, end}) {
        for (const double r : {radius - thickness / 2, radius + thickness / 2}) {
            for (const double y : {-depth / 2, depth / 2}) {
                points.emplace_back(r * std::cos(angle), y, r * std::sin(angle));
            }
        }
    }
    return ConvexHull(points);
}

/// How far the highest voussoir sank [m].
double sinking(int voussoirs, double ratio, double rate, double duration, const Plan& plan) {
    World world = makeWorld(accurateSettings(rate), Vec3(0, 0, -g), contactLaw(0, 0.8));
    addPlane(world);
    std::vector<BodyId> stones;
    for (int i = 0; i < voussoirs; ++i) {
        const double step = std::numbers::pi / voussoirs;
        BodyDescription stone;
        stone.shape = voussoir(i * step, (i + 1) * step, ratio * radius);
        stones.push_back(world.addBody(stone));
    }
    const BodyId crown = stones[stones.size() / 2];
    const double begin = world.centreOfMass(crown).z();
    double sunk = 0;
    while (world.time() < duration && sunk < 0.2 * radius) {
        plan.alive();
        world.step();
        sunk = begin - world.centreOfMass(crown).z();
    }
    return sunk;
}

Result run(const Plan& plan) {
    Result result;
    const double duration = plan.isQuick() ? 2 : 10;
    for (const int voussoirs : {15, 31}) {
        for (const double rate : plan.rates()) {
            const std::string setup = fmt::format("{} voussoirs, {}, {} s", voussoirs, timeStepText(rate), duration);
            result.atMost("sinking of the crown at t/R = 0.115", "m", sinking(voussoirs, 0.115, rate, duration, plan),
                          0.01, setup, "it stands");
            result.atLeast("sinking of the crown at t/R = 0.100", "m", sinking(voussoirs, 0.100, rate, duration, plan),
                           0.1, setup, "it collapses");
        }
    }
    return result;
}

}  // namespace
}  // namespace arch_case

const Case arch{"arch",
                "Statics",
                "A semicircular arch stands or collapses by its thickness",
                "least thickness 0.1075 R of a semicircular arch of wedges without sliding (Milankovitch 1907)",
                "Wedges as convex hulls, mean radius 1 m, depth 0.5 m, µ = 0.8, on a plane; they begin unloaded.",
                arch_case::run};

}  // namespace cairn::validation
