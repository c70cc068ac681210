#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cases.h"
#include "granular_tools.h"
#include "incline_box.h"

namespace cairn::validation {

namespace {

/// Angle of the flank of a heap that grains poured at one place make [°]: that of a cone with the heap's mean height
/// and mean distance from its axis. Of a cone of height h and radius r, the mean height of the volume is h/4 and the
/// mean distance r/2.
double heap(double friction, double rolling, const Plan& plan) {
    Grains grains(granularSettings(), grainLaw(friction, rolling), grainLaw(friction, rolling));
    grains.addWall(Vec3::UnitZ(), 0);
    const int count = plan.isQuick() ? 120 : 400;
    // A narrow column, layer by layer: what falls lands on the top of the heap.
    grains.rain(Sphere{grain / 2}, count, 3.2 * grain, 0.05, 1.05 * grain);
    grains.settle(plan.isQuick() ? 3 : 6, plan);
    Vec3 centre = Vec3::Zero();
    for (const BodyId id : grains.ids) centre += grains.world.pose(id).position / static_cast<double>(count);
    double height = 0;
    double distance = 0;
    double members = 0;
    for (const BodyId id : grains.ids) {
        const Vec3 p = grains.world.pose(id).position;
        const double from_axis = std::hypot(p.x() - centre.x(), p.y() - centre.y());
        // What rolled away alone is no part of the heap.
        if (from_axis > 12 * grain) continue;
        height += p.z() - grain / 2;
        distance += from_axis;
        ++members;
    }
    return std::atan(4 * height / members / (2 * distance / members)) / degree;
}

Result run(const Plan& plan) {
    Result result;
    constexpr std::array<double, 3> frictions = {0.1, 0.4, 0.8};
    constexpr std::array<double, 3> rollings = {0, 0.05, 0.2};
    std::array<std::array<double, 3>, 3> angle{};
    for (std::size_t r = 0; r < rollings.size(); ++r) {
        Line line{fmt::format("µr = {:g} r", rollings[r]), {}, {}};
        for (std::size_t f = 0; f < frictions.size(); ++f) {
            angle[r][f] = heap(frictions[f], rollings[r] * grain / 2, plan);
            result.show("angle of repose", "°", angle[r][f],
                        fmt::format("µ = {:g}, rolling friction {:g} radii", frictions[f], rollings[r]));
            line.x.push_back(frictions[f]);
            line.y.push_back(angle[r][f]);
        }
        if (result.figures.empty()) result.figures.push_back({"Angle of repose", "µ", "angle [°]", {}});
        result.figures.front().lines.push_back(std::move(line));
    }
    result.atLeast("rise from µ = 0.1 to 0.8, rolling friction 0.2 radii", "°", angle[2][2] - angle[2][0], 3);
    result.atLeast("rise from no rolling friction to 0.2 radii, µ = 0.8", "°", angle[2][2] - angle[0][2], 3);
    result.atMost("angle at µ = 0.8 and 0.2 radii", "°", angle[2][2], 45);
    return result;
}

}  // namespace

const Case repose{"repose",
                  "Granular",
                  "Heaps are the steeper the more their grains resist sliding and rolling",
                  "the angle rises with µ and with rolling friction",
                  "A column of 400 spheres of 10 cm collapses onto a plane of the same roughness; the angle is that of "
                  "the cone with the same mean height and mean distance from the axis.",
                  run};

}  // namespace cairn::validation
