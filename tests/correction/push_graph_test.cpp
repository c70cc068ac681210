#include "correction/push_graph.h"

#include <gtest/gtest.h>

#include "correction/contact_scene.h"

namespace cairn::test {
namespace {

/// Three bodies in a row before a wall, along x; contacts 0, 1 and 2.
struct Row : ContactScene {
    BodyIndex first = addBody();
    BodyIndex second = addBody();
    BodyIndex third = addBody();
    BodyIndex wall = addFixed();
    ContactsOfBodies table;
    std::vector<BodyIndex> moving;
    PushGraph graph;

    Row() {
        settings.penetration_threshold = 0;
        touch(second, first, Vec3::UnitX(), 0);
        touch(third, second, Vec3::UnitX(), 0);
        touch(wall, third, Vec3::UnitX(), 0);
        table = contactsOfBodies();
        reset();
    }
    void reset() {
        moving = movingBodies();
        state().writePlaces(moving);
        graph.reset({moving, {}}, table, contacts, state(), remaining_part);
    }
    /// Remembers the way from every body to the wall.
    void learn() {
        for (const BodyIndex body : {first, second, third}) {
            const auto last = static_cast<std::uint32_t>(graph.linksOf(body).size() - 1);
            graph.rememberWay(body, Vec3::UnitX(), last);
        }
    }
    bool isBlocked(const Vec3& displacement, BodyIndex other = UINT32_MAX) {
        return graph.isBlocked(first, 1, {first, other, CandidateKind::normal, displacement});
    }
};

TEST(PushGraph, FollowsWaysToAFixedBodyOnceTheyAreKnown) {
    Row row;
    EXPECT_FALSE(row.isBlocked({1, 0, 0}));
    row.learn();
    EXPECT_TRUE(row.isBlocked({1, 0, 0}));
}

TEST(PushGraph, FollowsWaysToTheOtherBodyOfTheFirstContact) {
    Row row;
    row.graph.rememberWay(row.first, Vec3::UnitX(), 0);
    row.graph.rememberWay(row.second, Vec3::UnitX(), 1);
    EXPECT_FALSE(row.isBlocked({1, 0, 0}));
    EXPECT_TRUE(row.isBlocked({1, 0, 0}, row.third));
}

TEST(PushGraph, ChecksEveryLinkWithTheDisplacementAtHand) {
    Row row;
    row.contacts[1].distance = 0.5;
    row.learn();
    EXPECT_TRUE(row.isBlocked({1, 0, 0}));
    EXPECT_FALSE(row.isBlocked({0.25, 0, 0}));  // ends in the gap
    EXPECT_FALSE(row.isBlocked({0, 1, 0}));     // slides along
    EXPECT_FALSE(row.isBlocked({-1, 0, 0}));    // leads away
}

TEST(PushGraph, SeesNewDistancesWhenToldOfThem) {
    Row row;
    row.learn();
    ASSERT_TRUE(row.isBlocked({1, 0, 0}));
    row.contacts[0].distance = 2;
    row.graph.distancesChanged(row.first);
    EXPECT_FALSE(row.isBlocked({1, 0, 0}));
}

TEST(PushGraph, ForgetsWaysWithTheirContacts) {
    Row row;
    row.learn();
    ASSERT_TRUE(row.isBlocked({1, 0, 0}));
    row.reset();
    EXPECT_FALSE(row.isBlocked({1, 0, 0}));
}

TEST(PushGraph, DoesNotGoAroundRingsForEver) {
    Row row;
    row.touch(row.first, row.second, Vec3(1, 0, 0), 0);  // as a loop would: the second pushes the first again
    row.table = row.contactsOfBodies();
    row.reset();
    row.graph.rememberWay(row.first, Vec3::UnitX(), 0);
    row.graph.rememberWay(row.second, Vec3::UnitX(), 2);
    EXPECT_FALSE(row.isBlocked({1, 0, 0}));
}

}  // namespace
}  // namespace cairn::test
