/// @file Engines that answer rays, with the same bodies at the same places.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cairn/query.h"
#include "rigid_scene.h"

namespace cairn::bench {

/// The first body on a ray.
struct CastHit {
    std::size_t body;  ///< in the order of the scene
    double distance;   ///< from the origin of the ray [m]
};

/// An engine whose bodies stand still.
class RayCaster {
  public:
    virtual ~RayCaster() = default;
    /// What is timed. @param rays with a reach @param hits replaced by one entry per ray
    virtual void cast(std::span<const Ray> rays, std::vector<std::optional<CastHit>>& hits) = 0;
};

/// How to make one.
struct RayCasterKind {
    std::string name;      ///< as in tables
    std::string settings;  ///< version and precision, and how it searches
    double tolerance;      ///< from a surface, at which its search says that it is there [m]
    /// @param poses of the scene's bodies, in its order [m, W]
    std::function<std::unique_ptr<RayCaster>(const RigidScene&, std::span<const Pose> poses)> make;
};

/// Bullet in both ways in which it casts rays at convex shapes. @throws InputError naming the package to install, if
/// built without it
std::vector<RayCasterKind> bulletRayCasters();

}  // namespace cairn::bench
