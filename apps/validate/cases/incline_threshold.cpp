#include <cmath>

#include "cases.h"
#include "incline_box.h"

namespace cairn::validation {

namespace incline_threshold_case {
namespace {

constexpr double friction = 0.5;
constexpr double watched = 1;     ///< [s]
constexpr double slipped = 1e-4;  ///< [m]; 0.005° above the threshold it slides 0.5 mm in that time

/// The angle at which the box begins to slide [°].
double angleOfSlip(double rate, ResolutionKind resolver, const Plan& plan) {
    const Settings settings = accurateSettings(rate, resolver);
    const double expected = std::atan(friction) / degree;
    return threshold(expected - 0.5, expected + 0.5, 0.002, [&](double angle) {
        plan.alive();
        InclineBox setup(settings, angle * degree, 0.3, contactLaw(0, friction));
        runUntil(setup.world, watched);
        return setup.displacement().norm() < slipped;
    });
}

Result run(const Plan& plan) {
    Result result;
    const double expected = std::atan(friction) / degree;
    const auto measure = [&](ResolutionKind resolver, const std::string& name) {
        measureOver(result, plan.rates(), {{"angle of slip, " + name, "°", Rule::absolute, expected, 0.01, 240}},
                    [&](double rate) { return std::vector{angleOfSlip(rate, resolver, plan)}; });
    };
    measure(ResolutionKind::impulse_queue, "impulse_queue");
    // The preset's resolution is asked; that of the thesis is there to compare with.
    result.onlyShowFrom(0);
    measure(ResolutionKind::accelerated_sweeps, "accelerated_sweeps");
    return result;
}

}  // namespace
}  // namespace incline_threshold_case

const Case incline_threshold{"incline-threshold",
                             "Incline",
                             "A box sticks exactly up to the angle of friction",
                             "tan θ = µ",
                             "µ = 0.5, box 0.4 × 0.4 × 0.1 m, heading 0.3 rad; it slips if it moved 0.1 mm in 1 s; "
                             "bisection to 0.002°.",
                             incline_threshold_case::run};

}  // namespace cairn::validation
