/// Bodies on triangles: on a plane of them they move as on the plane, and nothing falls through.
#include <gtest/gtest.h>

#include <vector>

#include "cairn/world.h"
#include "surface_maker.h"
#include "surface_motion.h"
#include "throws.h"

namespace cairn {
namespace {

using testing::difference;
using testing::heightOf;
using testing::lying;
using testing::OnSurface;
using testing::PlacedGround;
using testing::Start;

const PlacedGround& plane() {
    static const PlacedGround ground{HalfSpace{}};
    return ground;
}

const PlacedGround& fineGround() {
    static const PlacedGround ground{testing::flatMesh(200, 24, 11)};
    return ground;
}

TEST(SurfaceMotion, BodiesSlideAsOnThePlane) {
    for (const auto& [name, shape] : testing::solids()) {
        Start start{{Vec3(0.1, 0.2, heightOf(shape))}, Vec3(1.6, 0.7, 0), Vec3::Zero(), 0.05};
        EXPECT_LT(difference(shape, start, plane(), fineGround(), 5), 1e-9) << name;
    }
}

TEST(SurfaceMotion, RoundBodiesRollAsOnThePlane) {
    for (const Shape& shape : {Shape(Sphere{0.2}), Shape(Capsule{0.15, 0.3}), Shape(Cylinder{0.15, 0.4})}) {
        const double radius = std::holds_alternative<Sphere>(shape) ? 0.2 : 0.15;
        const Vec3 axis = lying() * Vec3::UnitZ();
        const Vec3 v = 1.7 * axis.cross(Vec3::UnitZ());
        Start start{{Vec3(0.1, 0.2, radius), lying()}, v, Vec3::UnitZ().cross(v) / radius, 0.5};
        EXPECT_LT(difference(shape, start, plane(), fineGround(), 5), 1e-9) << shape.index();
    }
}

TEST(SurfaceMotion, BodiesRestAsOnThePlane) {
    for (const auto& [name, shape] : testing::solids()) {
        Start start{{Vec3(0.3, -0.2, heightOf(shape) + 0.01), Quat(Eigen::AngleAxisd(0.4, Vec3::UnitZ()))},
                    Vec3::Zero(),
                    Vec3::Zero(),
                    0.5};
        EXPECT_LT(difference(shape, start, plane(), fineGround(), 5), 1e-9) << name;
    }
}

TEST(SurfaceMotion, BodiesTumbleAsOnThePlane) {
    const Start start{
        {Vec3(-2, -1, 1), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))}, Vec3(2, 1, 0), Vec3(3, -4, 2)};
    for (const auto& [name, shape] : testing::solids()) {
        testing::expectSameTumbling(name, shape, start, plane(), fineGround(), 5);
    }
}

TEST(SurfaceMotion, SlidingOverAThousandTrianglesLosesNoEnergy) {
    // Without friction and gravity's work nothing may be lost at a seam.
    const Mesh track = testing::irregularMesh(100, 20, 17, [](double, double) { return 0.0; });
    Settings settings = Settings::preset(Preset::accuracy);
    settings.sleep.sleeping = false;
    settings.sleep.damping = 0;
    for (const auto& [name, shape] : testing::solids()) {
        OnSurface ground({track}, 0, settings);
        const BodyId id = ground.world.addBody({.shape = shape,
                                                .material = ground.oak,
                                                .pose = {Vec3(-8, -8, heightOf(shape))},
                                                .linear_velocity = Vec3(3, 3, 0)});
        if (std::string_view(name) == "hull" || std::string_view(name) == "compound") continue;  // they tumble
        ground.run(5);
        const double kept = ground.world.linearVelocity(id).head<2>().squaredNorm() / 18;
        EXPECT_NEAR(kept, 1, 1e-12) << name;
        EXPECT_NEAR(ground.world.pose(id).position.x(), 7, 0.1) << name;
    }
}

/// A shortened `tools/drops`. Of the worlds of these seeds at 60 steps per second each lost a solid as long as contacts
/// were foreseen with what is nearest on the ground only.
TEST(SurfaceMotion, NothingFallsThroughRoughGround) {
    using testing::Company;
    using testing::Ground;
    const auto expectNoneLost = [](testing::Throws throws, std::vector<std::uint64_t> seeds) {
        const Shape ground = testing::roughGround(throws.ground);
        for (const std::uint64_t seed : seeds) {
            throws.seed = seed;
            for (const testing::LostSolid& lost : testing::throwSolids(ground, throws)) {
                ADD_FAILURE() << "seed " << seed << ": " << lost.kind << " " << lost.index << " is at "
                              << lost.position.transpose();
            }
        }
    };
    const Settings few = Settings::preset(Preset::performance, 60);
    expectNoneLost({.ground = Ground::mesh, .settings = few, .smallest = 0.1}, {52, 55, 58, 62});
    expectNoneLost({.ground = Ground::height_field, .settings = few, .smallest = 0.1}, {1002, 1015});
    expectNoneLost({.company = Company::together, .settings = few, .bodies = 120}, {1});
    expectNoneLost({.settings = Settings::preset(Preset::performance), .smallest = 0.1}, {2});
}

TEST(SurfaceMotion, AMeshIsFixedOrMovesByALaw) {
    OnSurface ground({HalfSpace{}}, 0.5);
    try {
        ground.world.addBody({.shape = testing::boxMesh({1, 1, 1}), .material = ground.oak});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("must be fixed; give it a motion"), std::string::npos);
    }
    // A plate of triangles that rises carries a box along.
    const BodyId lift = ground.world.addBody({.shape = testing::flatMesh(8, 2),
                                              .material = ground.oak,
                                              .pose = {Vec3(0, 0, 1)},
                                              .fixed = true,
                                              .motion = ConstantMotion{.velocity = Vec3(0.2, 0, 0.5)}});
    const BodyId box =
        ground.world.addBody({.shape = Box{{0.3, 0.3, 0.3}}, .material = ground.oak, .pose = {Vec3(0.1, 0.1, 1.15)}});
    ground.run(1);
    EXPECT_NEAR(ground.world.pose(lift).position.z(), 1.5, 1e-9);
    EXPECT_NEAR(ground.world.pose(box).position.z(), 1.65, 5e-3);
    EXPECT_NEAR(ground.world.pose(box).position.x(), 0.3, 0.02);
}

TEST(SurfaceMotion, SnapshotsKeepSurfaces) {
    OnSurface ground({testing::irregularMesh(6, 4, 3, [](double x, double y) { return 0.1 * x * y; })}, 0.5);
    ground.world.addBody({.shape = HeightField(3, {0, 1, 0, 1, 0, 1}, {0.5, 0.4}),
                          .material = ground.oak,
                          .pose = {Vec3(9, 0, 0)},
                          .fixed = true});
    ground.world.addBody({.shape = Box{{0.3, 0.3, 0.3}}, .material = ground.oak, .pose = {Vec3(0.1, 0.1, 0.4)}});
    ground.run(0.3);
    World again = World::restore(ground.world.save());
    EXPECT_EQ(again.stateHash(), ground.world.stateHash());
    for (int i = 0; i < 120; ++i) {
        ground.world.step();
        again.step();
    }
    EXPECT_EQ(again.stateHash(), ground.world.stateHash());
}

}  // namespace
}  // namespace cairn
