#include <fmt/format.h>

#include <cmath>

#include "cases.h"
#include "granular_tools.h"

namespace cairn::validation {

namespace silo_case {
namespace {

constexpr double friction = 0.5;

/// Load of the floor and weight of the grains [N].
struct Load {
    double floor = 0;
    double weight = 0;
};

/// Fills a narrow silo and lowers its floor a little, so that all grains slide down along the walls.
Load fill(int count, double width, std::uint64_t seed, const Plan& plan) {
    Grains grains(granularSettings(), grainLaw(friction), grainLaw(friction), seed);
    grains.addShaft(width);
    const BodyId floor = grains.addBlock(Vec3(-width, -width, -1), Vec3(width, width, 0));
    grains.rain(Sphere{grain / 2}, count, width, 0.1, 1.3 * grain);
    grains.settle(4, plan);
    Load load;
    load.weight = static_cast<double>(count) * grain_mass * g;
    const double rate = grains.world.settings().steps_per_second;
    const double speed = 0.2 * grain;  // [m/s]
    const int lowering = static_cast<int>(0.5 * rate);
    const int resting = static_cast<int>(0.5 * rate);
    const int measured = resting - resting / 2;
    Pose pose = grains.world.pose(floor);
    for (int i = 0; i < lowering + resting; ++i) {
        plan.alive();
        if (i < lowering) {
            pose.position.z() -= speed / rate;
            grains.world.setPose(floor, pose);
        }
        grains.world.step();
        if (i >= lowering + resting - measured) load.floor += grains.liftedBy(floor) / measured;
    }
    return load;
}

Result run(const Plan& plan) {
    Result result;
    const double width = 4 * grain;
    std::vector<int> counts = {50, 100, 200, 300, 400, 500};
    if (plan.isQuick()) counts = {50, 150};
    Line measured{"measured", {}, {}};
    for (const int count : counts) {
        Fillings floor;
        double weight = 0;
        for (const std::uint64_t seed : seedsOfFillings(plan)) {
            const Load load = fill(count, width, seed, plan);
            floor.add(load.floor);
            weight = load.weight;
        }
        measured.x.push_back(weight);
        measured.y.push_back(floor.mean());
        result.show("load of the floor", "N", floor.mean(), fmt::format("{} grains, {:.0f} N", count, weight),
                    floor.text());
    }
    // The saturation that fits best: M(W) = S(1 − exp(−W/S)).
    const auto janssen = [](double weight, double saturation) {
        return saturation * (1 - std::exp(-weight / saturation));
    };
    double best = 0;
    double least = INFINITY;
    for (double s = 50; s < 5000; s *= 1.005) {
        double squares = 0;
        for (std::size_t i = 0; i < measured.x.size(); ++i) {
            squares += std::pow(measured.y[i] - janssen(measured.x[i], s), 2);
        }
        if (squares < least) {
            least = squares;
            best = s;
        }
    }
    const double deviation = std::sqrt(least / static_cast<double>(measured.x.size())) / best;
    const std::size_t last = measured.x.size() - 1;
    result.show("saturation of the load, fitted", "N", best);
    result.atMost("deviation from Janssen's law, rms over the saturation", "", deviation, 0.15);
    result.atMost("load of the floor under the highest filling over its weight", "",
                  measured.y[last] / measured.x[last], plan.isQuick() ? 0.9 : 0.5);
    if (!plan.isQuick()) {
        result.atMost("load under 500 grains over that under 300", "", measured.y[last] / measured.y[last - 2], 1.2, "",
                      "without walls it would be 1.67");
    }
    Line expected{"Janssen, fitted", {}, {}, true};
    for (double w = 0; w <= measured.x.back(); w += measured.x.back() / 50) {
        expected.x.push_back(w);
        expected.y.push_back(janssen(w, best));
    }
    result.figures.push_back({"Load of the floor", "weight of the grains [N]", "load [N]", {measured, expected}});
    return result;
}

}  // namespace
}  // namespace silo_case

const Case silo{
    "silo",
    "Granular",
    "The walls of a silo carry what is filled in above",
    "Janssen: load = S(1 − exp(−weight/S))",
    "Spheres of 10 cm in a shaft of 4 × 4 diameters, µ = 0.5; the floor is lowered by a tenth of a diameter "
    "before its load is measured: the mean of five fillings.",
    silo_case::run};

}  // namespace cairn::validation
