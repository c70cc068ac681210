/// The hash of a state depends on the bodies, by their numbers, and on nothing else.
#include <gtest/gtest.h>

#include <array>

#include "cairn/world.h"

namespace cairn {
namespace {

BodyDescription hashedBall(double x) {
    return {.shape = Sphere{0.1}, .material = MaterialId{0}, .pose = {Vec3(x, 0, 0), Quat::Identity()}};
}

World worldOfOneMaterial() {
    World world;
    world.addMaterial({"oak", 800});
    return world;
}

TEST(StateHash, IsTheSameInOtherSlots) {
    World reused = worldOfOneMaterial();
    std::array<BodyId, 4> ids{};
    for (std::size_t i = 0; i < 3; ++i) ids[i] = reused.addBody(hashedBall(static_cast<double>(i)));
    reused.removeBody(ids[1]);
    ids[3] = reused.addBody(hashedBall(3));
    ASSERT_EQ(ids[3].index, ids[1].index);

    World appended = worldOfOneMaterial();
    for (std::size_t i = 0; i < 4; ++i) ids[i] = appended.addBody(hashedBall(static_cast<double>(i)));
    appended.removeBody(ids[1]);
    EXPECT_EQ(appended.stateHash(), reused.stateHash());
}

TEST(StateHash, TellsWhichBodyIsWhere) {
    World world = worldOfOneMaterial();
    const BodyId first = world.addBody(hashedBall(0));
    const BodyId second = world.addBody(hashedBall(1));
    const std::uint64_t before = world.stateHash();
    const Pose pose = world.pose(first);
    world.setPose(first, world.pose(second));
    world.setPose(second, pose);
    EXPECT_NE(world.stateHash(), before);
}

TEST(StateHash, ABodyThatTakesAnothersPlaceIsAnother) {
    World world = worldOfOneMaterial();
    const BodyId first = world.addBody(hashedBall(0));
    const std::uint64_t before = world.stateHash();
    world.removeBody(first);
    EXPECT_EQ(world.stateHash(), 0U);
    world.addBody(hashedBall(0));
    EXPECT_NE(world.stateHash(), before);
}

TEST(StateHash, ARestoredWorldGivesTheNextBodyTheSameNumber) {
    World world = worldOfOneMaterial();
    const BodyId first = world.addBody(hashedBall(0));
    world.addBody(hashedBall(1));
    world.removeBody(first);
    RollbackState moment;
    world.keep(moment);
    World restored = World::restore(world.save());
    world.addBody(hashedBall(2));
    restored.addBody(hashedBall(2));
    EXPECT_EQ(restored.stateHash(), world.stateHash());
    restored.load(moment);
    restored.addBody(hashedBall(2));
    EXPECT_EQ(restored.stateHash(), world.stateHash());
}

}  // namespace
}  // namespace cairn
