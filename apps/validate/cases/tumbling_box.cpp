#include "cases.h"
#include "free_rotation.h"

namespace cairn::validation {

namespace tumbling_box_case {
namespace {

constexpr double duration = 10;  ///< [s]

Conservation tumble(double rate) {
    FreeRotation rotation(rate, Box{Vec3(0.1, 0.4, 0.9)}, 10, Vec3(0.1, 5, 0.1));
    while (rotation.time() < duration - 0.5 / rate) rotation.step();
    return rotation.worst();
}

Result run(const Plan& plan) {
    Result result;
    std::vector<double> rates = plan.rates();
    rates.insert(rates.end() - 1, 1000);
    std::sort(rates.begin(), rates.end());
    measureOver(result, rates,
                {{"angular momentum, largest relative error", "", Rule::at_most, 0, 1e-12, 240},
                 {"energy, largest relative error", "", Rule::at_most, 0, 1e-9, 240}},
                [](double rate) {
                    const Conservation worst = tumble(rate);
                    return std::vector{worst.momentum, worst.energy};
                });
    result.show("angular momentum, published: ODE and Bullet", "", 1.3e-3, "Δt = 1/1000 s");
    result.show("angular momentum, published: Simbody", "", 6.7e-4, "Δt = 1/1000 s");
    result.show("angular momentum, published: DART", "", 1.9, "Δt = 1/1000 s");
    return result;
}

}  // namespace
}  // namespace tumbling_box_case

const Case tumbling_box{"tumbling-box",
                        "Free flight",
                        "A tumbling box keeps angular momentum and energy",
                        "Euler's equations; the box benchmark of Peters and Hsu for four engines, 2014",
                        "0.1 × 0.4 × 0.9 m, 10 kg, ω₀ = (0.1, 5, 0.1) rad/s, near the unstable axis, for 10 s.",
                        tumbling_box_case::run};

}  // namespace cairn::validation
