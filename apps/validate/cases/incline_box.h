/// @file A box on an incline.
#pragma once

#include <numbers>

#include "validate/world_tools.h"

namespace cairn::validation {

inline constexpr double degree = std::numbers::pi / 180;

/// A flat box that begins at rest on an inclined half-space.
struct InclineBox {
    Incline incline;
    World world;
    BodyId box;
    Vec3 begin;

    InclineBox(const Settings& settings, double angle, double heading, const PairProperties& law,
               const Vec3& size = Vec3(0.4, 0.4, 0.1))
        : incline(angle, heading), world(makeWorld(settings, Vec3(0, 0, -g), law)) {
        addPlane(world, incline.normal);
        BodyDescription description = body(Box{size}, 1, incline.normal * (size.z() / 2));
        description.pose.orientation = incline.orientation();
        box = world.addBody(description);
        begin = description.pose.position;
    }

    /// Since the beginning [m].
    Vec3 displacement() const { return world.pose(box).position - begin; }
};

}  // namespace cairn::validation
