/// What a world tells of its steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "cairn/world.h"

namespace cairn {
namespace {

/// A world with a floor, in which boxes can be dropped.
struct Floor {
    Floor() : world(Settings::preset(Preset::performance)) {
        oak = world.addMaterial({"oak", 800});
        world.setDefaultPairProperties({.restitution = 0, .static_friction = 0.5, .kinetic_friction = 0.5});
        world.setGravity(Vec3(0, 0, -10));
        ground = world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true});
    }

    BodyId box(double height, bool asleep = false) {
        return world.addBody({.shape = Box{Vec3::Constant(0.1)},
                              .material = oak,
                              .pose = {Vec3(0, 0, height), Quat::Identity()},
                              .asleep = asleep});
    }

    /// Steps until an event of the kind comes. @return it, or none after the limit
    std::vector<Event> stepUntil(EventKind kind, int limit = 2000) {
        for (int i = 0; i < limit; ++i) {
            world.step();
            std::vector<Event> found;
            std::ranges::copy_if(world.events(), std::back_inserter(found),
                                 [&](const Event& event) { return event.kind == kind; });
            if (!found.empty()) return found;
        }
        return {};
    }

    World world;
    MaterialId oak{};
    BodyId ground;
};

TEST(Events, NoneAreCollectedUnlessAskedFor) {
    Floor f;
    f.box(0.049);
    EXPECT_EQ(f.world.eventLevel(), EventLevel::none);
    f.world.step();
    EXPECT_FALSE(f.world.contacts().empty());
    EXPECT_TRUE(f.world.events().empty());
}

TEST(Events, AContactBeginsPersistsAndEndsWithItsImpulse) {
    Floor f;
    f.world.setEventLevel(EventLevel::all);
    const BodyId box = f.box(0.06);
    const auto begun = f.stepUntil(EventKind::contact_begun);
    ASSERT_EQ(begun.size(), 1U);
    EXPECT_EQ(begun[0].a, f.ground);
    EXPECT_EQ(begun[0].b, box);
    EXPECT_EQ(begun[0].contacts, 4U);
    EXPECT_TRUE(begun[0].normal.isApprox(Vec3(0, 0, -1)));
    EXPECT_LT(begun[0].distance, 1e-4);
    Vec3 sum = Vec3::Zero();
    for (const ContactInfo& contact : f.world.contacts()) sum += contact.impulse;
    EXPECT_EQ(begun[0].impulse, sum);
    EXPECT_LT(sum.z(), 0);
    f.world.step();
    ASSERT_FALSE(f.world.events().empty());
    EXPECT_EQ(f.world.events().front().kind, EventKind::contact_persisted);
    f.world.setPose(box, {Vec3(0, 0, 1), Quat::Identity()});
    const auto ended = f.stepUntil(EventKind::contact_ended, 1);
    ASSERT_EQ(ended.size(), 1U);
    EXPECT_EQ(ended[0].b, box);
    EXPECT_EQ(ended[0].contacts, 0U);
}

TEST(Events, ChangesLeaveOutWhatPersists) {
    Floor f;
    f.world.setEventLevel(EventLevel::changes);
    f.box(0.049);
    EXPECT_EQ(f.stepUntil(EventKind::contact_begun, 1).size(), 1U);
    EXPECT_TRUE(f.stepUntil(EventKind::contact_persisted, 20).empty());
}

TEST(Events, ARemovedBodyEndsItsContactsUnderItsOwnName) {
    Floor f;
    f.world.setEventLevel(EventLevel::changes);
    const BodyId first = f.box(0.049);
    f.world.step();
    f.world.removeBody(first);
    const BodyId second = f.box(0.049);
    ASSERT_EQ(second.index, first.index);
    f.world.step();
    ASSERT_EQ(f.world.events().size(), 2U);
    EXPECT_EQ(f.world.events()[0].kind, EventKind::contact_ended);
    EXPECT_EQ(f.world.events()[0].b, first);
    EXPECT_EQ(f.world.events()[1].kind, EventKind::contact_begun);
    EXPECT_EQ(f.world.events()[1].b, second);
}

TEST(Events, SleepAndWakingComeWithTheReason) {
    Floor f;
    f.world.setEventLevel(EventLevel::changes);
    const BodyId box = f.box(0.05);
    const auto slept = f.stepUntil(EventKind::fell_asleep);
    ASSERT_EQ(slept.size(), 1U);
    EXPECT_EQ(slept[0].a, box);
    EXPECT_TRUE(f.world.isAsleep(box));
    EXPECT_TRUE(f.stepUntil(EventKind::fell_asleep, 5).empty()) << "told once";
    f.world.applyImpulse(box, Vec3(0, 0, 1));
    const auto woke = f.stepUntil(EventKind::woke, 1);
    ASSERT_EQ(woke.size(), 1U);
    EXPECT_EQ(woke[0].a, box);
    EXPECT_EQ(woke[0].reason, WakeReason::changed);
}

TEST(Events, TheRemovalOfASupportWakesWithItsReason) {
    Floor f;
    f.world.setEventLevel(EventLevel::changes);
    const BodyId lower = f.box(0.05, true);
    const BodyId upper = f.box(0.15, true);
    f.world.step();
    ASSERT_TRUE(f.world.isAsleep(upper));
    f.world.removeBody(lower);
    const auto woke = f.stepUntil(EventKind::woke, 1);
    ASSERT_EQ(woke.size(), 1U);
    EXPECT_EQ(woke[0].a, upper);
    EXPECT_EQ(woke[0].reason, WakeReason::neighbour_removed);
}

TEST(Events, ABodyFrozenByAFaultIsTold) {
    Floor f;
    f.world.setEventLevel(EventLevel::changes);
    const BodyId box = f.box(3);
    for (int i = 0; i < 30; ++i) f.world.applyImpulse(box, Vec3(1e9, 0, 0));
    const auto frozen = f.stepUntil(EventKind::frozen, 1);
    ASSERT_EQ(frozen.size(), 1U);
    EXPECT_EQ(frozen[0].a, box);
    ASSERT_EQ(f.world.faults().size(), 1U);
    EXPECT_EQ(f.world.faults()[0].step, 1);
    EXPECT_TRUE(f.world.isFixed(box));
    EXPECT_EQ(f.world.pose(box).position, Vec3(0, 0, 3)) << "fixed where it last was";
}

}  // namespace
}  // namespace cairn
