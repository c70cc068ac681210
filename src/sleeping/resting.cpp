#include "sleeping/resting.h"

#include "sleeping/sleeping.h"

namespace cairn {

namespace {

template <class Work>
void forDynamic(const BodyStorage& bodies, const Executor& executor, const Work& work) {
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            if (bodies.kind[i] == BodyKind::dynamic && bodies.asleep[i] == 0) work(i);
        }
    });
}

bool isSlow(const BodyStorage& bodies, BodyIndex i, double rest_speed) {
    return squaredMotion(bodies.v[i], bodies.w[i], bodies.r_max[i]) < rest_speed * rest_speed;
}

}  // namespace

void noteSlow(const BodyStorage& bodies, double rest_speed, const Executor& executor, std::vector<std::uint8_t>& slow) {
    slow.assign(bodies.slots(), 0);
    forDynamic(bodies, executor, [&](BodyIndex i) {
        const bool pushed = !bodies.constant_force[i].isZero(0) || !bodies.constant_torque[i].isZero(0);
        slow[i] = !pushed && isSlow(bodies, i, rest_speed) ? 1 : 0;
    });
}

void letRest(BodyStorage& bodies, double rest_speed, std::span<const std::uint8_t> slow, const Executor& executor) {
    forDynamic(bodies, executor, [&](BodyIndex i) {
        const bool rests = slow[i] != 0 && bodies.supports[i] > 0 && isSlow(bodies, i, rest_speed);
        bodies.resting[i] = rests ? 1 : 0;
        if (!rests) return;
        bodies.v[i].setZero();
        bodies.w[i].setZero();
    });
}

}  // namespace cairn
