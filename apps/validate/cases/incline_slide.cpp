#include <algorithm>
#include <cmath>

#include "cases.h"
#include "incline_box.h"

namespace cairn::validation {

namespace incline_slide_case {
namespace {

constexpr double angle = 30 * degree;
constexpr double friction = 0.2;
constexpr double watched = 1;  ///< [s]
constexpr int headings = 16;

struct Slide {
    double acceleration = 0;  ///< [m/s²]
    double distance = 0;      ///< [m]
    double sideways = 0;      ///< [m]
};

Slide slide(double rate, double heading) {
    InclineBox setup(accurateSettings(rate), angle, heading, contactLaw(0, friction));
    runUntil(setup.world, watched);
    const Vec3 along = setup.incline.downhill;
    const Vec3 across = setup.incline.normal.cross(along);
    const double speed = setup.world.linearVelocity(setup.box).dot(along);
    return {speed / setup.world.time(), setup.displacement().dot(along), std::abs(setup.displacement().dot(across))};
}

Result run(const Plan& plan) {
    Result result;
    const double expected = g * (std::sin(angle) - friction * std::cos(angle));
    measureOver(result, plan.rates(),
                {{"acceleration, heading 0", "m/s²", Rule::relative, expected, 1e-4, 240},
                 {"distance after 1 s, heading 0", "m", Rule::relative, expected / 2, 1e-4, 960}},
                [](double rate) {
                    const Slide s = slide(rate, 0);
                    return std::vector{s.acceleration, s.distance};
                });
    Line line{"a / expected − 1", {}, {}};
    double least = 1e300;
    double most = 0;
    double sideways = 0;
    for (int i = 0; i < headings; ++i) {
        plan.alive();
        const double heading = 2 * std::numbers::pi * i / headings;
        const Slide s = slide(960, heading);
        least = std::min(least, s.acceleration);
        most = std::max(most, s.acceleration);
        sideways = std::max(sideways, s.sideways);
        line.x.push_back(heading / degree);
        line.y.push_back(s.acceleration / expected - 1);
    }
    result.atMost("spread of the acceleration over 16 headings", "", (most - least) / expected, 1e-6,
                  timeStepText(960));
    result.atMost("sideways motion in 1 s, worst heading", "m", sideways, 1e-6, timeStepText(960));
    result.figures.push_back({"Friction has no preferred direction", "heading [°]", "a / expected − 1", {line}});
    return result;
}

}  // namespace
}  // namespace incline_slide_case

const Case incline_slide{"incline-slide",
                         "Incline",
                         "A box slides down with the same acceleration in every direction",
                         "a = g (sin θ − µ cos θ)",
                         "θ = 30°, µ = 0.2, from rest, 1 s; 16 compass headings.",
                         incline_slide_case::run};

}  // namespace cairn::validation
