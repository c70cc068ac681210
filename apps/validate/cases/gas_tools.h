/// @file Balls in a cage without gravity.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "validate/case.h"
#include "validate/random.h"
#include "validate/world_tools.h"

namespace cairn::validation {

/// Settings for a gas: impacts of two balls at a time, whatever their speed. A contact is found at the end of the time
/// step in which it begins, on average late by half of what the balls approach in a step; a margin of as much makes up
/// for that. Nothing is moved apart: elastic balls leave each other by themselves, and a correction that moves contacts
/// aside would make frictionless balls spin. @param approach mean speed of the approach in an impact [m/s]
inline Settings gasSettings(double rate, double approach) {
    Settings settings = accurateSettings(rate, ResolutionKind::impulse_queue);
    settings.correction.correction = CorrectionKind::none;
    settings.resolution.restitution_threshold = 0;
    settings.resolution.resolution_threshold = 1e-9;
    settings.detection.contact_margin = approach / rate / 2;
    return settings;
}

/// A cubic cage about the origin with balls of 1 kg on a lattice, all with the same speed in random directions.
struct Gas {
    double radius;  ///< [m]
    double half;    ///< of the cage's edge [m]
    World world;
    std::vector<BodyId> walls;
    std::vector<BodyId> balls;

    /// @param fraction of the cage that the balls fill @param speed [m/s]
    Gas(const Settings& settings, int per_edge, double ball_radius, double fraction, double speed,
        const PairProperties& between_balls)
        : radius(ball_radius),
          half(0.5 * std::cbrt(std::pow(per_edge, 3) * 4 / 3 * std::numbers::pi * std::pow(ball_radius, 3) / fraction)),
          world(makeWorld(settings, Vec3::Zero(), between_balls)) {
        const MaterialId wall = world.addMaterial({.name = "wall", .density = 1000});
        world.setPairProperties(MaterialId{0}, wall, contactLaw(1, 0));
        for (int axis = 0; axis < 3; ++axis) {
            for (const double sign : {-1.0, 1.0}) {
                BodyDescription plane;
                plane.shape = HalfSpace{.normal = sign * Vec3::Unit(axis), .offset = -half};
                plane.fixed = true;
                plane.material = wall;
                walls.push_back(world.addBody(plane));
            }
        }
        Random random(1);
        const double spacing = 2 * half / per_edge;
        for (int i = 0; i < per_edge * per_edge * per_edge; ++i) {
            const Vec3 cell(i % per_edge, i / per_edge % per_edge, i / per_edge / per_edge);
            BodyDescription ball = body(Sphere{radius}, 1, (cell.array() + 0.5) * spacing - half);
            const Vec3 direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
            ball.linear_velocity = speed * direction;
            balls.push_back(world.addBody(ball));
        }
    }

    double volume() const { return 8 * half * half * half; }
    /// kT [J]
    double temperature() const { return 2 * world.kineticEnergy() / (3 * static_cast<double>(balls.size())); }
    /// Balls per volume in the middle of the cage, where the walls are not felt [1/m³].
    double densityInside() const {
        const double inner = innerHalf();
        std::size_t inside = 0;
        for (const BodyId id : balls) {
            if (world.pose(id).position.cwiseAbs().maxCoeff() < inner) ++inside;
        }
        return static_cast<double>(inside) / (8 * inner * inner * inner);
    }
    /// From here to the nearest wall nothing but that wall is felt [m].
    double innerHalf() const { return half - 4 * radius; }
    /// Sum of the impulses that the walls gave in the last step: vector, and what their middle parts, as far from the
    /// edges as innerHalf(), gave inwards [N·s].
    std::pair<Vec3, double> wallImpulse() const {
        Vec3 sum = Vec3::Zero();
        double inward = 0;
        for (const ContactInfo& c : world.contacts()) {
            // The walls were added first: they are the first bodies of their contacts.
            if (!world.isFixed(c.a)) continue;
            sum -= c.impulse;
            Vec3 along = c.point.cwiseAbs();
            Eigen::Index axis = 0;
            c.normal.cwiseAbs().maxCoeff(&axis);
            along[axis] = 0;
            if (along.maxCoeff() < innerHalf()) inward += c.impulse.norm();
        }
        return {sum, inward};
    }
};

}  // namespace cairn::validation
