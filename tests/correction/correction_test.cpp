#include "correction/correction.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "correction/contact_scene.h"
#include "correction/random_scene.h"

namespace cairn::test {
namespace {

TEST(PropagatedCorrection, LeavesContactsDownToTheThreshold) {
    ContactScene scene;
    scene.settings.penetration_threshold = 0.125;
    const BodyIndex x = scene.addBody();
    const BodyIndex ground = scene.addFixed();
    scene.touch(x, ground, up, -0.125);
    EXPECT_EQ(scene.correct().penetrating, 0);
    EXPECT_EQ(scene.position[x], Vec3::Zero());
    scene.contacts[0].distance = std::nextafter(-0.125, -1);
    EXPECT_EQ(scene.correct().penetrating, 1);
    EXPECT_GT(scene.position[x].z(), 0.0624);
}

/// Two bodies too large for the room between two walls: whichever is moved, it is pushed into a wall.
ContactScene wedgedBodies() {
    ContactScene scene;
    scene.settings.penetration_threshold = 1;
    const BodyIndex left_wall = scene.addFixed();
    const BodyIndex a = scene.addBody();
    const BodyIndex b = scene.addBody();
    const BodyIndex right_wall = scene.addFixed();
    scene.touch(a, left_wall, right, -0.5);
    scene.touch(b, a, right, -8);
    scene.touch(right_wall, b, right, -0.5);
    return scene;
}

TEST(PropagatedCorrection, LeavesWhatNoCandidateCorrectsAsItIs) {
    ContactScene scene = wedgedBodies();
    const CorrectionCounts counts = scene.correct();
    EXPECT_EQ(counts.uncorrected, 1);
    EXPECT_EQ(counts.displaced, 0);
    EXPECT_EQ(scene.contacts[1].distance, -8);
}

TEST(PropagatedCorrection, WakesTheBodiesItMovesAndNoOthers_WakeCondition2) {
    ContactScene scene;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex lower = scene.addBody();
    const BodyIndex upper = scene.addBody();
    const BodyIndex beside = scene.addBody();
    const BodyIndex awake = scene.addBody();
    scene.touch(lower, ground, up, -0.1);
    scene.touch(upper, lower, up, 0);
    scene.touch(beside, lower, right, 0);
    scene.touch(awake, upper, up, 0);
    for (const BodyIndex body : {lower, upper, beside}) scene.asleep[body] = 1;
    EXPECT_EQ(scene.correct().displaced, 3);
    for (const BodyIndex body : {lower, upper}) {
        EXPECT_EQ(scene.asleep[body], 0);
        EXPECT_EQ(scene.woken[body], WakeReason::displaced);
    }
    EXPECT_EQ(scene.asleep[beside], 1);
    EXPECT_EQ(scene.woken[beside], WakeReason::none);
    EXPECT_EQ(scene.asleep[awake], 0);
    EXPECT_EQ(scene.woken[awake], WakeReason::none);  // it did not wake, it was awake
    EXPECT_NEAR(scene.position[awake].z(), 0.1, 1e-8);
}

TEST(PropagatedCorrection, ASleepingBodyPassesThePushOnLikeAnyOther) {
    for (const bool asleep : {false, true}) {
        ContactScene scene;
        const BodyIndex ground = scene.addFixed();
        BodyIndex last = ground;
        for (int i = 0; i < 3; ++i) {
            const BodyIndex next = scene.addBody();
            scene.asleep[next] = asleep ? 1 : 0;
            scene.touch(next, last, up, i == 0 ? -0.25 : 0);
            last = next;
        }
        EXPECT_EQ(scene.correct().displaced, 3);
        EXPECT_NEAR(scene.position[last].z(), 0.25, 1e-8);
    }
}

TEST(PropagatedCorrection, AnUnresolvedContactCountsAsCorrectedIfAnotherCorrectionFreesIt) {
    ContactScene scene;
    const BodyIndex fixed = scene.addFixed();
    const BodyIndex x = scene.addBody();
    const auto slope = scene.touch(x, fixed, {0.6, 0, 0.8}, -0.125);  // its normal leads into the wall
    scene.touch(x, fixed, -right, 0);
    scene.touch(x, fixed, up, -0.25);
    const CorrectionCounts counts = scene.correct();
    EXPECT_EQ(counts.penetrating, 2);
    EXPECT_EQ(counts.corrected, 2);
    EXPECT_EQ(counts.uncorrected, 0);
    EXPECT_EQ(counts.displaced, 1);
    EXPECT_TRUE(near(scene.position[x], {0, 0, 0.25}, 1e-8));
    EXPECT_NEAR(scene.contacts[slope].distance, 0.075, 1e-8);
}

TEST(PropagatedCorrection, WorksThroughThePenetratingContactsInAscendingOrder) {
    // Either contact, corrected first, takes the other one along; the order decides the direction of the move.
    for (const bool slope_first : {true, false}) {
        ContactScene scene;
        const BodyIndex fixed = scene.addFixed();
        const BodyIndex x = scene.addBody();
        if (slope_first) scene.touch(x, fixed, {0.6, 0, 0.8}, -0.125);
        scene.touch(x, fixed, up, -0.0625);
        if (!slope_first) scene.touch(x, fixed, {0.6, 0, 0.8}, -0.03125);
        EXPECT_EQ(scene.correct().displaced, 1);
        EXPECT_NEAR(scene.position[x].x(), slope_first ? 0.075 : 0, 1e-8);
    }
}

TEST(PropagatedCorrection, NeverMovesFixedBodies) {
    int beside_moved_ones = 0;
    for (std::uint64_t seed = 0; seed < 5000; ++seed) {
        ContactScene scene = randomScene(seed);
        for (BodyIndex i = 0; i < scene.kind.size(); ++i) {
            if (scene.kind[i] == BodyKind::fixed) scene.linear_step[i] = scene.v[i] = Vec3(1, -1, 1);
        }
        const FieldArray<Vec3> before = scene.position;
        scene.correct();
        for (BodyIndex i = 0; i < scene.kind.size(); ++i) {
            if (scene.kind[i] != BodyKind::fixed) continue;
            ASSERT_EQ(scene.position[i], before[i]) << "seed " << seed;
            if (scene.position != before) ++beside_moved_ones;
        }
    }
    EXPECT_GT(beside_moved_ones, 1000);
}

TEST(PropagatedCorrection, CorrectsOnlyTheContactsOfItsBatch) {
    ContactScene scene;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex x = scene.addBody();
    const BodyIndex y = scene.addBody();
    scene.touch(x, ground, up, -0.25);
    scene.touch(y, ground, up, -0.25);
    const std::vector<BodyIndex> bodies{y};
    const std::vector<std::uint32_t> indices{1};
    const CorrectionCounts counts =
        makeCorrection(CorrectionKind::propagated)
            ->correct({bodies, indices}, scene.contactsOfBodies(), scene.contacts, scene.state(), scene.remaining_part);
    EXPECT_EQ(counts.penetrating, 1);
    EXPECT_EQ(scene.position[x], Vec3::Zero());
    EXPECT_NEAR(scene.position[y].z(), 0.25, 1e-8);
    EXPECT_EQ(scene.contacts[0].distance, -0.25);
}

TEST(PropagatedCorrection, DoesNothingWithoutContacts) {
    ContactScene scene;
    EXPECT_EQ(scene.correct().penetrating, 0);
    scene.addBody();
    EXPECT_EQ(scene.correct().displaced, 0);
}

TEST(PropagatedCorrection, CanServeALargerWorldAfterASmallerOne) {
    const auto correction = makeCorrection(CorrectionKind::propagated);
    for (const int height : {1, 50, 3, 200}) {
        ContactScene scene;
        BodyIndex last = scene.addFixed();
        for (int i = 0; i < height; ++i) {
            const BodyIndex next = scene.addBody();
            scene.touch(next, last, up, i == 0 ? -0.25 : 0);
            last = next;
        }
        EXPECT_EQ(scene.correctWith(*correction).displaced, height);
        EXPECT_NEAR(scene.position[last].z(), 0.25, 1e-6);
    }
}

TEST(PropagatedCorrection, EndsAndMovesNothingToInfinityWhateverItIsGiven) {
    const double inf = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    int corrected = 0;
    for (std::uint64_t seed = 0; seed < 5000; ++seed) {
        ContactScene scene = randomScene(seed);
        if (scene.contacts.empty()) continue;
        Random random(seed);
        const double bad = std::array{inf, -inf, nan, 1e308, -1e308}[random.below(5)];
        Contact& contact = scene.contacts[random.below(scene.contacts.size())];
        const std::size_t body = random.below(scene.kind.size());
        switch (random.below(5)) {
            case 0:
                contact.distance = bad;
                break;
            case 1:
                contact.normal[random.below(3)] = bad;
                break;
            case 2:
                contact.point[random.below(3)] = bad;
                break;
            case 3:
                scene.linear_step[body][random.below(3)] = bad;
                break;
            default:
                scene.v[body][random.below(3)] = bad;
                break;
        }
        const CorrectionCounts counts = scene.correct();
        EXPECT_EQ(counts.penetrating, counts.corrected + counts.uncorrected);
        for (const Vec3& position : scene.position) ASSERT_TRUE(position.allFinite()) << "seed " << seed;
        if (counts.corrected > 0) ++corrected;
    }
    EXPECT_GT(corrected, 1000);
}

TEST(NoCorrection, CountsWhatItLeaves) {
    ContactScene scene;
    scene.settings.penetration_threshold = 0.125;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex x = scene.addBody();
    scene.asleep[x] = 1;
    scene.touch(x, ground, up, -0.25);
    scene.touch(x, ground, up, -0.125);
    const CorrectionCounts counts = scene.correctWith(*makeCorrection(CorrectionKind::none));
    EXPECT_EQ(counts.penetrating, 1);
    EXPECT_EQ(counts.corrected, 0);
    EXPECT_EQ(counts.uncorrected, 1);
    EXPECT_EQ(counts.displaced, 0);
    EXPECT_EQ(scene.position[x], Vec3::Zero());
    EXPECT_EQ(scene.contacts[0].distance, -0.25);
    EXPECT_EQ(scene.asleep[x], 1);
}

TEST(MakeCorrection, RefusesAKindThatDoesNotExist) {
    EXPECT_THROW(makeCorrection(static_cast<CorrectionKind>(7)), InputError);
}

}  // namespace
}  // namespace cairn::test
