#include "correction/propagation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "correction/contact_scene.h"

namespace cairn::test {
namespace {

constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();
constexpr BodyIndex nobody = 1000;

/// Bodies pushed by the displacement of one of them.
struct Pushing : ContactScene {
    Propagation search;
    PushGraph graph;

    PropagationOutcome push(BodyIndex body, const Vec3& displacement, std::size_t limit = no_limit,
                            BodyIndex other = nobody) {
        const ContactsOfBodies table = contactsOfBodies();
        const BodyState bodies = state();
        const std::vector<BodyIndex> moving = movingBodies();
        bodies.writePlaces(moving);
        search.begin(bodies.place, moving.size());
        graph.reset({moving, {}}, table, contacts, bodies, remaining_part);
        return search.run({body, other, CandidateKind::normal, displacement}, graph, limit);
    }
    Vec3 displacementOf(BodyIndex body) const { return search.share(body) * search.displacement(); }
    std::vector<BodyIndex> moved() const {
        std::vector<BodyIndex> bodies(search.moved().begin(), search.moved().end());
        std::sort(bodies.begin(), bodies.end());
        return bodies;
    }
};

TEST(Propagation, PushesOnlyBodiesItMovesTowards_Eq2_3_4) {
    Pushing world;
    world.settings.penetration_threshold = 0;
    const BodyIndex x = world.addBody();
    const BodyIndex ahead = world.addBody();
    const BodyIndex behind = world.addBody();
    const BodyIndex beside = world.addBody();
    world.touch(ahead, x, Vec3::UnitX(), -0.5);
    world.touch(behind, x, -Vec3::UnitX(), -0.5);
    world.touch(beside, x, Vec3::UnitY(), -0.5);
    ASSERT_EQ(world.push(x, {0.25, 0, 0}), PropagationOutcome::valid);
    EXPECT_EQ(world.moved(), (std::vector{x, ahead}));
    EXPECT_EQ(world.displacementOf(ahead), Vec3(0.25, 0, 0));
    EXPECT_EQ(world.search.share(behind), 0);
}

TEST(Propagation, WorksTheSameForBothBodiesOfAContact) {
    for (const bool lower_slot_pushes : {true, false}) {
        Pushing world;
        world.settings.penetration_threshold = 0;
        const BodyIndex first = world.addBody();
        const BodyIndex second = world.addBody();
        const BodyIndex x = lower_slot_pushes ? first : second;
        const BodyIndex y = lower_slot_pushes ? second : first;
        world.touch(y, x, Vec3::UnitZ(), 0);
        ASSERT_EQ(world.push(x, {0, 0, 1}), PropagationOutcome::valid);
        EXPECT_EQ(world.search.share(y), 1);
        ASSERT_EQ(world.push(x, {0, 0, -1}), PropagationOutcome::valid);
        EXPECT_EQ(world.search.share(y), 0);
    }
}

TEST(Propagation, AGapTakesItsPartOfTheDisplacement_Eq2_3_5_Eq2_3_6) {
    Pushing world;
    world.settings.penetration_threshold = 0;
    const BodyIndex x = world.addBody();
    const BodyIndex y = world.addBody();
    world.touch(y, x, Vec3(0.6, 0.8, 0), 0.25);
    ASSERT_EQ(world.push(x, {0, 0.3125, 0}), PropagationOutcome::valid);  // s = 0.25 is not larger than the gap
    EXPECT_EQ(world.moved(), (std::vector{x}));
    ASSERT_EQ(world.push(x, {0, 1.25, 0}), PropagationOutcome::valid);  // s = 1
    EXPECT_TRUE(near(world.displacementOf(y), {0, 0.75 * 1.25, 0}, 1e-15));
}

TEST(Propagation, TheGapIsMeasuredFromTheRemainingPenetration_Eq2_5_5_Eq2_5_6) {
    Pushing world;
    world.settings.penetration_threshold = 0.5;
    world.remaining_part = 0.5;  // contacts may be pushed down to −0.25
    const BodyIndex x = world.addBody();
    const BodyIndex y = world.addBody();
    world.touch(y, x, Vec3::UnitX(), 0);
    ASSERT_EQ(world.push(x, {0.25, 0, 0}), PropagationOutcome::valid);
    EXPECT_EQ(world.moved(), (std::vector{x}));
    ASSERT_EQ(world.push(x, {1, 0, 0}), PropagationOutcome::valid);
    EXPECT_EQ(world.displacementOf(y), Vec3(0.75, 0, 0));
    world.contacts[0].distance = -0.375;  // deeper than may remain: it must not get deeper, and is not corrected here
    ASSERT_EQ(world.push(x, {0.0625, 0, 0}), PropagationOutcome::valid);
    EXPECT_EQ(world.displacementOf(y), Vec3(0.0625, 0, 0));
}

TEST(Propagation, TheLongestDisplacementCountsOnWhicheverWayItComes) {
    for (const bool direct_contact_first : {true, false}) {
        Pushing world;
        world.settings.penetration_threshold = 0;
        const BodyIndex x = world.addBody();
        const BodyIndex between = world.addBody();
        const BodyIndex y = world.addBody();
        const BodyIndex after = world.addBody();
        const auto direct = [&] { world.touch(y, x, Vec3::UnitX(), 0.5); };
        if (direct_contact_first) direct();
        world.touch(between, x, Vec3::UnitX(), 0.125);
        world.touch(y, between, Vec3::UnitX(), 0.125);
        if (!direct_contact_first) direct();
        world.touch(after, y, Vec3::UnitX(), 0.25);
        ASSERT_EQ(world.push(x, {1, 0, 0}), PropagationOutcome::valid);
        EXPECT_EQ(world.displacementOf(between).x(), 0.875);
        EXPECT_EQ(world.displacementOf(y).x(), 0.75);  // 0.5 straight on
        EXPECT_EQ(world.displacementOf(after).x(), 0.5);
        EXPECT_EQ(world.search.moved().size(), 4U);
    }
}

TEST(Propagation, IsInvalidIfAFixedBodyIsPushed) {
    Pushing world;
    const BodyIndex x = world.addBody();
    const BodyIndex y = world.addBody();
    const BodyIndex wall = world.addFixed();
    world.touch(y, x, Vec3::UnitX(), 0);
    world.touch(wall, y, Vec3::UnitX(), 0.5);
    EXPECT_EQ(world.push(x, {0.75, 0, 0}), PropagationOutcome::invalid);
    EXPECT_EQ(world.push(x, {0.25, 0, 0}), PropagationOutcome::valid);
    EXPECT_EQ(world.push(x, {-0.75, 0, 0}), PropagationOutcome::valid);
}

TEST(Propagation, IsInvalidIfTheOtherBodyOfTheFirstContactIsPushed) {
    Pushing world;
    const BodyIndex x = world.addBody();
    const BodyIndex y = world.addBody();
    const BodyIndex z = world.addBody();
    world.touch(y, x, Vec3::UnitX(), 0);
    world.touch(z, y, Vec3::UnitX(), 0.5);
    EXPECT_EQ(world.push(x, {0.75, 0, 0}, no_limit, z), PropagationOutcome::invalid);
    EXPECT_EQ(world.push(x, {0.25, 0, 0}, no_limit, z), PropagationOutcome::valid);
    EXPECT_EQ(world.push(x, {0.75, 0, 0}, no_limit, nobody), PropagationOutcome::valid);
}

TEST(Propagation, GoesAroundRingsOnce) {
    Pushing world;
    const Vec3 half(0.5, std::sqrt(0.75), 0);
    const BodyIndex first = world.addBody();
    for (int i = 0; i < 4; ++i) world.addBody();
    for (BodyIndex i = 0; i < 5; ++i) world.touch((i + 1) % 5, first + i, i == 4 ? half : Vec3(Vec3::UnitX()), 0);
    ASSERT_EQ(world.push(first, {0.5, 0.25, 0}), PropagationOutcome::valid);
    EXPECT_EQ(world.search.moved().size(), 5U);
    for (BodyIndex i = 0; i < 5; ++i) EXPECT_NEAR(world.search.share(i), 1, 1e-8);
}

TEST(Propagation, IsAbandonedWhenItMovesMoreBodiesThanAllowed) {
    Pushing world;
    for (BodyIndex i = 0; i < 5; ++i) world.addBody();
    for (BodyIndex i = 0; i < 4; ++i) world.touch(i + 1, i, Vec3::UnitX(), 0);
    EXPECT_EQ(world.push(0, {1, 0, 0}, 5), PropagationOutcome::valid);
    EXPECT_EQ(world.push(0, {1, 0, 0}, 4), PropagationOutcome::abandoned);
    EXPECT_EQ(world.search.moved().size(), 5U);
    EXPECT_EQ(world.push(0, {1, 0, 0}, 2), PropagationOutcome::abandoned);
    EXPECT_EQ(world.search.moved().size(), 3U);
    EXPECT_EQ(world.push(0, {1, 0, 0}, 0), PropagationOutcome::abandoned);
    EXPECT_TRUE(world.search.moved().empty());
}

TEST(Propagation, ForgetsTheSearchBefore) {
    Pushing world;
    const BodyIndex x = world.addBody();
    const BodyIndex y = world.addBody();
    world.touch(y, x, Vec3::UnitX(), 0);
    ASSERT_EQ(world.push(x, {1, 0, 0}), PropagationOutcome::valid);
    ASSERT_EQ(world.push(x, {-1, 0, 0}), PropagationOutcome::valid);
    EXPECT_EQ(world.moved(), (std::vector{x}));
    EXPECT_EQ(world.search.share(y), 0);
}

TEST(Propagation, NothingTravelsThroughWhatIsNotANumber) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Pushing world;
    const BodyIndex x = world.addBody();
    const BodyIndex y = world.addBody();
    world.touch(y, x, Vec3::UnitX(), nan);
    EXPECT_EQ(world.push(x, {1, 0, 0}), PropagationOutcome::valid);
    EXPECT_EQ(world.moved(), (std::vector{x}));
    world.contacts[0].distance = 0;
    world.contacts[0].normal.y() = nan;
    EXPECT_EQ(world.push(x, {1, 0, 0}), PropagationOutcome::valid);
    EXPECT_EQ(world.moved(), (std::vector{x}));
    world.contacts[0].normal.y() = 0;
    EXPECT_EQ(world.push(x, {nan, 0, 0}), PropagationOutcome::valid);
    EXPECT_EQ(world.moved(), (std::vector{x}));
}

}  // namespace
}  // namespace cairn::test
