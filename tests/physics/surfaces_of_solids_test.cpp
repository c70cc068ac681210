/// Concave solids in a world: they rest in and on each other as their meshes would.
#include <gtest/gtest.h>

#include "cairn/decompose.h"
#include "cairn/world.h"
#include "solid_maker.h"

namespace cairn {
namespace {

using testing::Cell;

struct Yard {
    World world{Settings::preset(Preset::accuracy)};
    MaterialId oak = world.addMaterial({"oak", 800});

    Yard() {
        world.setGravity(Vec3(0, 0, -10));
        world.setDefaultPairProperties({0.1, 0.5, 0.5});
        world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true});
    }
    BodyId add(const Shape& shape, const Vec3& position, const Quat& turn = Quat::Identity()) {
        return world.addBody({.shape = shape, .material = oak, .pose = {position, turn}});
    }
    void run(double seconds) {
        const double end = world.time() + seconds;
        while (world.time() < end - 1e-9) world.step();
    }
};

TEST(ConcaveSolid, ABallRestsInABowlThatRests) {
    const Decomposition bowl = decompose(testing::bowl(0.5, 0.4, 24, 8).mesh(), {.largest_error = 0.08});
    EXPECT_LE(bowl.error, 0.08);
    Yard yard;
    yard.world.setDefaultPairProperties(
        {.restitution = 0.1, .static_friction = 0.5, .kinetic_friction = 0.5, .rolling_friction = 2e-3});
    const BodyId pot = yard.add(bowl.compound, Vec3(0, 0, 0.51));
    const BodyId ball = yard.add(Sphere{0.1}, Vec3(0.12, 0, 0.6));
    yard.run(6);
    // On the bottom of the bowl, which the parts make a little higher than the mesh has it.
    EXPECT_NEAR(yard.world.pose(ball).position.z() - (yard.world.pose(pot).position.z() - 0.4), 0.1, 0.03);
    EXPECT_LT((yard.world.pose(ball).position - yard.world.pose(pot).position).head<2>().norm(), 0.12);
    EXPECT_LT(yard.world.linearVelocity(ball).norm(), 0.05);
    EXPECT_LT(yard.world.linearVelocity(pot).norm(), 0.05);
}

TEST(ConcaveSolid, HasTheMassOfItsMeshHoweverCoarseItsParts) {
    const Mesh mesh = testing::cubes({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}).mesh();
    Yard yard;
    const BodyId fine = yard.add(decompose(mesh).compound, Vec3(0, 0, 1));
    const BodyId coarse = yard.add(decompose(mesh, {.most_parts = 1}).compound, Vec3(9, 0, 1));
    EXPECT_NEAR(yard.world.mass(fine), 2400, 1e-9);
    EXPECT_NEAR(yard.world.mass(coarse), 2400, 1e-9);
    EXPECT_NEAR(yard.world.pose(coarse).position.x(), 9, 1e-12);
}

TEST(ConcaveSolid, AnglesInterlockAndStandOnEachOther) {
    const Compound angle = decompose(testing::cubes({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}).mesh()).compound;
    Yard yard;
    const BodyId lower = yard.add(angle, Vec3(0, 0, 0));
    // Turned about y by half a turn it fills what the lower one leaves of a block of two by two.
    const BodyId upper = yard.add(angle, Vec3(2, 0, 3.001), Quat(0, 0, 1, 0));
    yard.run(3);
    EXPECT_LT((yard.world.pose(lower).position - Vec3::Zero()).norm(), 0.01);
    EXPECT_LT((yard.world.pose(upper).position - Vec3(2, 0, 3)).norm(), 0.02);
    EXPECT_GT(yard.world.pose(upper).orientation.y(), 0.9999);
}

TEST(ConcaveSolid, ARingHangsOnAPeg) {
    const Compound ring = decompose(testing::torus(0.3, 0.06, 32, 12).mesh(), {.largest_error = 0.1}).compound;
    Yard yard;
    yard.world.addBody({.shape = Capsule{0.05, 0.6},
                        .material = yard.oak,
                        .pose = {Vec3(0, 0, 2), Quat(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()))},
                        .fixed = true});
    const Quat upright(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));
    const BodyId hanging = yard.add(ring, Vec3(0, 0, 1.8), upright);
    yard.run(2);
    EXPECT_NEAR(yard.world.pose(hanging).position.z(), 2.05 - 0.24, 0.03);
}

TEST(ConcaveSolid, ASnapshotKeepsItsMass) {
    Yard yard;
    const Compound angle =
        decompose(testing::cubes({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}).mesh(), {.most_parts = 1}).compound;
    const BodyId body = yard.add(angle, Vec3(0, 0, 1), Quat(0.9, 0.1, 0.2, 0.3));
    yard.run(0.1);
    World again = World::restore(yard.world.save());
    yard.run(0.5);
    while (again.time() < yard.world.time() - 1e-9) again.step();
    EXPECT_EQ(again.stateHash(), yard.world.stateHash());
    EXPECT_EQ(again.mass(body), yard.world.mass(body));
    const auto* compound = std::get_if<Compound>(&again.shape(body));
    ASSERT_NE(compound, nullptr);
    ASSERT_TRUE(compound->solid.has_value());
    EXPECT_EQ(compound->solid->inertia, angle.solid->inertia);
}

}  // namespace
}  // namespace cairn
