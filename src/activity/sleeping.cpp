#include "activity/sleeping.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "math/tolerances.h"

namespace cairn {

void countSupports(std::span<const BodyKind> kind, std::span<const Contact> contacts, const Vec3& acceleration,
                   std::span<std::int32_t> supports) {
    std::ranges::fill(supports, 0);
    const double magnitude = acceleration.norm();
    if (!(magnitude > 0)) return;
    const Vec3 down = acceleration / magnitude;
    for (const Contact& contact : contacts) {
        if (contact.isForeseen()) continue;
        // The normal points to A: A falls into the contact against it, B along it.
        const double into = contact.normal.dot(down);
        const BodyIndex fallen = into < 0 ? contact.a : contact.b;
        if (std::abs(into) > perpendicular_cosine && kind[fallen] == BodyKind::dynamic) ++supports[fallen];
    }
}

void wakeUnsupported(const BodyState& bodies, std::span<const std::int32_t> before, std::span<const std::int32_t> now,
                     const Executor& executor) {
    executor.forBlocks(bodies.size(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            if (bodies.asleep[i] == 0) continue;
            if (now[i] < before[i]) bodies.wake(i, WakeReason::support_lost);
            if (now[i] == 0) bodies.wake(i, WakeReason::floating);
        }
    });
}

double motionBias(const StepLength& step) {
    return std::pow(0.9, step.usual * step.time);
}

double initialMotion(const SleepSettings& settings) {
    constexpr double multiple = 3;
    const double limit = multiple * settings.sleep_threshold;
    return limit * limit;
}

namespace {

/// The rotation vector of a body over a time is told from its orientations up to this angle [rad].
constexpr double most_turned = 1;

/// What does not go anywhere on the mean may shake with up to this multiple of the speed with which bodies fall asleep:
/// by what sweeps leave of what gravity gave.
constexpr double most_shaking = 5;

struct Velocities {
    Vec3 v, w;
};

/// Those of a body, or those with which it went and what it gained since, whichever is less.
Velocities velocitiesOf(const BodyState& bodies, const MotionState& state, BodyIndex i) {
    const Velocities now{bodies.v[i], bodies.w[i]};
    const BodyWay& way = state.way[i];
    const double time = state.part_length;
    if (!(way.w.norm() * time < most_turned)) return now;
    const Vec3 v = (bodies.position[i] - way.begin.position) / time;
    const Vec3 w = toRotationVector(bodies.orientation[i] * way.begin.orientation.conjugate()) / time;
    const Velocities gone{v + (now.v - way.v), w + (now.w - way.w)};
    const double r_max = state.r_max[i];
    return squaredMotion(now.v, now.w, r_max) < squaredMotion(gone.v, gone.w, r_max) ? now : gone;
}

/// The squared motion (3.2.3) of a body [m²/s²]: of its velocity or, where it is known how bodies went, of the mean of
/// that, unless it shakes. @param bias weight of the mean so far @param begins whether what was before is no part of it
double motionOf(const BodyState& bodies, const MotionState& state, double bias, bool begins, BodyIndex i) {
    const double r_max = state.r_max[i];
    if (state.way.empty()) return squaredMotion(bodies.v[i], bodies.w[i], r_max);
    const auto [v, w] = velocitiesOf(bodies, state, i);
    Vec3& mean_v = state.mean_v[i];
    Vec3& mean_w = state.mean_w[i];
    mean_v = begins ? v : bias * mean_v + (1 - bias) * v;
    mean_w = begins ? w : bias * mean_w + (1 - bias) * w;
    const double shaking = squaredMotion(v, w, r_max) / (most_shaking * most_shaking);
    return std::max(squaredMotion(mean_v, mean_w, r_max), shaking);
}

/// Whether a body has the motion still that it fell asleep with, though it may be awake.
bool hasMotionOfSleep(const MotionState& state, double threshold, BodyIndex i) {
    return state.motion[i] == threshold;
}

/// Whether a body woke and moves now: what pushed it may be what sweeps leave and the next step takes back, so that
/// only that one tells whether it goes on.
bool isJustPushed(const BodyState& bodies, const MotionState& state, double threshold, BodyIndex i) {
    const bool slept = bodies.woken[i] != WakeReason::none && hasMotionOfSleep(state, threshold, i);
    if (state.way.empty() || !slept) return false;
    const auto [v, w] = velocitiesOf(bodies, state, i);
    return !(squaredMotion(v, w, state.r_max[i]) < threshold);
}

/// Whether a constant force is too weak to show within one step: such a body must stay awake.
bool isWeaklyPushed(const BodyState& bodies, const MotionState& state, BodyIndex i, double threshold,
                    double time_step) {
    const Vec3 dv = state.constant_force[i] * (bodies.mass_inv[i] * time_step);
    const Vec3 dw = bodies.inertiaInv_W[i] * state.constant_torque[i] * time_step;
    const double gained = squaredMotion(dv, dw, state.r_max[i]);
    return gained > 0 && gained <= threshold;
}

void putToSleep(const BodyState& bodies, const MotionState& state, BodyIndex i, double threshold) {
    bodies.v[i].setZero();
    bodies.w[i].setZero();
    state.motion[i] = threshold;
    bodies.asleep[i] = 1;
}

}  // namespace

void fallAsleepTogether(const BodyState& bodies, const MotionState& state, const SleepSettings& settings,
                        double time_step, std::span<const BodyIndex> group) {
    const double threshold = settings.sleep_threshold * settings.sleep_threshold;
    const bool all = std::ranges::all_of(group, [&](BodyIndex i) {
        return bodies.asleep[i] == 0 && state.motion[i] < threshold &&
               !isWeaklyPushed(bodies, state, i, threshold, time_step);
    });
    if (!all) return;
    for (const BodyIndex i : group) {
        if (!bodies.isFixed(i)) putToSleep(bodies, state, i, threshold);
    }
}

void fallAsleep(const BodyState& bodies, const MotionState& state, const SleepSettings& settings,
                const StepLength& step, const Executor& executor) {
    const double threshold = settings.sleep_threshold * settings.sleep_threshold;
    const double limit = initialMotion(settings);
    const double bias = motionBias(step);
    executor.forBlocks(bodies.size(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            if (bodies.isFixed(i) || bodies.asleep[i] != 0) continue;
            if (isJustPushed(bodies, state, threshold, i)) continue;
            double& motion = state.motion[i];
            // What woke it is no part of a rest.
            const bool begins = bodies.woken[i] != WakeReason::none || hasMotionOfSleep(state, threshold, i);
            motion = bias * motion + (1 - bias) * motionOf(bodies, state, bias, begins, i);
            if (!(motion < threshold)) {
                motion = std::min(motion, limit);
                continue;
            }
            if (!state.together.empty() && state.together[i] != 0) continue;
            if (isWeaklyPushed(bodies, state, i, threshold, step.time)) continue;
            putToSleep(bodies, state, i, threshold);
        }
    });
}

}  // namespace cairn
