/// Springs and joints of removed bodies.
#include <gtest/gtest.h>

#include "cairn/world.h"
#include "world/ties.h"

namespace cairn {
namespace {

/// A chain of boxes in which a ball joint and a spring tie each to the next.
struct Chain {
    Chain() {
        const MaterialId oak = world.addMaterial({"oak", 800});
        for (int i = 0; i < 10; ++i) {
            boxes.push_back(world.addBody({.shape = Box{{0.2, 0.2, 0.2}},
                                           .material = oak,
                                           .pose = {Vec3(i, 0, 0), Quat::Identity()},
                                           .asleep = true}));
            if (i > 0) tie(i - 1, i);
        }
    }
    void tie(int a, int b) {
        world.addJoint({.kind = JointKind::ball, .a = boxes.at(a), .b = boxes.at(b), .anchor = Vec3(a + 0.5, 0, 0)});
        springs.push_back(world.addSpring({.a = boxes.at(a), .b = boxes.at(b), .stiffness = 1, .rest_length = 1}));
    }
    void expectJoints(std::size_t count) {
        EXPECT_EQ(world.joints().size(), count);
        for (const JointId joint : world.joints()) {
            const JointInfo report = world.joint(joint);
            EXPECT_TRUE(world.contains(report.a));
            EXPECT_TRUE(!report.b || world.contains(*report.b));
        }
    }

    World world;
    std::vector<BodyId> boxes;
    std::vector<SpringId> springs;
};

TEST(Ties, GoWithTheirBodies) {
    Chain c;
    c.world.removeBody(c.boxes[3]);
    c.expectJoints(7);
    EXPECT_THROW(c.world.removeSpring(c.springs[2]), StaleIdError);
    EXPECT_THROW(c.world.removeSpring(c.springs[3]), StaleIdError);
    EXPECT_NO_THROW(c.world.removeSpring(c.springs[4]));
    c.world.removeBody(c.boxes[4]);
    c.expectJoints(6);
    c.world.removeBody(c.boxes[9]);
    c.expectJoints(5);
}

TEST(Ties, ThatCameAfterARemovalGoWithTheirBodies) {
    Chain c;
    c.world.removeBody(c.boxes[3]);
    c.tie(2, 4);  // in the slots of those that are gone
    c.expectJoints(8);
    c.world.removeBody(c.boxes[2]);
    c.expectJoints(6);
    EXPECT_THROW(c.world.removeSpring(c.springs.back()), StaleIdError);
}

TEST(Ties, ThatARollbackBroughtBackGoWithTheirBodies) {
    Chain c;
    RollbackState moment;
    c.world.keep(moment);
    c.world.removeBody(c.boxes[3]);
    c.tie(2, 4);
    c.world.removeBody(c.boxes[2]);
    c.world.load(moment);
    c.expectJoints(9);
    c.world.removeBody(c.boxes[3]);
    c.expectJoints(7);
}

TEST(Ties, AreListedByBody) {
    std::vector<Joint> joints(3);
    joints[0] = {.present = true, .a = 2, .b = 0};
    joints[1] = {.present = false, .a = 2, .b = 1};
    joints[2] = {.present = true, .a = 2, .b = Joint::world};
    TiesOfBodies ties;
    ties.list({}, joints, 4);
    EXPECT_EQ(ties.jointsOf(0).size(), 1U);
    EXPECT_EQ(ties.jointsOf(1).size(), 0U);
    ASSERT_EQ(ties.jointsOf(2).size(), 2U);
    EXPECT_EQ(ties.jointsOf(2)[0], 0U);
    EXPECT_EQ(ties.jointsOf(2)[1], 2U);
    EXPECT_EQ(ties.jointsOf(3).size(), 0U);
    EXPECT_TRUE(ties.springsOf(2).empty());
}

}  // namespace
}  // namespace cairn
