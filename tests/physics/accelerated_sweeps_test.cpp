/// The resolution with warm starting and conjugate gradients, on whole scenes.
#include <gtest/gtest.h>

#include "cairn/scene.h"

namespace cairn {
namespace {

Settings accelerated(const Scene& scene) {
    Settings settings = settingsFor(scene);
    settings.resolution.resolution = ResolutionKind::accelerated_sweeps;
    settings.sleep.damping = 0;
    return settings;
}

TEST(AcceleratedSweeps, CarryTheWholeWeightOfATowerToTheGround) {
    const Scene scene = builtInScene("tower:5");
    Settings settings = accelerated(scene);
    settings.sleep.sleeping = false;
    settings.resolution.iterations = 200;
    settings.resolution.tolerance = 0;
    settings.resolution.resolution_threshold = 1e-7;
    SceneRun run(scene, settings);
    for (int i = 0; i < 240; ++i) run.step();
    double weight = 0;
    for (const ContactInfo& contact : run.world().contacts()) {
        if (contact.a == run.ids()[0]) weight -= contact.impulse.z();
    }
    EXPECT_NEAR(weight / (5 * 0.8 * 10 / 240), 1, 1e-6);
}

TEST(AcceleratedSweeps, HoldAnAwakeTowerOfTenWithinAMillimetre) {
    const Scene scene = builtInScene("tower:10");
    Settings settings = accelerated(scene);
    settings.sleep.sleeping = false;
    settings.resolution.iterations = 30;
    settings.resolution.resolution_threshold = 8e-6;
    SceneRun run(scene, settings);
    for (int i = 0; i < 20 * 240; ++i) run.step();
    EXPECT_EQ(run.world().contacts().size(), 40U);
    for (std::size_t i = 1; i < run.ids().size(); ++i) {
        EXPECT_LT((run.world().pose(run.ids()[i]).position - scene.bodies[i].position).norm(), 1e-3) << i;
    }
}

TEST(AcceleratedSweeps, HoldATowerThatResistsRollingAsAnyOther) {
    const Scene scene = builtInScene("tower:20");
    Settings settings = accelerated(scene);
    settings.sleep.sleeping = false;
    SceneRun freely(scene, settings);
    SceneRun resisting(scene, settings);
    PairProperties pair;
    pair.static_friction = pair.kinetic_friction = 0.5;
    freely.world().setDefaultPairProperties(pair);
    pair.rolling_friction = pair.spinning_friction = 0.005;
    resisting.world().setDefaultPairProperties(pair);
    for (int i = 0; i < 2 * 240; ++i) {
        freely.step();
        resisting.step();
    }
    EXPECT_LT(freely.world().kineticEnergy(), 1e-9);
    for (const BodyId id : freely.ids()) {
        ASSERT_EQ(freely.world().pose(id).position, resisting.world().pose(id).position) << id.index;
    }
}

TEST(AcceleratedSweeps, AreTheSameOnAnyNumberOfThreads) {
    const Scene scene = builtInScene("cage384");
    Settings settings = accelerated(scene);
    SceneRun one(scene, settings);
    settings.parallel = {3, true};
    SceneRun three(scene, settings);
    for (int i = 0; i < 480; ++i) {
        one.step();
        three.step();
        ASSERT_EQ(one.world().stateHash(), three.world().stateHash()) << i;
    }
}

TEST(AcceleratedSweeps, KeepMomentumInAFreeCollision) {
    World world(accelerated(builtInScene("tower:1")));
    const MaterialId oak = world.addMaterial({"oak", 800});
    for (int i = 0; i < 4; ++i) {
        const BodyId id = world.addBody({.shape = Sphere{0.1},
                                         .material = oak,
                                         .pose = {Vec3(0.21 * i, 0.03 * i, 0), Quat::Identity()},
                                         .linear_velocity = Vec3(2.0 - i, 0, 0.1 * i)});
        world.setAngularVelocity(id, Vec3(0, i, 1));
    }
    const Vec3 linear = world.linearMomentum();
    const Vec3 angular = world.angularMomentum();
    const double energy = world.kineticEnergy();
    world.setSettings([&] {
        Settings s = world.settings();
        s.correction.correction = CorrectionKind::none;
        return s;
    }());
    for (int i = 0; i < 60; ++i) world.step();
    EXPECT_LT((world.linearMomentum() - linear).norm(), 1e-12 * linear.norm() + 1e-13);
    EXPECT_LT((world.angularMomentum() - angular).norm(), 1e-11);
    EXPECT_LT(world.kineticEnergy(), energy);
}

}  // namespace
}  // namespace cairn
