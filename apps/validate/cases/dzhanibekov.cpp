#include <cmath>

#include "cases.h"
#include "free_rotation.h"

namespace cairn::validation {

namespace dzhanibekov_case {
namespace {

constexpr double duration = 60;  ///< [s]

/// Period of the rotation about the middle axis, by Jacobi's elliptic functions. @source Landau, Lifshitz, Mechanics
/// §37
double exactPeriod(const Vec3& inertia, const Vec3& w) {
    const double i1 = inertia[0];
    const double i2 = inertia[1];
    const double i3 = inertia[2];
    const double twice_energy = inertia.dot(w.cwiseAbs2());
    const double momentum = inertia.cwiseProduct(w).squaredNorm();
    const double speed = std::sqrt((i3 - i2) * (momentum - twice_energy * i1) / (i1 * i2 * i3));
    const double modulus = (i2 - i1) * (twice_energy * i3 - momentum) / ((i3 - i2) * (momentum - twice_energy * i1));
    return 4 * std::comp_ellint_1(std::sqrt(modulus)) / speed;
}

struct Flips {
    double period = 0;  ///< mean [s]
    Conservation worst;
    Line middle{"ω₂", {}, {}};
};

Flips flip(double rate) {
    // A plate without thickness has the inertias (1, 2, 3) kg·m²: its axes x and y in its plane, z across.
    FreeRotation rotation(rate, Box{Vec3(std::sqrt(2.0), 1, 1e-6)}, 12, Vec3(0.1, 5, 0.1));
    Flips flips;
    double first = 0;
    double last = 0;
    int crossings = 0;
    double before = rotation.bodyRate().y();
    while (rotation.time() < duration - 0.5 / rate) {
        const double t = rotation.time();
        rotation.step();
        const double now = rotation.bodyRate().y();
        if (before * now < 0) {
            const double at = t + (rotation.time() - t) * before / (before - now);
            (crossings == 0 ? first : last) = at;
            ++crossings;
        }
        before = now;
        if (static_cast<double>(flips.middle.x.size()) < 600 * rotation.time() / duration) {
            flips.middle.x.push_back(rotation.time());
            flips.middle.y.push_back(now);
        }
    }
    flips.period = 2 * (last - first) / (crossings - 1);
    flips.worst = rotation.worst();
    return flips;
}

Result run(const Plan& plan) {
    Result result;
    const double period = exactPeriod(Vec3(1, 2, 3), Vec3(0.1, 5, 0.1));
    result.absolute("period by the elliptic integral, against the published one", "s", 6.8591, period, 5e-4);
    Line middle;
    measureOver(result, plan.rates(),
                {{"period", "s", Rule::relative, period, 1e-3, 240},
                 {"angular momentum, largest relative error", "", Rule::at_most, 0, 1e-12, 240},
                 {"energy, largest relative error", "", Rule::at_most, 0, 1e-9, 240}},
                [&](double rate) {
                    Flips flips = flip(rate);
                    middle = std::move(flips.middle);
                    return std::vector{flips.period, flips.worst.momentum, flips.worst.energy};
                });
    result.figures.push_back({"It flips over and back", "time [s]", "ω₂ [rad/s]", {middle}});
    return result;
}

}  // namespace
}  // namespace dzhanibekov_case

const Case dzhanibekov{"dzhanibekov",
                       "Free flight",
                       "A plate that spins about its middle axis flips (Dzhanibekov)",
                       "T = 4K(k)/p, Landau and Lifshitz, Mechanics, §37",
                       "Inertias (1, 2, 3) kg·m², ω₀ = (0.1, 5, 0.1) rad/s, 60 s. The period is twice the mean time "
                       "between sign changes of ω₂.",
                       dzhanibekov_case::run};

}  // namespace cairn::validation
