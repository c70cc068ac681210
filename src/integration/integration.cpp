#include "integration/integration.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "activity/sleeping.h"
#include "math/rotation.h"

namespace cairn {

namespace {

/// Angular velocity in W of a body with angular momentum L. @param inertiaInv_B [1/(kg·m²), B]
Vec3 angularVelocity(const Quat& R_WB, const Vec3& inertiaInv_B, const Vec3& angular_momentum) {
    return R_WB * inertiaInv_B.cwiseProduct(R_WB.conjugate() * angular_momentum);
}

/// dexp⁻¹ on the rotation group up to the order that a fourth-order method needs.
Vec3 inverseExponentialMap(const Vec3& u, const Vec3& w) {
    const Vec3 once = u.cross(w);
    return w - 0.5 * once + u.cross(once) / 12;
}

/// Below this sine of the angle between angular momentum and velocity a body spins about a principal axis: its energy
/// then depends on the angle in second order only, and correcting it would amplify rounding.
constexpr double principal_spin_sine = 1e-4;

/// Turns the body a little, within its errors, so that its energy is what it was; the angular momentum in W stays.
/// @param energy twice the kinetic energy that it must have [J]
void restoreEnergy(Quat& orientation, const Vec3& inertiaInv_B, const Vec3& angular_momentum, double energy) {
    for (int i = 0; i < 2; ++i) {
        const Vec3 momentum_B = orientation.conjugate() * angular_momentum;
        const Vec3 w_B = inertiaInv_B.cwiseProduct(momentum_B);
        // Turning the body by −φ turns momentum_B by φ and changes its energy by φ·gradient.
        const Vec3 gradient = momentum_B.cross(w_B);
        const double scale = momentum_B.squaredNorm() * w_B.squaredNorm();
        if (!(gradient.squaredNorm() > principal_spin_sine * principal_spin_sine * scale)) return;
        const double error = 0.5 * (w_B.dot(momentum_B) - energy);
        orientation = (orientation * fromRotationVector(gradient * (error / gradient.squaredNorm()))).normalized();
    }
}

bool isIsotropic(const Vec3& inertia_B) {
    return inertia_B.x() == inertia_B.y() && inertia_B.y() == inertia_B.z();
}

}  // namespace

void rotateUniformly(Quat& orientation, const Vec3& w, double time) {
    orientation = (fromRotationVector(w * time) * orientation).normalized();
}

void rotateFreely(Quat& orientation, Vec3& w, const Vec3& inertia_B, double time) {
    const Vec3 inertiaInv_B = inertia_B.cwiseInverse();
    const Vec3 momentum = orientation * inertia_B.cwiseProduct(orientation.conjugate() * w);
    const auto rate = [&](const Vec3& u) {
        const Quat turned = fromRotationVector(u) * orientation;
        return inverseExponentialMap(u, angularVelocity(turned, inertiaInv_B, momentum));
    };
    const Vec3 k1 = time * w;
    const Vec3 k2 = time * rate(k1 / 2);
    const Vec3 k3 = time * rate(k2 / 2);
    const Vec3 k4 = time * rate(k3);
    const double energy = w.dot(momentum);
    orientation = (fromRotationVector((k1 + 2 * k2 + 2 * k3 + k4) / 6) * orientation).normalized();
    restoreEnergy(orientation, inertiaInv_B, momentum, energy);
    w = angularVelocity(orientation, inertiaInv_B, momentum);
    // The next step takes the momentum from w and the orientation; what rounding changed of it is put back here, so
    // that it does not add up over many steps.
    const Vec3 lost = momentum - orientation * inertia_B.cwiseProduct(orientation.conjugate() * w);
    w += angularVelocity(orientation, inertiaInv_B, lost);
}

void advancePosition(BodyStorage& bodies, BodyIndex i, double time_step) {
    bodies.linear_step[i] = bodies.v[i] * time_step;
    bodies.position[i] += bodies.linear_step[i];
    if (bodies.w[i].isZero(0)) return;
    if (isIsotropic(bodies.inertia_B[i])) {
        rotateUniformly(bodies.orientation[i], bodies.w[i], time_step);
    } else {
        rotateFreely(bodies.orientation[i], bodies.w[i], bodies.inertia_B[i], time_step);
    }
    if (!isIsotropic(bodies.inertia_B[i])) {
        bodies.inertiaInv_W[i] = toWorldInertia(bodies.inertiaInv_B[i], bodies.orientation[i]);
    }
}

void advancePositions(BodyStorage& bodies, double time_step, const Executor& executor) {
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            if (bodies.kind[i] != BodyKind::dynamic || bodies.asleep[i] != 0) {
                bodies.linear_step[i].setZero();
            } else {
                advancePosition(bodies, i, time_step);
            }
        }
    });
}

namespace {

/// The value of the last place of a number, as ldexp() and ilogb() would tell it, several times slower. @pre
/// isnormal(x)
double lastPlace(double x) {
    constexpr int places = std::numeric_limits<double>::digits - 1;
    const auto exponent = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(std::abs(x)) >> places) - places;
    return exponent > 0 ? std::bit_cast<double>(static_cast<std::uint64_t>(exponent) << places) : 0;
}

}  // namespace

double addInSteps(double velocity, double gain, std::int64_t step) {
    constexpr std::int64_t period = 4096;
    if (gain == 0) return velocity;
    const double sum = velocity + gain;
    const double larger = std::max(std::abs(velocity), std::abs(sum));
    if (!std::isnormal(larger)) return sum;
    const double unit = lastPlace(larger);
    if (unit == 0) return sum;
    const double units = gain / unit;
    const auto given = [&](std::int64_t steps) { return std::nearbyint(static_cast<double>(steps) * units) * unit; };
    return velocity + (given(step % period + 1) - given(step % period));
}

double dampedSpeed(const SleepSettings& settings) {
    constexpr double part = 0.1;
    return settings.sleep_threshold / part;
}

double dampedPart(const SleepSettings& settings) {
    return settings.sleep_threshold > 0 ? 1 - settings.damping : 1;
}

namespace {

/// The velocity of what moves evenly differs from its mean of late by at most this part of that.
constexpr double most_uneven = 0.2;

/// Whether a body goes somewhere, and as fast as it did.
bool movesEvenly(const BodyStorage& bodies, BodyIndex i, const Vec3& v, const Vec3& w, const SleepSettings& settings) {
    const double r_max = bodies.r_max[i];
    const double mean = squaredMotion(bodies.mean_v[i], bodies.mean_w[i], r_max);
    if (!(mean > settings.sleep_threshold * settings.sleep_threshold)) return false;
    return squaredMotion(v - bodies.mean_v[i], w - bodies.mean_w[i], r_max) < most_uneven * most_uneven * mean;
}

}  // namespace

double gravityPartOf(const BodyStorage& bodies, BodyIndex i, const Vec3& v, const Vec3& w,
                     const SleepSettings& settings) {
    const double threshold = dampedSpeed(settings);
    const bool slow = squaredMotion(v, w, bodies.r_max[i]) < threshold * threshold;
    const bool damped = slow && bodies.load[i] == Load::none && !movesEvenly(bodies, i, v, w, settings);
    return damped ? dampedPart(settings) : 1;
}

Vec3 accelerationOf(const BodyStorage& bodies, BodyIndex i, const Vec3& acceleration, const SleepSettings& settings) {
    const double part = gravityPartOf(bodies, i, bodies.v[i], bodies.w[i], settings);
    const Vec3 force = bodies.force[i] + bodies.constant_force[i];
    return bodies.gravity_factor[i] * (part * acceleration) + force * bodies.mass_inv[i];
}

void advanceVelocities(BodyStorage& bodies, const Vec3& acceleration, const SleepSettings& settings, double time_step,
                       const Executor& executor, std::optional<std::int64_t> step) {
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            if (bodies.kind[i] == BodyKind::dynamic && bodies.asleep[i] == 0) {
                const Vec3 torque = bodies.torque[i] + bodies.constant_torque[i];
                const Vec3 gain = accelerationOf(bodies, static_cast<BodyIndex>(i), acceleration, settings) * time_step;
                for (int axis = 0; axis < 3; ++axis) {
                    double& v = bodies.v[i][axis];
                    v = step ? addInSteps(v, gain[axis], *step) : v + gain[axis];
                }
                bodies.w[i] += bodies.inertiaInv_W[i] * torque * time_step;
            }
        }
    });
}

void clearForces(BodyStorage& bodies, const Executor& executor) {
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            if (bodies.kind[i] == BodyKind::hole) continue;
            bodies.force[i].setZero();
            bodies.torque[i].setZero();
        }
    });
}

namespace {

/// A contact may change a smoothly moving body's velocity up to this multiple of what the forces do: in rolling and
/// sliding it is at most about twice as much.
constexpr double smooth_multiple = 3;

double speedChange(const BodyStorage& bodies, const VelocitiesBefore& before, std::size_t i) {
    return (bodies.v[i] - before.v[i]).norm() + (bodies.w[i] - before.w[i]).norm() * bodies.r_max[i];
}

}  // namespace

void beginWays(const BodyStorage& bodies, const Executor& executor, VelocitiesBefore& before) {
    before.way.resize(bodies.slots());
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            if (bodies.kind[i] == BodyKind::hole) continue;
            const bool flies = bodies.kind[i] == BodyKind::dynamic && bodies.asleep[i] == 0;
            before.way[i] = {{bodies.position[i], bodies.orientation[i]}, bodies.v[i], bodies.w[i], flies ? 1.0 : 0.0};
        }
    });
}

void flyBack(BodyStorage& bodies, BodyIndex i, double part, const Vec3& acceleration, const SleepSettings& settings,
             double time_step, BodyWay& way) {
    const Vec3 gain = time_step * accelerationOf(bodies, i, acceleration, settings);
    bodies.position[i] = way.begin.position;
    bodies.orientation[i] = way.begin.orientation;
    bodies.inertiaInv_W[i] = toWorldInertia(bodies.inertiaInv_B[i], bodies.orientation[i]);
    bodies.w[i] = way.w;
    bodies.v[i] = way.v;
    way.part = part;
    // What turns freely does not turn evenly, so that no place on the way tells how fast it turns there.
    advancePosition(bodies, i, part * time_step);
    bodies.v[i] -= (1 - part) * gain;
}

void saveVelocities(const BodyStorage& bodies, const Executor& executor, VelocitiesBefore& before) {
    before.v.resize(bodies.slots());
    before.w.resize(bodies.slots());
    before.forced.resize(bodies.slots());
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            if (bodies.kind[i] == BodyKind::hole) continue;
            before.v[i] = bodies.v[i];
            before.w[i] = bodies.w[i];
        }
    });
}

void saveForced(const BodyStorage& bodies, const Executor& executor, VelocitiesBefore& before) {
    before.forced_v.resize(bodies.slots());
    before.bounced.assign(bodies.slots(), 0);
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            if (bodies.kind[i] == BodyKind::hole) continue;
            before.forced[i] = speedChange(bodies, before, i);
            before.forced_v[i] = bodies.v[i];
        }
    });
}

namespace {

/// Height at the end of the step of what touched within it and bounces since; 0 if it would be back already.
/// @param touched speed of touching [m/s] @param closing speed at the beginning of the step [m/s]
double heightAfter(const Contact& c, double touched, double closing, double acceleration, double time_step) {
    const double depth = acceleration * time_step * time_step / 2 - c.gap;
    const double since = 2 * depth / (closing + acceleration * time_step + touched);
    if (!(since > 0)) return 0;
    const double up = c.restitution * touched;
    const double slower = acceleration * since;
    return up > slower ? (up - slower / 2) * since : 0;
}

}  // namespace

void saveTouching(const BodyStorage& bodies, double threshold, double time_step, VelocitiesBefore& before,
                  std::span<Contact> contacts) {
    before.lift.assign(bodies.slots(), Vec3::Zero());
    for (Contact& c : contacts) {
        const auto normalVelocity = [&](std::span<const Vec3> v, std::span<const Vec3> w) {
            const Vec3 of_a = v[c.a] + w[c.a].cross(c.pointOn(c.a) - bodies.position[c.a]);
            const Vec3 of_b = v[c.b] + w[c.b].cross(c.pointOn(c.b) - bodies.position[c.b]);
            return c.normal.dot(of_a - of_b);
        };
        const double closing = -normalVelocity(before.v, before.w);
        c.forced = normalVelocity(bodies.v, bodies.w) + closing;
        const double acceleration = -c.forced / time_step;
        // The bodies moved by the velocities before the forces: at the beginning of the step they were farther apart.
        c.fall = 2 * acceleration * (c.gap + closing * time_step);
        c.climb = 2 * acceleration * c.distance;
        const double touched = closing * closing + c.fall;
        const bool bounces =
            closing > 0 && touched >= threshold * threshold && c.restitution * c.restitution * touched > c.climb;
        // What lands without bouncing is stopped, not carried on by the mean of its velocities.
        if (!bounces && !(closing > threshold)) continue;
        before.forced[c.a] = 0;
        before.forced[c.b] = 0;
        if (!bounces) continue;
        const bool a_moves = bodies.kind[c.a] == BodyKind::dynamic;
        if (a_moves == (bodies.kind[c.b] == BodyKind::dynamic)) continue;
        const double height = heightAfter(c, std::sqrt(touched), closing, acceleration, time_step);
        c.climb = 2 * acceleration * height;
        Vec3& lift = before.lift[a_moves ? c.a : c.b];
        const Vec3 way = (a_moves ? height - c.distance : c.distance - height) * c.normal;
        if (way.squaredNorm() > lift.squaredNorm()) lift = way;
    }
}

void liftBounced(BodyStorage& bodies, const VelocitiesBefore& before) {
    for (std::size_t i = 0; i < before.lift.size(); ++i) bodies.position[i] += before.lift[i];
}

void completeSmoothMotion(BodyStorage& bodies, const VelocitiesBefore& before, std::span<const std::uint8_t> jointed,
                          double time_step, const Executor& executor) {
    executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            if (bodies.kind[i] != BodyKind::dynamic || bodies.asleep[i] != 0) continue;
            if (!jointed.empty() && jointed[i] != 0) continue;
            // The clock of a body that flew a part of its way stood still since, and its velocity before the forces is
            // what leads to that of then.
            const double flown = before.way[i].part;
            if (!(speedChange(bodies, before, i) <= smooth_multiple * before.forced[i])) {
                if (before.bounced[i] != 0) {
                    bodies.position[i] += flown * flown * (before.forced_v[i] - before.v[i]) * (time_step / 2);
                }
                continue;
            }
            const Vec3 missing = flown * flown * (bodies.v[i] - before.v[i]) * (time_step / 2);
            // Added to the way first, where nothing else moved the body: in free fall it is the same in all steps, and
            // would be rounded in the same direction in all of them.
            const Vec3& begun = before.way[i].begin.position;
            if (bodies.position[i] == begun + bodies.linear_step[i]) {
                bodies.position[i] = begun + (bodies.linear_step[i] + missing);
            } else {
                bodies.position[i] += missing;
            }
            const Vec3 dw = bodies.w[i] - before.w[i];
            if (dw.isZero(0) || flown < 1) continue;
            rotateUniformly(bodies.orientation[i], dw / 2, time_step);
            bodies.inertiaInv_W[i] = toWorldInertia(bodies.inertiaInv_B[i], bodies.orientation[i]);
        }
    });
}

}  // namespace cairn
