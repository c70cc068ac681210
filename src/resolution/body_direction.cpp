#include "resolution/body_direction.h"

#include "math/arrays.h"
#include "resolution/pgs_batch.h"

namespace cairn {

void BodyDirection::save(const LocalBatch& batch, const Executor& executor) {
    resizeTightly(before_, batch.dynamic_bodies);
    resizeTightly(direction_, batch.dynamic_bodies);
    forEach(before_.size(), executor, [&](std::size_t i) { before_[i] = {batch.bodies[i].v, batch.bodies[i].w}; });
}

void BodyDirection::restart() {
    for (Twist& direction : direction_) direction = {Vec3::Zero(), Vec3::Zero()};
}

void BodyDirection::accelerate(double beta, LocalBatch& batch, const Executor& executor) {
    forEach(before_.size(), executor, [&](std::size_t i) {
        LocalBody& body = batch.bodies[i];
        const Twist change{body.v - before_[i].v, body.w - before_[i].w};
        const Twist step{beta * direction_[i].v, beta * direction_[i].w};
        body.v += step.v;
        body.w += step.w;
        direction_[i] = {change.v + step.v, change.w + step.w};
    });
}

}  // namespace cairn
