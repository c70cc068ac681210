/// Steps through which everybody sleeps are not computed, and nobody can tell.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cairn/world.h"

namespace cairn {
namespace {

BodyDescription stone(double x, double z, const Quat& turn = Quat::Identity()) {
    BodyDescription d;
    d.shape = Box{Vec3::Constant(0.1)};
    d.pose = {Vec3(x, 0, z), turn};
    return d;
}

/// A stack of three, two on a hinge and a ball beside them, at rest.
struct Sleepers {
    World world;
    BodyId floor{}, low{}, top{}, hinged{};
    MaterialId matter{};

    /// @param checks on = every step is computed
    explicit Sleepers(Checks checks) : world(Settings::preset(Preset::performance)) {
        world.setChecks(checks);
        world.setEventLevel(EventLevel::all);
        matter = world.addMaterial({.name = "stone", .density = 2500});
        world.setGravity(Vec3(0, 0, -9.81));
        world.setDefaultPairProperties({.restitution = 0.1, .static_friction = 0.6, .kinetic_friction = 0.5});
        BodyDescription ground;
        ground.shape = HalfSpace{};
        ground.fixed = true;
        floor = world.addBody(ground);
        low = world.addBody(stone(0, 0.05));
        world.addBody(stone(0.01, 0.151));
        top = world.addBody(stone(0, 0.252));
        const BodyId beside = world.addBody(stone(1, 0.05));
        hinged = world.addBody(stone(1.101, 0.052));
        world.addJoint(
            {.kind = JointKind::hinge, .a = beside, .b = hinged, .anchor = Vec3(1.05, 0, 0.1), .axis = Vec3::UnitY()});
        BodyDescription ball = stone(-1, 0.05);
        ball.shape = Sphere{0.05};
        world.addBody(ball);
        run(600);
    }
    void run(int steps) {
        for (int i = 0; i < steps; ++i) world.step();
    }
};

void expectSame(const World& one, const World& other, const std::string& what) {
    EXPECT_EQ(one.save(), other.save()) << what;
    ASSERT_EQ(one.events().size(), other.events().size()) << what;
    for (std::size_t i = 0; i < one.events().size(); ++i) {
        EXPECT_EQ(one.events()[i].kind, other.events()[i].kind) << what;
        EXPECT_EQ(one.events()[i].impulse, other.events()[i].impulse) << what;
    }
    EXPECT_EQ(one.statistics().contacts, other.statistics().contacts) << what;
    EXPECT_EQ(one.statistics().mean_overlap, other.statistics().mean_overlap) << what;
    EXPECT_EQ(one.statistics().batches, other.statistics().batches) << what;
}

double millisecondsOf(const World& world) {
    double sum = 0;
    for (const double ms : world.statistics().stage_ms) sum += ms;
    return sum;
}

TEST(Stillness, TakesNoTimeAndChangesNothing) {
    Sleepers still(Checks::off);
    Sleepers computed(Checks::on);
    ASSERT_EQ(still.world.statistics().asleep, 6);
    EXPECT_EQ(millisecondsOf(still.world), 0);
    EXPECT_GT(millisecondsOf(computed.world), 0);
    EXPECT_FALSE(still.world.events().empty()) << "contacts persist";
    expectSame(still.world, computed.world, "asleep");
    World resumed = World::restore(still.world.save());
    for (int i = 0; i < 10; ++i) resumed.step();
    still.run(10);
    EXPECT_EQ(resumed.save(), still.world.save());
}

TEST(Stillness, EndsWithWhateverIsChanged) {
    using Change = std::function<void(Sleepers&)>;
    const std::vector<std::pair<std::string, Change>> changes = {
        {"an impulse", [](Sleepers& s) { s.world.applyImpulse(s.top, Vec3(1, 0, 0)); }},
        {"a constant force", [](Sleepers& s) { s.world.setConstantForce(s.top, Vec3(30, 0, 0)); }},
        {"a pose",
         [](Sleepers& s) {
             s.world.setPose(s.top, {Vec3(0, 0, 1), Quat::Identity()});
         }},
        {"the floor's pose",
         [](Sleepers& s) {
             s.world.setPose(s.floor, {Vec3(0, 0, -0.1), Quat::Identity()});
         }},
        {"a support removed", [](Sleepers& s) { s.world.removeBody(s.low); }},
        {"a new body", [](Sleepers& s) { s.world.addBody(stone(0, 0.6)); }},
        {"a pair kept apart", [](Sleepers& s) { s.world.setPairTouch(s.floor, s.low, Touch::never); }},
        {"gravity", [](Sleepers& s) { s.world.setGravity(Vec3(9.81, 0, 0)); }},
        {"a surface that runs", [](Sleepers& s) { s.world.setSurfaceVelocity(s.floor, Vec3(1, 0, 0)); }},
        {"friction", [](Sleepers& s) { s.world.setPairProperties(s.matter, s.matter, {.restitution = 0}); }},
        {"a body made fast", [](Sleepers& s) { s.world.setFixed(s.low, true); }},
        {"waking", [](Sleepers& s) { s.world.wake(s.hinged); }},
        {"the frame", [](Sleepers& s) { s.world.setGlobalAcceleration(Vec3(3, 0, 0)); }},
        {"sleep forbidden",
         [](Sleepers& s) {
             Settings settings = s.world.settings();
             settings.sleep.sleeping = false;
             s.world.setSettings(settings);
         }},
    };
    for (const auto& [what, change] : changes) {
        Sleepers still(Checks::off);
        Sleepers computed(Checks::on);
        for (Sleepers* s : {&still, &computed}) {
            change(*s);
            s->run(1);
        }
        expectSame(still.world, computed.world, what);
        EXPECT_GT(millisecondsOf(still.world), 0) << what;
        for (Sleepers* s : {&still, &computed}) s->run(60);
        expectSame(still.world, computed.world, what + ", later");
    }
}

}  // namespace
}  // namespace cairn
