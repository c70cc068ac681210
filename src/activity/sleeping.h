/// @file The sleeping system: bodies that barely move stop being moved until something happens to them.
/// @source thesis §3.2, Algorithm 5
#pragma once

#include <cstdint>
#include <span>

#include "body/body_storage.h"
#include "body/body_way.h"
#include "body/contact.h"
#include "cairn/settings.h"
#include "parallel/executor.h"

namespace cairn {

/// Upper bound of the squared speed of any point of a body [m²/s²]. @source (3.2.3)
inline double squaredMotion(const Vec3& v, const Vec3& w, double r_max) {
    return 2 * (v.squaredNorm() + w.squaredNorm() * r_max * r_max);
}

/// Counts for every dynamic body its contacts in the direction of gravity: those into which gravity pushes it.
/// @param acceleration sum of the global accelerations [m/s², W]; zero = no body has such a contact
/// @param supports [slots] out
void countSupports(std::span<const BodyKind> kind, std::span<const Contact> contacts, const Vec3& acceleration,
                   std::span<std::int32_t> supports);

/// Wakes sleeping bodies that lost a support since the last step (condition 5) or have none (condition 6).
/// @param before supports of the last step, −1 = unknown; @param now of this step
void wakeUnsupported(const BodyState& bodies, std::span<const std::int32_t> before, std::span<const std::int32_t> now,
                     const Executor& executor);

/// What falling asleep reads and writes besides the response's view of the bodies. One entry per slot.
struct MotionState {
    std::span<double> motion;                  ///< rwa [m²/s²]
    std::span<const double> r_max;             ///< [m]
    std::span<const Vec3> constant_force;      ///< [N]
    std::span<const Vec3> constant_torque;     ///< [N·m]
    std::span<const std::uint8_t> together{};  ///< 1 = sleeps only with others; empty = none does
    std::span<const BodyWay> way{};            ///< since the beginning of the last part of the step; empty = unknown
    double part_length = 0;                    ///< [s]
    /// Recency-weighted averages of the velocities [m/s, W], [rad/s, W]; where ways are known.
    std::span<Vec3> mean_v{}, mean_w{};
};

/// How long a step is.
struct StepLength {
    double time = 1.0 / 240;  ///< [s]
    double usual = 240;       ///< steps per second by the sizes of the bodies [1/s]: the thesis's are for its own
};

/// Weight of the history in the averaged motion (3.2.4): 0.9 at the usual number of steps per second, and the same
/// decay in the same time at others.
double motionBias(const StepLength& step);

/// The value that a new or moved body's averaged motion begins with: its cap (Algorithm 5), three times the threshold,
/// so that rest must be proven first.
double initialMotion(const SleepSettings& settings);

/// Algorithm 5 for every awake body. Who is held back by others or pushed back by the correction has a velocity and
/// goes nowhere: where it is known how bodies went, only that and what their velocities gained since is motion, and of
/// that the mean, since what sweeps leave from step to step leads to and fro, and begins anew in the step after one
/// that woke it. A body with a constant force too weak to show within one step stays awake, since (3.2.5) holds for
/// every lasting force.
void fallAsleep(const BodyState& bodies, const MotionState& motion, const SleepSettings& settings,
                const StepLength& step, const Executor& executor);

/// Puts bodies that sleep only with each other to sleep if all of them would. @pre after fallAsleep()
void fallAsleepTogether(const BodyState& bodies, const MotionState& motion, const SleepSettings& settings,
                        double time_step, std::span<const BodyIndex> group);

}  // namespace cairn
