/// Calls that read or write many bodies at once.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "cairn/scene.h"

namespace cairn {
namespace {

/// Two spheres above the ground, which is body 0.
struct TwoSpheres {
    TwoSpheres() {
        world.setGravity(Vec3(0, 0, -10));
        const MaterialId oak = world.addMaterial({"oak", 800});
        ids.push_back(world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true}));
        for (const double x : {0.0, 2.0}) {
            ids.push_back(world.addBody(
                {.shape = Sphere{0.1}, .material = oak, .pose = {Vec3(x, 0, 1), Quat(0, 1, 0, 0)}, .asleep = true}));
        }
    }
    World world;
    std::vector<BodyId> ids;
};

TEST(BodyViews, SayWhatTheCallsForOneBodySayAndFollowTheSteps) {
    const Scene scene = builtInScene("tower:5");
    SceneRun run(scene, settingsFor(scene));
    World& world = run.world();
    world.removeBody(run.ids()[3]);
    const BodyViews views = world.bodyViews();
    std::vector<Pose> poses;
    for (int step = 0; step < 40; ++step) {
        world.step();
        world.posesTo(poses);
        ASSERT_EQ(views.slots(), 6);
        ASSERT_EQ(poses.size(), 6);
        EXPECT_EQ(views.kind[3], BodyKind::hole);
        for (const BodyId id : world.bodies()) {
            const std::size_t i = id.index;
            EXPECT_EQ(views.id(i), id);
            EXPECT_EQ(views.kind[i] == BodyKind::fixed, world.isFixed(id));
            EXPECT_EQ(views.centre_of_mass[i], world.centreOfMass(id));
            EXPECT_EQ(views.principal_axes[i].coeffs(), world.principalAxes(id).coeffs());
            EXPECT_EQ(views.linear_velocity[i], world.linearVelocity(id));
            EXPECT_EQ(views.angular_velocity[i], world.angularVelocity(id));
            EXPECT_EQ(views.asleep[i] == 1, world.isAsleep(id));
            EXPECT_EQ(poses[i].position, world.pose(id).position);
            EXPECT_EQ(poses[i].orientation.coeffs(), world.pose(id).orientation.coeffs());
            if (!world.isFixed(id)) {
                EXPECT_EQ(views.mass[i], world.mass(id));
            }
        }
    }
    const std::span<const Vec3> span = views.centre_of_mass;
    EXPECT_EQ(span.data(), world.bodyViews().centre_of_mass.data()) << "no copy";
}

TEST(BodyViews, CanBeReadWhenTheBodiesAreKeptElsewhereAndWhenTheWorldIsGone) {
    std::optional<TwoSpheres> two(std::in_place);
    const std::vector<std::byte> snapshot = two->world.save();
    const BodyViews first = two->world.bodyViews();
    two->world.setPose(two->ids[1], {Vec3(0, 0, 5), Quat::Identity()});
    EXPECT_EQ(first.centre_of_mass[1].z(), 5) << "it follows the world";
    for (int i = 0; i < 1000; ++i) two->world.addBody({.pose = {Vec3(i, 9, 9), Quat::Identity()}});
    const BodyViews second = two->world.bodyViews();
    EXPECT_EQ(first.slots(), 3);
    EXPECT_EQ(second.slots(), 1003);
    two->world.load(snapshot);
    two->world.step();
    EXPECT_EQ(second.centre_of_mass[1].z(), 5) << "what was loaded is none of its numbers";
    EXPECT_NEAR(two->world.bodyViews().centre_of_mass[1].z(), 1, 1e-3);
    two.reset();
    EXPECT_EQ(first.centre_of_mass[1].z(), 5);
    EXPECT_EQ(second.centre_of_mass[1002].x(), 999);
}

TEST(BodyViews, TheLayoutVersionChangesWithBodiesAndLoadedStatesOnly) {
    TwoSpheres two;
    World& world = two.world;
    std::uint64_t version = world.layoutVersion();
    const auto changes = [&] {
        const std::uint64_t before = std::exchange(version, world.layoutVersion());
        return before != version;
    };
    world.setPose(two.ids[1], {Vec3(0, 0, 5), Quat::Identity()});
    world.setFixed(two.ids[1], true);
    world.step();
    EXPECT_FALSE(changes());
    RollbackState moment;
    world.keep(moment);
    const std::vector<std::byte> snapshot = world.save();
    world.step();
    world.load(moment);
    EXPECT_FALSE(changes()) << "the bodies are where they were";
    world.load(snapshot);
    EXPECT_TRUE(changes());
    const BodyId third = world.addBody({.pose = {Vec3(0, 9, 9), Quat::Identity()}});
    EXPECT_TRUE(changes());
    world.removeBody(third);
    EXPECT_TRUE(changes());
    world.load(moment);
    EXPECT_TRUE(changes());
}

TEST(ManyBodies, AreWrittenAsOneByOneWouldBe) {
    TwoSpheres one;
    TwoSpheres many;
    const std::vector<BodyId> ids{one.ids[1], one.ids[2]};
    const std::vector<Vec3> values{Vec3(1, 2, 3), Vec3(-3, 0.5, 0)};
    const std::vector<Pose> poses{{Vec3(0, 0, 3), Quat(2, 0, 0, 1)}, {Vec3(4, 0, 3), Quat(1, 1, 1, 1)}};
    for (std::size_t k = 0; k < ids.size(); ++k) {
        one.world.setPose(ids[k], poses[k]);
        one.world.setLinearVelocity(ids[k], values[k]);
        one.world.setAngularVelocity(ids[k], values[k]);
        one.world.applyForce(ids[k], values[k]);
        one.world.applyTorque(ids[k], values[k]);
        one.world.applyImpulse(ids[k], values[k]);
        one.world.applyAngularImpulse(ids[k], values[k]);
        one.world.setConstantForce(ids[k], values[k]);
        one.world.setConstantTorque(ids[k], values[k]);
    }
    many.world.setPoses(ids, poses);
    many.world.setLinearVelocities(ids, values);
    many.world.setAngularVelocities(ids, values);
    many.world.applyForces(ids, values);
    many.world.applyTorques(ids, values);
    many.world.applyImpulses(ids, values);
    many.world.applyAngularImpulses(ids, values);
    many.world.setConstantForces(ids, values);
    many.world.setConstantTorques(ids, values);
    EXPECT_EQ(one.world.save(), many.world.save());
    EXPECT_FALSE(many.world.isAsleep(ids[0]));
}

TEST(ManyBodies, AreAllWrittenOrNone) {
    TwoSpheres two;
    World& world = two.world;
    const std::vector<std::byte> before = world.save();
    const std::vector<BodyId> ids{two.ids[1], two.ids[2]};
    const std::vector<Vec3> fine(2, Vec3::Ones());
    const std::vector<Vec3> bad{Vec3::Ones(), Vec3(0, std::nan(""), 0)};
    EXPECT_THROW(world.setLinearVelocities(ids, bad), InputError);
    EXPECT_THROW(world.applyForces(ids, bad), InputError);
    EXPECT_THROW(world.setConstantTorques(ids, bad), InputError);
    EXPECT_THROW(world.setPoses(ids, std::vector<Pose>{{}, {Vec3::Zero(), Quat(0, 0, 0, 0)}}), InputError);
    EXPECT_THROW(world.setPoses(ids, std::vector<Pose>(1)), InputError);
    EXPECT_THROW(world.applyImpulses(ids, std::span(fine).first(1)), InputError);
    const std::vector<BodyId> with_ground{two.ids[1], two.ids[0]};
    EXPECT_THROW(world.applyImpulses(with_ground, fine), InputError);
    const std::vector<BodyId> with_stranger{two.ids[1], BodyId{7, 0}};
    EXPECT_THROW(world.applyAngularImpulses(with_stranger, fine), StaleIdError);
    EXPECT_THROW(world.wake(with_stranger), StaleIdError);
    EXPECT_EQ(world.save(), before);
    world.wake(ids);
    EXPECT_FALSE(world.isAsleep(ids[1]));
}

TEST(ManyBodies, ContactsComeIntoMemoryThatIsUsedAgain) {
    const Scene scene = builtInScene("tower:5");
    SceneRun run(scene, settingsFor(scene));
    run.step();
    std::vector<ContactInfo> contacts;
    run.world().contactsTo(contacts);
    const auto* const memory = contacts.data();
    run.step();
    run.world().contactsTo(contacts);
    EXPECT_EQ(contacts.data(), memory);
    const std::vector<ContactInfo> again = run.world().contacts();
    ASSERT_EQ(contacts.size(), again.size());
    ASSERT_FALSE(contacts.empty());
    for (std::size_t i = 0; i < again.size(); ++i) {
        EXPECT_EQ(contacts[i].b, again[i].b);
        EXPECT_EQ(contacts[i].impulse, again[i].impulse);
    }
}

}  // namespace
}  // namespace cairn
