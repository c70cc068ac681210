#include <fmt/format.h>

#include <cmath>

#include "cases.h"
#include "granular_tools.h"

namespace cairn::validation {

namespace hopper_case {
namespace {

/// A shaft with a square hole in its floor.
struct Discharge {
    double early = 0;  ///< grains per second while the silo is full
    double late = 0;   ///< and while it is less than half full
    double rate() const { return (early + late) / 2; }
};

Discharge discharge(double hole, int count, std::uint64_t seed, const Plan& plan) {
    Grains grains(granularSettings(), grainLaw(0.3), grainLaw(0.3), seed);
    const double width = 12 * grain;
    const double half = hole / 2;
    const double edge = width;
    grains.addShaft(width);
    grains.addBlock(Vec3(-edge, half, -0.05), Vec3(edge, edge, 0));
    grains.addBlock(Vec3(-edge, -edge, -0.05), Vec3(edge, -half, 0));
    grains.addBlock(Vec3(half, -half, -0.05), Vec3(edge, half, 0));
    grains.addBlock(Vec3(-edge, -half, -0.05), Vec3(-half, half, 0));
    const BodyId lid = grains.addBlock(Vec3(-half, -half, -0.1), Vec3(half, half, -0.051));
    grains.rain(Sphere{grain / 2}, count, width, 0.1, 1.2 * grain);
    grains.settle(2.5, plan);
    grains.world.removeBody(lid);
    std::vector<double> left;  // times
    std::vector<std::uint8_t> gone(grains.ids.size(), 0);
    const double begin = grains.world.time();
    // A half of what is inside stays around the hole; the flow is steady before that.
    const auto wanted = static_cast<std::size_t>(0.6 * count);
    while (left.size() < wanted && grains.world.time() - begin < 60) {
        plan.alive();
        grains.world.step();
        for (std::size_t i = 0; i < grains.ids.size(); ++i) {
            if (gone[i] != 0 || grains.world.pose(grains.ids[i]).position.z() > -2 * grain) continue;
            gone[i] = 1;
            left.push_back(grains.world.time() - begin);
            grains.world.removeBody(grains.ids[i]);
            grains.ids[i] = grains.ids.back();
            gone[i] = gone.back();
            grains.ids.pop_back();
            gone.pop_back();
            --i;
        }
    }
    Discharge result;
    if (left.size() < wanted) return result;
    const auto flow = [&](double from, double to) {
        const auto a = static_cast<std::size_t>(from * count);
        const auto b = static_cast<std::size_t>(to * count);
        return static_cast<double>(b - a) / (left[b - 1] - left[a - 1]);
    };
    result.early = flow(0.1, 0.35);
    result.late = flow(0.35, 0.59);
    return result;
}

Result run(const Plan& plan) {
    Result result;
    const int count = plan.isQuick() ? 400 : 1200;
    Line measured{"measured", {}, {}};
    double head = 0;
    for (const double diameters : {4.0, 5.0, 6.0, 7.0}) {
        Fillings rate;
        Fillings ratio;
        for (const std::uint64_t seed : seedsOfFillings(plan)) {
            const Discharge flow = discharge(diameters * grain, count, seed, plan);
            rate.add(flow.rate());
            ratio.add(flow.early / flow.late);
        }
        const std::string setup = fmt::format("hole of {:g} diameters", diameters);
        measured.x.push_back(diameters);
        measured.y.push_back(std::pow(rate.mean(), 0.4));
        result.show("grains per second", "1/s", rate.mean(), setup, rate.text());
        result.show("flow early over late in the discharge", "", ratio.mean(), setup, ratio.text());
        head = std::max(head, std::abs(ratio.mean() - 1));
    }
    const auto n = static_cast<double>(measured.x.size());
    double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    for (std::size_t i = 0; i < measured.x.size(); ++i) {
        const double x = measured.x[i], y = measured.y[i];
        sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y;
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    const double zero = (sx - sy / slope) / n;
    const double correlation = (n * sxy - sx * sy) / std::sqrt((n * sxx - sx * sx) * (n * syy - sy * sy));
    result.atLeast("correlation of (grains per second)^(2/5) with the width of the hole", "", correlation, 0.99);
    result.atLeast("k, where the flow would stop, in diameters", "", zero, 0, "",
                   "the hole is square; published for spheres and round holes: 1.3 to 2.9");
    result.atMost("flow early over late in the discharge, less 1, worst", "", head, 0.2, "",
                  "it does not depend on the head");
    Line fit{"(D − kd)^(5/2)", {zero, measured.x.back()}, {0, slope * (measured.x.back() - zero)}, true};
    result.figures.push_back(
        {"Beverloo's law", "width of the hole / diameter", "(grains per second)^(2/5)", {measured, fit}});
    return result;
}

}  // namespace
}  // namespace hopper_case

const Case hopper{"hopper",
                  "Granular",
                  "Grains leave a silo at a constant rate",
                  "Beverloo 1961: rate ∝ (D − kd)^(5/2), whatever the head",
                  "1200 spheres of 10 cm in a shaft of 12 × 12 diameters with a square hole of 4 to 7 diameters, µ = "
                  "0.3; the mean of five fillings each.",
                  hopper_case::run};

}  // namespace cairn::validation
