#include "world/limits.h"

#include <fmt/core.h>

#include <cmath>

#include "cairn/types.h"

namespace cairn {

void requireRoom(std::size_t bodies) {
    if (bodies < most_bodies) return;
    throw InputError(fmt::format("a body too many: a world holds at most {}; remove bodies first", most_bodies));
}

void requireGravityFactor(double factor) {
    if (std::abs(factor) <= gravity_factor_limit) return;
    throw InputError(fmt::format("gravity_factor is {}; it must be within ±{}", factor, gravity_factor_limit));
}

void requireDamping(double rate, std::string_view what) {
    if (rate >= 0 && rate <= damping_limit) return;
    throw InputError(fmt::format("{}_damping is {} 1/s; it must be within 0 and {} 1/s", what, rate, damping_limit));
}

}  // namespace cairn
