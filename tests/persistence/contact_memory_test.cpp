#include "persistence/contact_memory.h"

#include <gtest/gtest.h>

#include <vector>

namespace cairn {
namespace {

const Executor one_thread(1);
const std::vector<std::uint8_t> all_moved(2000, 0);

/// Three bodies of radius 1 at (0, 0, 0), (2, 0, 0) and (4, 0, 0).
BodyStorage threeBodies() {
    BodyStorage bodies;
    for (int i = 0; i < 3; ++i) {
        const BodyIndex b = bodies.allocate(BodyKind::dynamic);
        bodies.r_max[b] = 1;
        bodies.position[b] = Vec3(2.0 * i, 0, 0);
    }
    return bodies;
}

Contact contactAt(BodyIndex a, BodyIndex b, const Vec3& point, const Vec3& impulse = Vec3::Zero()) {
    return {.a = a, .b = b, .point = point, .impulse = impulse};
}

TEST(ContactMemory, ANewContactHasNoImpulse) {
    const BodyStorage bodies = threeBodies();
    std::vector<Contact> contacts = {contactAt(0, 1, Vec3(1, 0, 0))};
    contacts[0].last_impulse = Vec3::Ones();
    ContactMemory memory;
    memory.recall(bodies, all_moved, contacts, one_thread);
    EXPECT_EQ(contacts[0].last_impulse, Vec3::Zero());
}

TEST(ContactMemory, ContactsAreRecognisedByTheirPlaceAlsoOnTurnedAndMovedBodies) {
    BodyStorage bodies = threeBodies();
    ContactMemory memory;
    memory.store(
        bodies, all_moved,
        std::vector{contactAt(0, 1, Vec3(1, 0.3, 0), Vec3(1, 0, 0)), contactAt(0, 1, Vec3(1, -0.3, 0), Vec3(2, 0, 0)),
                    contactAt(1, 2, Vec3(3, 0, 0), Vec3(3, 0, 0))},
        one_thread);
    const Quat half_turn(Eigen::AngleAxisd(3.14159265358979, Vec3::UnitX()));
    for (BodyIndex b = 0; b < 3; ++b) {
        bodies.orientation[b] = half_turn;
        bodies.position[b] += Vec3(0, 0, 5);
    }
    std::vector<Contact> now = {contactAt(0, 1, Vec3(1, -0.3, 5)), contactAt(0, 1, Vec3(1, 0.3, 5)),
                                contactAt(1, 2, Vec3(3, 0, 5))};
    memory.recall(bodies, all_moved, now, one_thread);
    EXPECT_EQ(now[0].last_impulse.x(), 1);
    EXPECT_EQ(now[1].last_impulse.x(), 2);
    EXPECT_EQ(now[2].last_impulse.x(), 3);
}

TEST(ContactMemory, ContactsThatAreKnownKeepTheImpulsesThatTheyHave) {
    const BodyStorage bodies = threeBodies();
    ContactMemory memory;
    const std::vector last = {contactAt(0, 1, Vec3(1, 0.3, 0), Vec3(1, 0, 0)),
                              contactAt(0, 1, Vec3(1, -0.3, 0), Vec3(2, 0, 0)),
                              contactAt(1, 2, Vec3(3, 0, 0), Vec3(3, 0, 0))};
    memory.store(bodies, all_moved, last, one_thread);
    std::vector<Contact> now = last;
    for (Contact& contact : now) contact.last_impulse = Vec3(0, 7, 0);
    memory.recall(bodies, std::vector<std::uint8_t>{1, 1, 0}, now, one_thread);
    EXPECT_EQ(now[0].last_impulse, Vec3(0, 7, 0));
    EXPECT_EQ(now[1].last_impulse, Vec3(0, 7, 0));
    EXPECT_EQ(now[2].last_impulse, last[2].impulse);
}

TEST(ContactMemory, BodiesThatStayedHaveTheirLatestImpulsesRemembered) {
    BodyStorage bodies = threeBodies();
    ContactMemory memory;
    std::vector contacts = {contactAt(0, 1, Vec3(1, 0, 0), Vec3(1, 0, 0)),
                            contactAt(1, 2, Vec3(3, 0, 0), Vec3(2, 0, 0))};
    memory.store(bodies, all_moved, contacts, one_thread);
    const std::vector<std::uint8_t> still = {1, 1, 1};
    memory.recall(bodies, still, contacts, one_thread);
    contacts[0].impulse.x() = 3;
    contacts[1].impulse.x() = 4;
    // The last body was displaced after it had been found where it was.
    bodies.position[2].y() += 0.3;
    memory.store(bodies, std::vector<std::uint8_t>{1, 1, 0}, contacts, one_thread);
    for (BodyIndex b = 0; b < 3; ++b) bodies.position[b].z() += 5;
    std::vector<Contact> now = {contactAt(0, 1, Vec3(1, 0, 5)), contactAt(1, 2, Vec3(3, 0, 5))};
    memory.recall(bodies, all_moved, now, one_thread);
    EXPECT_EQ(now[0].last_impulse.x(), 3);
    EXPECT_EQ(now[1].last_impulse.x(), 4);
}

TEST(ContactMemory, AnImpulseIsNeverGivenTwiceAndMergedPointsKeepTheSum) {
    const BodyStorage bodies = threeBodies();
    ContactMemory memory;
    memory.store(bodies, all_moved, std::vector{contactAt(0, 1, Vec3(1, 0, 0), Vec3(1, 0, 0))}, one_thread);
    std::vector<Contact> split = {contactAt(0, 1, Vec3(1, 0.01, 0)), contactAt(0, 1, Vec3(1, -0.02, 0))};
    memory.recall(bodies, all_moved, split, one_thread);
    EXPECT_EQ(split[0].last_impulse.x() + split[1].last_impulse.x(), 1);
    split[0].impulse = Vec3(4, 0, 0);
    split[1].impulse = Vec3(5, 0, 0);
    memory.store(bodies, all_moved, split, one_thread);
    std::vector<Contact> merged = {contactAt(0, 1, Vec3(1, 0, 0))};
    memory.recall(bodies, all_moved, merged, one_thread);
    EXPECT_EQ(merged[0].last_impulse.x(), 9);
}

TEST(ContactMemory, FarPointsAndForgottenBodiesGiveNothing) {
    const BodyStorage bodies = threeBodies();
    ContactMemory memory;
    memory.store(
        bodies, all_moved,
        std::vector{contactAt(0, 1, Vec3(1, 0, 0), Vec3(1, 0, 0)), contactAt(1, 2, Vec3(3, 0, 0), Vec3(1, 0, 0))},
        one_thread);
    std::vector<Contact> far = {contactAt(0, 1, Vec3(1, 0.5, 0))};
    memory.recall(bodies, all_moved, far, one_thread);
    EXPECT_EQ(far[0].last_impulse, Vec3::Zero());
    memory.forget(0);
    std::vector<Contact> now = {contactAt(0, 1, Vec3(1, 0, 0)), contactAt(1, 2, Vec3(3, 0, 0))};
    memory.recall(bodies, all_moved, now, one_thread);
    EXPECT_EQ(now[0].last_impulse, Vec3::Zero());
    EXPECT_EQ(now[1].last_impulse.x(), 1);
}

TEST(ContactMemory, RecallsTheSameOnAnyNumberOfThreads) {
    BodyStorage bodies;
    std::vector<Contact> contacts;
    for (BodyIndex b = 0; b < 2000; ++b) {
        bodies.allocate(BodyKind::dynamic);
        bodies.r_max[b] = 1;
        bodies.position[b] = Vec3(b, 0, 0);
        if (b == 0) continue;
        for (const double y : {-0.3, 0.0, 0.3}) {
            contacts.push_back(contactAt(b - 1, b, Vec3(b - 0.5, y, 0), Vec3(b + y, 0, 0)));
        }
    }
    ContactMemory memory;
    memory.store(bodies, all_moved, contacts, Executor(3));
    for (const int threads : {1, 2, 3, 8}) {
        std::vector<Contact> now = contacts;
        memory.recall(bodies, all_moved, now, Executor(threads));
        for (std::size_t i = 0; i < now.size(); ++i) ASSERT_EQ(now[i].last_impulse, contacts[i].impulse) << i;
    }
}

}  // namespace
}  // namespace cairn
