/// @file A scene as every engine can be given it: bodies with masses and inertias, pair properties, gravity over time.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "cairn/scene.h"

namespace cairn::bench {

/// The shapes that all engines have, without a centre or axes of their own.
using RigidShape = std::variant<Sphere, Box, Capsule, HalfSpace>;

/// A body with everything an engine needs; masses and inertias are Cairn's, so that all engines have the same.
struct RigidBody {
    RigidShape shape;
    Pose pose;               ///< of B in W [m]
    Vec3 linear_velocity;    ///< [m/s, W]
    Vec3 angular_velocity;   ///< [rad/s, W]
    double mass;             ///< [kg]; of no meaning for fixed bodies
    Vec3 principal_inertia;  ///< [kg·m², B]; of no meaning for fixed bodies
    bool fixed;
    std::size_t material;  ///< index
};

/// Gravity from a time on.
struct GravityChange {
    double time;   ///< [s]
    Vec3 gravity;  ///< [m/s², W]
};

/// A scene of such shapes, without springs and joints, and with no events but changes of gravity.
class RigidScene {
  public:
    /// @throws InputError if the scene has something that not all engines have
    explicit RigidScene(const Scene& scene);

    const std::vector<RigidBody>& bodies() const { return bodies_; }
    /// @param a, b indices of materials
    const PairProperties& pair(std::size_t a, std::size_t b) const { return pairs_[a * materials_ + b]; }
    /// By time; the first is at 0.
    const std::vector<GravityChange>& gravity() const { return gravity_; }
    /// Gravity in the time step that begins at `time`. @param time_step [s]
    const Vec3& gravityAt(double time, double time_step) const;

  private:
    std::vector<RigidBody> bodies_;
    std::size_t materials_;
    std::vector<PairProperties> pairs_;  ///< [material × material]
    std::vector<GravityChange> gravity_;
};

}  // namespace cairn::bench
