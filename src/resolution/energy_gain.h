/// @file What a change of velocities adds to the kinetic energy.
#pragma once

#include <algorithm>
#include <cmath>

#include "batches/batch_motion.h"
#include "resolution/symmetric3.h"

namespace cairn {

/// Part of the energy that rounding may add.
inline constexpr double energy_rounding = 1e-12;

inline double kineticEnergyOf(const BodyState& bodies, BodyIndex i, const BodyMotion& motion) {
    const Vec3 spin = inverse(Symmetric3::from(bodies.inertiaInv_W[i])) * motion.w;
    return 0.5 * (motion.v.squaredNorm() / bodies.mass_inv[i] + motion.w.dot(spin));
}

/// What part s of a change of velocities adds to the kinetic energy: s·linear + s²·quadratic [J].
struct EnergyGain {
    double linear = 0;
    double quadratic = 0;

    /// Adds the change of a dynamic body.
    void add(const BodyState& bodies, BodyIndex i, const BodyMotion& from, const BodyMotion& to) {
        const Vec3 dv = to.v - from.v;
        const Vec3 dw = to.w - from.w;
        const double mass = 1 / bodies.mass_inv[i];
        const Vec3 turned = inverse(Symmetric3::from(bodies.inertiaInv_W[i])) * dw;
        linear += mass * from.v.dot(dv) + from.w.dot(turned);
        quadratic += 0.5 * (mass * dv.squaredNorm() + dw.dot(turned));
    }
    double whole() const { return linear + quadratic; }
    /// The largest part that adds no more than is allowed. @param allowed [J], 0 to below whole()
    double largestPart(double allowed) const {
        const double root = std::sqrt(linear * linear + 4 * quadratic * allowed);
        return linear > 0 ? 2 * allowed / (linear + root) : (root - linear) / (2 * quadratic);
    }
};

}  // namespace cairn
