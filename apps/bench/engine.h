/// @file An engine that simulates a rigid scene: Cairn, or one of its peers.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rigid_scene.h"

namespace cairn::bench {

/// What all engines are given.
struct EngineOptions {
    double steps_per_second = 240;
    bool sleeping = true;  ///< bodies at rest may sleep; all begin awake
};

/// A simulation in progress.
class Engine {
  public:
    virtual ~Engine() = default;
    /// One time step; what is timed. Changes gravity when it is due.
    virtual void step() = 0;
    /// @param poses replaced by one pose per body of the scene, in its order [m, W]
    virtual void poses(std::vector<Pose>& poses) const = 0;
    /// Bodies asleep.
    virtual std::size_t asleep() const = 0;
};

/// How to make an engine.
struct EngineKind {
    std::string name;      ///< as on the command line and in tables
    std::string version;   ///< with the precision it was compiled with
    std::string settings;  ///< what was chosen and what was left as it is
    /// @throws InputError
    std::function<std::unique_ptr<Engine>(const Scene&, const RigidScene&, const EngineOptions&)> make;
};

/// Cairn with a scene's settings, overridden. @param threads of a step
EngineKind cairnEngine(std::string name, SettingOverrides overrides, std::int64_t threads);
/// Bullet's sequential impulses. @throws InputError naming the package to install, if built without it
EngineKind bulletEngine();
/// ODE's quick step. @throws InputError naming the package to install, if built without it
EngineKind odeEngine();

}  // namespace cairn::bench
