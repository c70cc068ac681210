#include "integration/damping.h"

#include <cmath>

namespace cairn {

void dampVelocities(BodyStorage& bodies, double time_step, const Executor& executor) {
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const double linear = bodies.linear_damping[i];
            const double angular = bodies.angular_damping[i];
            if (linear == 0 && angular == 0) continue;
            if (bodies.kind[i] != BodyKind::dynamic || bodies.asleep[i] != 0) continue;
            bodies.v[i] *= std::exp(-linear * time_step);
            bodies.w[i] *= std::exp(-angular * time_step);
        }
    });
}

}  // namespace cairn
