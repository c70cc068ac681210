#include "sharing/body_records.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(BodyRecords, TakeAlongAllFields) {
    BodyStorage one;
    BodyStorage other;
    for (BodyStorage* bodies : {&one, &other}) {
        bodies->allocate(BodyKind::fixed);
        bodies->allocate(BodyKind::dynamic);
    }
    one.position[1] = {1, 2, 3};
    one.w[1] = {4, 5, 6};
    one.linear_step[1] = {7, 8, 9};
    one.asleep[1] = 1;
    one.supports[1] = 4;
    one.motion[1] = 0.5;
    one.constant_force[1] = {1, 1, 1};
    one.user_data[1] = 77;
    one.mass[1] = 3;
    one.name[1] = "ball";
    one.shape[1] = Capsule{0.25, 2};
    std::vector<std::byte> message;
    packBody(message, one, 1);
    pack(message, 12);
    Unpacker in(message);
    unpackBody(in, other, 1);
    EXPECT_EQ(in.get<int>(), 12) << "all was read";
    EXPECT_EQ(other.position[1], Vec3(1, 2, 3));
    EXPECT_EQ(other.w[1], Vec3(4, 5, 6));
    EXPECT_EQ(other.linear_step[1], Vec3(7, 8, 9));
    EXPECT_EQ(other.asleep[1], 1);
    EXPECT_EQ(other.supports[1], 4);
    EXPECT_EQ(other.motion[1], 0.5);
    EXPECT_EQ(other.constant_force[1], Vec3(1, 1, 1));
    EXPECT_EQ(other.user_data[1], 77U);
    EXPECT_EQ(other.mass[1], 3);
    EXPECT_EQ(other.name[1], "ball");
    EXPECT_EQ(std::get<Capsule>(other.shape[1]).radius, 0.25);
    EXPECT_EQ(std::get<Capsule>(other.shape[1]).length, 2);
}

TEST(BodyRecords, LeaveShapesOfManyNumbersToTheReceiver) {
    BodyStorage one;
    one.allocate(BodyKind::dynamic);
    one.shape[0] = ConvexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    EXPECT_FALSE(isSent(one.shape[0]));
    EXPECT_TRUE(isSent(Box{}));
    std::vector<std::byte> message;
    packBody(message, one, 0);
    BodyStorage other;
    other.allocate(BodyKind::dynamic);
    other.shape[0] = one.shape[0];
    Unpacker in(message);
    unpackBody(in, other, 0);
    EXPECT_TRUE(in.isAtEnd());
    EXPECT_TRUE(std::holds_alternative<ConvexHull>(other.shape[0]));
}

TEST(BodyRecords, ContactsAreThoseOfSnapshots) {
    Contact contact;
    contact.a = 3;
    contact.b = 7;
    contact.point = {1, 2, 3};
    contact.impulse = {4, 5, 6};
    contact.reference_impulse = {7, 8, 9};
    contact.distance = -0.25;
    std::vector<std::byte> message;
    packContact(message, contact);
    Unpacker in(message);
    const Contact read = unpackContact(in);
    EXPECT_TRUE(in.isAtEnd());
    EXPECT_EQ(read.a, 3U);
    EXPECT_EQ(read.b, 7U);
    EXPECT_EQ(read.point, contact.point);
    EXPECT_EQ(read.impulse, contact.impulse);
    EXPECT_EQ(read.reference_impulse, contact.reference_impulse);
    EXPECT_EQ(read.distance, -0.25);
}

TEST(BodyRecords, JointsSayWhetherTheyBroke) {
    Joint joint;
    joint.present = true;
    joint.free.resize(2);
    Joint broken = joint;
    broken.present = false;
    broken.generation = 1;
    broken.free[1].position = 0.7;
    broken.impulse = {1, 2, 3};
    std::vector<std::byte> message;
    packJoint(message, broken);
    Unpacker in(message);
    unpackJoint(in, joint);
    EXPECT_TRUE(in.isAtEnd());
    EXPECT_FALSE(joint.present);
    EXPECT_EQ(joint.generation, 1U);
    EXPECT_EQ(joint.free[1].position, 0.7);
    EXPECT_EQ(joint.impulse, Vec3(1, 2, 3));
}

}  // namespace
}  // namespace cairn
