#include <fmt/format.h>

#include "cases.h"
#include "stack_tools.h"

namespace cairn::validation {

namespace overhang_case {
namespace {

const Vec3 block(0.2, 0.1, 0.03);  ///< [m]

/// Whether n blocks stand whose overhangs are the given part of the largest possible ones.
bool stands(int n, double part, double rate, double duration, const Plan& plan) {
    World world = makeWorld(accurateSettings(rate), Vec3(0, 0, -g), contactLaw(0, 0.5));
    BodyDescription table = body(Box{Vec3(1, 1, 0.1)}, 1, Vec3(-0.5, 0, -0.05));
    table.fixed = true;
    world.addBody(table);
    std::vector<BodyId> blocks;
    double reach = 0;  // of the end of the last block beyond the table
    for (int i = 0; i < n; ++i) {
        reach += part * block.x() / (2 * (n - i));
        blocks.push_back(world.addBody(body(Box{block}, 1, Vec3(reach - block.x() / 2, 0, block.z() * (i + 0.5)))));
    }
    const Vec3 top = world.pose(blocks.back()).position;
    while (world.time() < duration) {
        plan.alive();
        world.step();
        if ((world.pose(blocks.back()).position - top).norm() > block.z()) return false;
    }
    return true;
}

Result run(const Plan& plan) {
    Result result;
    const double duration = plan.isQuick() ? 2 : 5;
    for (int n = 2; n <= 5; ++n) {
        double lengths = 0;
        for (int i = 1; i <= n; ++i) lengths += 0.5 / i;
        for (const double rate : plan.rates()) {
            const std::string setup =
                fmt::format("n = {}, largest overhang {:.3f} lengths, {}", n, lengths, timeStepText(rate));
            result.atLeast("stands at 0.99 times the overhang (1 = yes)", "", stands(n, 0.99, rate, duration, plan), 1,
                           setup);
            result.atMost("stands at 1.01 times the overhang (1 = yes)", "", stands(n, 1.01, rate, duration, plan), 0,
                          setup);
        }
    }
    return result;
}

}  // namespace
}  // namespace overhang_case

const Case overhang{"overhang",
                    "Statics",
                    "Blocks overhang a table's edge by the harmonic series",
                    "½ Σ 1/i lengths: 0.75, 0.917, 1.042, 1.142 for n = 2 to 5",
                    "Blocks of 20 × 10 × 3 cm, µ = 0.5, 5 s.",
                    overhang_case::run};

}  // namespace cairn::validation
