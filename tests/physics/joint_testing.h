/// @file A world to try joints in.
#pragma once

#include <cmath>

#include "cairn/world.h"

namespace cairn::mechanics {

inline constexpr double joint_gravity = 9.81;

/// Nothing is damped, put to sleep or held.
inline Settings undamped(double steps_per_second = 960) {
    Settings settings = Settings::preset(Preset::accuracy, steps_per_second);
    settings.sleep.damping = 0;
    settings.sleep.sleeping = false;
    settings.resolution.tolerance = 0;
    return settings;
}

struct JointBench {
    World world;
    MaterialId steel = world.addMaterial({"steel", 7800});

    explicit JointBench(const Vec3& gravity = Vec3::Zero(), const Settings& settings = undamped()) : world(settings) {
        world.setDefaultPairProperties({1, 0, 0});
        world.setGravity(gravity);
    }
    BodyId add(const Shape& shape, double mass, const Vec3& place, const Quat& turn = Quat::Identity()) {
        return world.addBody({.shape = shape, .material = steel, .mass = mass, .pose = {place, turn}});
    }
    void run(double seconds) {
        const auto steps = static_cast<int>(std::round(seconds * world.settings().steps_per_second));
        for (int i = 0; i < steps; ++i) world.step();
    }
    double step() const { return world.settings().timeStep(); }
    double energy() const { return world.kineticEnergy() + world.potentialEnergy(); }
    double largestError() const {
        double error = 0;
        for (const JointId id : world.joints()) error = std::max(error, world.joint(id).error);
        return error;
    }
};

}  // namespace cairn::mechanics
