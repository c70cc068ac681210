/// Bodies that can hardly move: how deep they are in each other at the end of each step, and that they come to rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "cairn/world.h"
#include "narrow_phase/approach.h"

namespace cairn {
namespace {

constexpr double rod_radius = 0.02;                      ///< [m]
constexpr double rod_allowed = 0.0145 * 2 * rod_radius;  ///< overlap [m]

/// Rods without friction that fall into a shaft hardly wider than one is long, at a quarter of the usual rate.
struct Jam {
    World world{Settings::preset(Preset::performance, 60)};
    std::vector<BodyId> rods;
    const Shape rod = Capsule{rod_radius, 0.16};

    Jam() {
        world.addMaterial({"stone", 2500});
        world.setGravity(Vec3(0, 0, -9.81));
        world.setDefaultPairProperties({.restitution = 0, .static_friction = 0, .kinetic_friction = 0});
        for (const Vec3& inwards : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
            BodyDescription wall;
            wall.shape = HalfSpace{inwards, 0};
            wall.pose.position = inwards.z() > 0 ? Vec3(0, 0, 0) : Vec3(-0.105 * inwards);
            wall.fixed = true;
            world.addBody(wall);
        }
        std::mt19937 random(1);
        const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0 * 2 - 1; };
        for (int i = 0; i < 40; ++i) {
            BodyDescription d;
            d.shape = rod;
            d.pose.position = Vec3(0, 0, 0.11 + 0.21 * i);
            d.pose.orientation = Quat(uniform(), uniform(), uniform(), uniform()).normalized();
            d.linear_velocity = Vec3(0, 0, -10);
            rods.push_back(world.addBody(d));
        }
    }
    /// How deep rods are in each other at most, where they are now [m].
    double deepest() const {
        double depth = 0;
        for (std::size_t i = 0; i < rods.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                depth = std::max(depth, overlapDepth(rod, world.pose(rods[i]), rod, world.pose(rods[k])));
            }
        }
        return depth;
    }
};

TEST(Jam, NobodyEndsAStepDeeperInOthersThanItMay) {
    Jam jam;
    double deepest = 0;
    for (int i = 0; i < 300; ++i) {
        jam.world.step();
        deepest = std::max(deepest, jam.deepest() / rod_allowed);
    }
    EXPECT_LE(deepest, 1.35);
}

TEST(Jam, ComesToRest) {
    Jam jam;
    const double first = jam.world.kineticEnergy() + jam.world.potentialEnergy();
    for (int i = 0; i < 360; ++i) jam.world.step();
    RecordProperty("motion", std::to_string(jam.world.kineticEnergy() / first));
    EXPECT_LE(jam.world.kineticEnergy(), 1e-4 * first);
}

}  // namespace
}  // namespace cairn
