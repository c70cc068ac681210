/// @file What most cases need to set up their world.
#pragma once

#include <functional>

#include "cairn/world.h"

namespace cairn::validation {

/// Standard gravity of the cases [m/s²].
inline constexpr double g = 9.81;

/// The accuracy preset with exact flight and without sleeping. Sweeps, unlike the queue, run until they converge.
Settings accurateSettings(double steps_per_second, ResolutionKind resolver = ResolutionKind::accelerated_sweeps);

/// A contact law.
inline PairProperties contactLaw(double restitution, double friction) {
    return {.restitution = restitution, .static_friction = friction, .kinetic_friction = friction};
}

/// A world with one material and one contact law. @param gravity [m/s², W]
World makeWorld(const Settings& settings, const Vec3& gravity, const PairProperties& law);

/// A dynamic body of the given mass [kg], whose centre is at `position` [m].
BodyDescription body(const Shape& shape, double mass, const Vec3& position);

/// A fixed half-space below the plane through the origin.
BodyId addPlane(World& world, const Vec3& normal = Vec3::UnitZ());

/// Steps until a simulated time [s] is reached.
void runUntil(World& world, double time);

/// Axes of a plane that is inclined by an angle [rad] and goes down in a compass direction [rad].
struct Incline {
    Vec3 normal;
    Vec3 downhill;
    Incline(double angle, double heading);
    /// Orientation of a body that lies on it: its z axis is the normal, its x axis points downhill.
    Quat orientation() const;
};

/// The value at which a yes–no outcome changes, by bisection. @pre holds(low) and not holds(high)
double threshold(double low, double high, double resolution, const std::function<bool(double)>& holds);

}  // namespace cairn::validation
