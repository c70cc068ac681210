#include <cmath>

#include "cases.h"
#include "free_rotation.h"

namespace cairn::validation {

namespace symmetric_top_case {
namespace {

constexpr double duration = 100;  ///< [s]

Quat turn(const Vec3& axis, double angle) {
    return Quat(Eigen::AngleAxisd(angle, axis.normalized()));
}

/// Angle between the simulated and the exact orientation after `duration`. [rad]
double deviation(double rate) {
    const Vec3 w(1, 0, 6);
    FreeRotation rotation(rate, Box{Vec3(0.6, 0.6, 0.2)}, 10, w);
    const Vec3 inertia = rotation.inertia();
    while (rotation.time() < duration - 0.5 / rate) rotation.step();
    const Vec3 momentum = inertia.cwiseProduct(w);  // the body begins unturned
    const double t = rotation.time();
    const double spin = w.z() * (1 - inertia.z() / inertia.x());
    const Quat exact = turn(momentum, momentum.norm() / inertia.x() * t) * turn(Vec3::UnitZ(), spin * t);
    return exact.angularDistance(rotation.orientation());
}

Result run(const Plan& plan) {
    Result result;
    measureOver(result, plan.rates(), {{"error of the orientation after 100 s", "rad", Rule::at_most, 0, 1e-4, 960}},
                [](double rate) { return std::vector{deviation(rate)}; });
    return result;
}

}  // namespace
}  // namespace symmetric_top_case

const Case symmetric_top{"symmetric-top",
                         "Free flight",
                         "A symmetric top precesses about its angular momentum",
                         "R(t) = exp(L t/I₁) · exp(e₃ ω₃(1 − I₃/I₁) t)",
                         "Box 0.6 × 0.6 × 0.2 m, 10 kg, ω₀ = (1, 0, 6) rad/s, 100 s (about 180 turns).",
                         symmetric_top_case::run};

}  // namespace cairn::validation
