/// @file Moving bodies by their velocities, and velocities by forces. @source thesis §3.1, Algorithms 6 and 12
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/body_storage.h"
#include "body/body_way.h"
#include "body/contact.h"
#include "cairn/settings.h"
#include "parallel/executor.h"

namespace cairn {

/// Turns a body for a time with no torque acting: the angular momentum in W stays, the angular velocity follows the
/// orientation (Euler's equations). Fourth-order Runge–Kutta on the rotation group, Munthe-Kaas (1998),
/// doi:10.1007/BF02510919, then projected onto the energy it began with. @param inertia_B principal [kg·m², B] @param
/// time [s]
void rotateFreely(Quat& orientation, Vec3& w, const Vec3& inertia_B, double time);

/// Turns a body for a time at constant angular velocity [rad/s, W].
void rotateUniformly(Quat& orientation, const Vec3& w, double time);

/// Moves one body by its velocities and notes ℓ. @pre dynamic and awake @param time_step [s]
void advancePosition(BodyStorage& bodies, BodyIndex i, double time_step);

/// Moves all awake dynamic bodies by their velocities and notes ℓ (linear_step); others get ℓ = 0.
/// @param time_step [s]
void advancePositions(BodyStorage& bodies, double time_step, const Executor& executor);

/// The ways of bodies, velocities before the forces of a step acted, and how far those changed them. One entry per
/// slot; the vectors keep their memory.
struct VelocitiesBefore {
    std::vector<BodyWay> way;
    std::vector<Vec3> v;         ///< [m/s, W]
    std::vector<Vec3> w;         ///< [rad/s, W]
    std::vector<double> forced;  ///< by the forces, at most, of any point of the body [m/s]
    std::vector<Vec3> forced_v;  ///< with exact_flight: velocities after the forces, before the resolution [m/s, W]
    std::vector<std::uint8_t> bounced;  ///< 1 = flew until an impact at the end of the step took nothing from it
    std::vector<Vec3> lift;             ///< with RestitutionSpeed::touching: out of what the body bounces off [m, W]
};

/// Notes where bodies are before advancePositions(). @param before out
void beginWays(const BodyStorage& bodies, const Executor& executor, VelocitiesBefore& before);
/// Lets a body fly only a part of its flight. Its clock stands still from then on: its velocity has less of what forces
/// will give, so that its energy stays what it was. @param part less than way.part @param acceleration sum of the
/// global accelerations [m/s², W] @param time_step of the flight [s] @param way in and out
void flyBack(BodyStorage& bodies, BodyIndex i, double part, const Vec3& acceleration, const SleepSettings& settings,
             double time_step, BodyWay& way);
/// Notes the velocities before advanceVelocities(). @param before out
void saveVelocities(const BodyStorage& bodies, const Executor& executor, VelocitiesBefore& before);
/// Notes what the forces changed, between advanceVelocities() and the resolution. @param before in and out
void saveForced(const BodyStorage& bodies, const Executor& executor, VelocitiesBefore& before);

/// Fills in what RestitutionSpeed::touching needs of the contacts, between advanceVelocities() and the resolution.
/// While a contact is closed by the acceleration a with the closing speed u at the distance z, u² + 2az stays the same.
/// The motion of bodies that land or bounce counts as not smooth, however slow they are.
/// @param threshold speed of touching below which nothing bounces [m/s] @param before in and out
void saveTouching(const BodyStorage& bodies, double threshold, double time_step, VelocitiesBefore& before,
                  std::span<Contact> contacts);

/// Moves the bodies that bounced off fixed ones to where they are by the end of the step, having bounced when they
/// touched: beginning the bounce at the end of the step, in the overlap that the correction leaves, would cost time.
/// @pre saveTouching() in this step, and the resolution is done
void liftBounced(BodyStorage& bodies, const VelocitiesBefore& before);

/// Completes the step of all awake dynamic bodies that moved smoothly: advancePositions() moved them by the velocity at
/// the beginning of the step, this adds what is missing to the mean of beginning and end. Under constant forces that is
/// the exact parabola; bodies at rest, whose velocity does not change, stay where they are. Where an impact changed the
/// velocity by more than forces could, the mean means nothing: then a body that bounced completes the parabola until
/// the impact, without which its energy would rise by that of the way that forces gave it, and others are left alone.
/// @pre beginWays() and saveForced() in this step, and the resolution is done @param jointed [slots] 1 = left to
/// JointFlight; empty = none is @param time_step [s]
void completeSmoothMotion(BodyStorage& bodies, const VelocitiesBefore& before, std::span<const std::uint8_t> jointed,
                          double time_step, const Executor& executor);

/// Adds to a velocity what one of many steps gives. The same small number added over and over is rounded in the same
/// direction each time: 2·10⁻¹² of the way of a fall of 10 s at 3840 steps per second. So the sum is rounded up in as
/// many of the steps, and down in the others, as leaves no more than a rounding of the whole. @param step its number
double addInSteps(double velocity, double gain, std::int64_t step);

/// Gravity damping takes hold of what is slower: ten times the speed at which it sleeps. @source thesis §5.1 (8.33 and
/// 83.3 mm/s)
double dampedSpeed(const SleepSettings& settings);
/// The part of the global accelerations that gravity damping leaves to bodies at rest.
double dampedPart(const SleepSettings& settings);
/// The part that it leaves to a body. What moves evenly keeps all of its weight, by which friction and rolling friction
/// slow it down; bodies have no mean velocities with the thesis's presets. @param v, w its velocities [m/s, W], [rad/s,
/// W]
double gravityPartOf(const BodyStorage& bodies, BodyIndex i, const Vec3& v, const Vec3& w,
                     const SleepSettings& settings);

/// What the forces that are known change of a body's velocity per time [m/s², W].
/// @param acceleration sum of the global accelerations [m/s², W]
Vec3 accelerationOf(const BodyStorage& bodies, BodyIndex i, const Vec3& acceleration, const SleepSettings& settings);

/// Adds to the velocities of all awake dynamic bodies what the forces give in one step; slow bodies feel only a part of
/// the global acceleration (Algorithm 12).
/// @param acceleration sum of the global accelerations [m/s², W] @param step its number, where addInSteps() is to add
void advanceVelocities(BodyStorage& bodies, const Vec3& acceleration, const SleepSettings& settings, double time_step,
                       const Executor& executor, std::optional<std::int64_t> step = std::nullopt);

/// Clears the one-step forces of all bodies.
void clearForces(BodyStorage& bodies, const Executor& executor);

}  // namespace cairn
