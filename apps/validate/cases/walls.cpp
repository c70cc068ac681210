#include <fmt/format.h>

#include "cases.h"
#include "stack_tools.h"

namespace cairn::validation {

namespace walls_case {
namespace {

const Vec3 brick(0.2, 0.1, 0.1);  ///< [m]
constexpr double mass = 1;        ///< [kg]

/// A triangular wall: each row has one brick less than the one below.
Standing stand(const Settings& settings, int rows, double duration, double patience, const Plan& plan) {
    World world = makeWorld(settings, Vec3(0, 0, -g), contactLaw(0.25, 0.5));
    const BodyId ground = addPlane(world);
    std::vector<BodyId> bodies;
    for (int row = 0; row < rows; ++row) {
        for (int i = 0; i < rows - row; ++i) {
            const double x = (i - 0.5 * (rows - row - 1)) * (brick.x() + 0.005);
            bodies.push_back(world.addBody(body(Box{brick}, mass, Vec3(x, 0, brick.z() * (row + 0.5)))));
        }
    }
    const double weight = static_cast<double>(bodies.size()) * mass * g;
    return watch(world, bodies, ground, weight, brick.z(), duration, patience, plan);
}

Result run(const Plan& plan) {
    Result result;
    const double duration = plan.isQuick() ? 1 : 60;
    for (const int rows : {10, 30}) {
        judgeAllResolvers(
            result, fmt::format("{} bricks", rows * (rows + 1) / 2), duration, plan,
            [&](const Settings& settings, double patience) { return stand(settings, rows, duration, patience, plan); });
    }
    return result;
}

}  // namespace
}  // namespace walls_case

const Case walls{"walls",
                 "Stacks",
                 "Walls of bricks stand",
                 "drift 0; impulse of the ground n·m·g·Δt",
                 "Triangular walls of 55 and 465 bricks of 20 × 10 × 10 cm and 1 kg, µ = 0.5, e = 0.25, 60 s, sleeping "
                 "off. Judged with accelerated_sweeps; the other resolutions are shown, for 20 s of wall time each.",
                 walls_case::run};

}  // namespace cairn::validation
