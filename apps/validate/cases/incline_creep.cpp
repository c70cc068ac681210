#include "cases.h"
#include "incline_box.h"

namespace cairn::validation {

namespace incline_creep_case {
namespace {

constexpr double angle = 20 * degree;
constexpr double friction = 0.5;

Result run(const Plan& plan) {
    Result result;
    const double duration = plan.isQuick() ? 5 : 60;
    const auto measure = [&](ResolutionKind resolver, const std::string& name) {
        measureOver(result, {240, 960}, {{"creep in 60 s, " + name, "m", Rule::at_most, 0, 1e-6 * duration / 60, 960}},
                    [&](double rate) {
                        const Settings settings = accurateSettings(rate, resolver);
                        InclineBox setup(settings, angle, 0.3, contactLaw(0, friction));
                        while (setup.world.time() < duration) {
                            plan.alive();
                            runUntil(setup.world, setup.world.time() + 1);
                        }
                        return std::vector{setup.displacement().norm()};
                    });
    };
    measure(ResolutionKind::impulse_queue, "impulse_queue");
    // The preset's resolution is asked; that of the thesis is there to compare with.
    result.onlyShowFrom(0);
    measure(ResolutionKind::accelerated_sweeps, "accelerated_sweeps");
    return result;
}

}  // namespace
}  // namespace incline_creep_case

const Case incline_creep{"incline-creep",
                         "Incline",
                         "A sticking box does not creep",
                         "displacement 0",
                         "θ = 20°, µ = 0.5, sleeping off, 60 s.",
                         incline_creep_case::run};

}  // namespace cairn::validation
