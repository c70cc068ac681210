#include <fmt/format.h>

#include "cases.h"
#include "stack_tools.h"

namespace cairn::validation {

namespace mass_ratios_case {
namespace {

constexpr double edge = 0.2;  ///< [m]

Standing stand(const Settings& settings, double ratio, double duration, double patience, const Plan& plan) {
    World world = makeWorld(settings, Vec3(0, 0, -g), contactLaw(0.25, 0.5));
    const BodyId ground = addPlane(world);
    const std::vector<BodyId> bodies = {world.addBody(body(Box{Vec3::Constant(edge)}, 1, Vec3(0, 0, edge / 2))),
                                        world.addBody(body(Box{Vec3::Constant(edge)}, ratio, Vec3(0, 0, 1.5 * edge)))};
    return watch(world, bodies, ground, (1 + ratio) * g, edge, duration, patience, plan);
}

Result run(const Plan& plan) {
    Result result;
    const double duration = plan.isQuick() ? 1 : 10;
    for (const double ratio : {10.0, 100.0, 1000.0, 1e4}) {
        const auto build = [&](const Settings& settings, double patience) {
            return stand(settings, ratio, duration, patience, plan);
        };
        judgeAllResolvers(result, fmt::format("ratio {:g}", ratio), duration, plan, build, stackRates(plan));
    }
    return result;
}

}  // namespace
}  // namespace mass_ratios_case

const Case mass_ratios{
    "mass-ratios",
    "Stacks",
    "A heavy box stands on a light one",
    "drift 0, overlap ≤ 0.1 mm; impulse of the ground equals the weight",
    "Cubes of 20 cm; the lower 1 kg, the upper 10, 100, 1000 and 10 000 kg; 10 s, sleeping off. Judged "
    "with accelerated_sweeps; the other resolutions are shown, for 20 s of wall time each.",
    mass_ratios_case::run};

}  // namespace cairn::validation
