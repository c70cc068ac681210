#include "cases.h"
#include "incline_box.h"

namespace cairn::validation {

namespace {

constexpr double angle = 20 * degree;
constexpr double friction = 0.5;

Result run(const Plan& plan) {
    Result result;
    const double duration = plan.isQuick() ? 5 : 60;
    for (const auto& [resolver, name] : {std::pair(ResolutionKind::impulse_queue, "impulse_queue"),
                                         std::pair(ResolutionKind::accelerated_sweeps, "accelerated_sweeps")}) {
        measureOver(result, {240, 960},
                    {{std::string("creep in 60 s, ") + name, "m", Rule::at_most, 0, 1e-6 * duration / 60, 960}},
                    [&, resolver = resolver](double rate) {
                        const Settings settings = accurateSettings(rate, resolver);
                        InclineBox setup(settings, angle, 0.3, contactLaw(0, friction));
                        while (setup.world.time() < duration) {
                            plan.alive();
                            runUntil(setup.world, setup.world.time() + 1);
                        }
                        return std::vector{setup.displacement().norm()};
                    });
    }
    return result;
}

}  // namespace

const Case incline_creep{"incline-creep",
                         "Incline",
                         "A sticking box does not creep",
                         "displacement 0",
                         "θ = 20°, µ = 0.5, sleeping off, 60 s.",
                         run};

}  // namespace cairn::validation
