#include "world/requirements.h"

#include <fmt/core.h>

#include <cmath>

namespace cairn {

void requireWithin(const Vec3& value, double limit, std::string_view what, std::string_view unit) {
    if (value.allFinite() && value.cwiseAbs().maxCoeff() <= limit) return;
    throw InputError(fmt::format("{} is ({}, {}, {}) {}; every component must be finite and within ±{} {}", what,
                                 value.x(), value.y(), value.z(), unit, limit, unit));
}

Quat requireRotation(const Quat& q) {
    const double norm = q.coeffs().stableNorm();
    if (std::isfinite(norm) && norm > 1e-6) return q.normalized();
    throw InputError(
        fmt::format("orientation is ({}, {}, {}, {}); a quaternion (w, x, y, z) must be finite and not zero", q.w(),
                    q.x(), q.y(), q.z()));
}

BodyIndex dynamicIndex(const BodyStorage& bodies, BodyId id, std::string_view what) {
    const BodyIndex i = bodies.indexOf(id);
    if (bodies.kind[i] == BodyKind::dynamic) return i;
    throw InputError(
        fmt::format("body {} is fixed and takes no {}; make it dynamic with World::setFixed first", id.index, what));
}

}  // namespace cairn
