#include "scene/scene_writing.h"

#include <fmt/format.h>

#include <cmath>

namespace cairn::written {

std::string number(double value) {
    if (!std::isfinite(value)) {
        throw InputError(fmt::format("a scene with the number {} cannot be written; numbers must be finite", value));
    }
    // Without the point JSON readers take minus zero for the whole number 0.
    if (value == 0 && std::signbit(value)) return "-0.0";
    return fmt::format("{}", value);
}

bool same(double a, double b) {
    return a == b && std::signbit(a) == std::signbit(b);
}

bool isOmitted(const Vec3& v) {
    return same(v.x(), 0) && same(v.y(), 0) && same(v.z(), 0);
}

std::string vector(const Vec3& v) {
    return fmt::format("[{},{},{}]", number(v.x()), number(v.y()), number(v.z()));
}

std::string orientationText(const Quat& q) {
    if (same(q.w(), 1) && isOmitted(q.vec())) return "";
    return fmt::format(R"(,"orientation":[{},{},{},{}])", number(q.w()), number(q.x()), number(q.y()), number(q.z()));
}

std::string inertiaText(const Mat3& inertia) {
    std::string out = fmt::format("[{},{},{}", number(inertia(0, 0)), number(inertia(1, 1)), number(inertia(2, 2)));
    const Vec3 products(inertia(0, 1), inertia(0, 2), inertia(1, 2));
    if (!products.isZero(0)) {
        out += fmt::format(",{},{},{}", number(products.x()), number(products.y()), number(products.z()));
    }
    return out + "]";
}

}  // namespace cairn::written
