#include <fmt/format.h>

#include "cases.h"
#include "stack_tools.h"

namespace cairn::validation {

namespace towers_case {
namespace {

constexpr double edge = 0.1;  ///< [m]
constexpr double mass = 1;    ///< [kg]

Standing stand(const Settings& settings, int boxes, double duration, double patience, const Plan& plan) {
    World world = makeWorld(settings, Vec3(0, 0, -g), contactLaw(0.25, 0.5));
    const BodyId ground = addPlane(world);
    std::vector<BodyId> bodies;
    bodies.reserve(static_cast<std::size_t>(boxes));
    for (int i = 0; i < boxes; ++i) {
        bodies.push_back(world.addBody(body(Box{Vec3::Constant(edge)}, mass, Vec3(0, 0, edge * (i + 0.5)))));
    }
    return watch(world, bodies, ground, boxes * mass * g, edge, duration, patience, plan);
}

Result run(const Plan& plan) {
    Result result;
    const double duration = plan.isQuick() ? 2 : 60;
    for (const int boxes : {10, 20, 40}) {
        const auto build = [&](const Settings& settings, double patience) {
            return stand(settings, boxes, duration, patience, plan);
        };
        judgeAllResolvers(result, fmt::format("{} boxes", boxes), duration, plan, build, stackRates(plan));
    }
    return result;
}

}  // namespace
}  // namespace towers_case

const Case towers{"towers",
                  "Stacks",
                  "Towers of boxes stand",
                  "drift 0; impulse of the ground n·m·g·Δt",
                  "10, 20 and 40 cubes of 10 cm and 1 kg, µ = 0.5, e = 0.25, 60 s, sleeping off. Judged with "
                  "accelerated_sweeps; the other resolutions are shown, for 20 s of wall time each.",
                  towers_case::run};

}  // namespace cairn::validation
