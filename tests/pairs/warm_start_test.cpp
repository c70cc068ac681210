#include "pairs/warm_start.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

namespace cairn {
namespace {

/// Two bodies of radius 1 at (0, 0, 0) and (2, 0, 0), where they were detected.
BodyStorage twoBodies() {
    BodyStorage bodies;
    for (int i = 0; i < 2; ++i) {
        const BodyIndex b = bodies.allocate(BodyKind::dynamic);
        bodies.r_max[b] = 1;
        bodies.position[b] = bodies.detected_position[b] = Vec3(2.0 * i, 0, 0);
    }
    return bodies;
}

Contact contactAt(const Vec3& point, const Vec3& impulse) {
    return {.a = 0, .b = 1, .point = point, .last_impulse = impulse, .reference_impulse = 2 * impulse};
}

FoundContact foundAt(const Vec3& point) {
    return {.a = 0, .b = 1, .point = point, .normal = Vec3::UnitX(), .distance = 0};
}

/// Matches the impulses. @return the contacts of before that pushed and have no heir
std::vector<const Contact*> inherit(const BodyStorage& bodies, std::span<const Contact> before,
                                    std::span<FoundContact> now) {
    std::vector<const Contact*> left;
    inheritImpulses(bodies, before, now, left);
    return left;
}

TEST(WarmStart, WhatStaysBeginsWithTheImpulsesOfTheLastStep) {
    for (const WarmStart warm_start : {WarmStart::off, WarmStart::on}) {
        std::vector<Contact> contacts = {
            {.a = 0, .b = 1, .reference_impulse = Vec3(5, 0, 0), .impulse = Vec3(3, 0, -0.0), .gap = 1}};
        beginContacts(contacts, {warm_start}, Executor());
        const bool on = warm_start == WarmStart::on;
        EXPECT_EQ(contacts[0].last_impulse, on ? Vec3(3, 0, 0) : Vec3(0, 0, 0));
        EXPECT_FALSE(std::signbit(contacts[0].last_impulse.z())) << "as what is inherited";
        EXPECT_EQ(contacts[0].reference_impulse, on ? Vec3(5, 0, 0) : Vec3(0, 0, 0));
        EXPECT_EQ(contacts[0].impulse, Vec3(0, 0, 0));
        EXPECT_EQ(contacts[0].gap, 0);
    }
}

TEST(WarmStart, ANewContactHasNoImpulse) {
    std::vector<FoundContact> now = {foundAt(Vec3(1, 0, 0))};
    inherit(twoBodies(), {}, now);
    EXPECT_EQ(now[0].last_impulse, Vec3::Zero());
    EXPECT_EQ(now[0].reference_impulse, Vec3::Zero());
}

TEST(WarmStart, ContactsAreRecognisedByTheirPlaceAlsoOnTurnedAndMovedBodies) {
    BodyStorage bodies = twoBodies();
    const std::vector before = {contactAt(Vec3(1, 0.3, 0), Vec3(1, 0, 0)), contactAt(Vec3(1, -0.3, 0), Vec3(2, 0, 0))};
    const Quat half_turn(Eigen::AngleAxisd(3.14159265358979, Vec3::UnitX()));
    for (BodyIndex b = 0; b < 2; ++b) {
        bodies.orientation[b] = half_turn;
        bodies.position[b] += Vec3(0, 0, 5);
    }
    std::vector<FoundContact> now = {foundAt(Vec3(1, 0.3, 5)), foundAt(Vec3(1, -0.3, 5))};
    inherit(bodies, before, now);
    EXPECT_EQ(now[0].last_impulse.x(), 2);
    EXPECT_EQ(now[1].last_impulse.x(), 1);
    EXPECT_EQ(now[1].reference_impulse.x(), 2);
}

TEST(WarmStart, AnImpulseIsNeverGivenTwiceAndMergedPointsKeepTheSum) {
    const BodyStorage bodies = twoBodies();
    std::vector<FoundContact> split = {foundAt(Vec3(1, 0.01, 0)), foundAt(Vec3(1, -0.02, 0))};
    inherit(bodies, std::vector{contactAt(Vec3(1, 0, 0), Vec3(1, 0, 0))}, split);
    EXPECT_EQ(split[0].last_impulse.x() + split[1].last_impulse.x(), 1);
    std::vector<FoundContact> merged = {foundAt(Vec3(1, 0, 0))};
    inherit(bodies,
            std::vector{contactAt(Vec3(1, 0.01, 0), Vec3(4, 0, 0)), contactAt(Vec3(1, -0.02, 0), Vec3(5, 0, 0))},
            merged);
    EXPECT_EQ(merged[0].last_impulse.x(), 9);
}

TEST(WarmStart, PointsAtOnePlaceAreToldApartByTheirDirections) {
    const BodyStorage bodies = twoBodies();
    std::vector before = {contactAt(Vec3(1, 0, 0), Vec3(1, 0, 0)), contactAt(Vec3(1, 0, 0), Vec3(2, 0, 0))};
    before[1].normal = Vec3::UnitY();
    std::vector<FoundContact> now = {foundAt(Vec3(1, 0, 0)), foundAt(Vec3(1, 0, 0))};
    now[0].normal = Vec3::UnitY();
    inherit(bodies, before, now);
    EXPECT_EQ(now[0].last_impulse.x(), 2);
    EXPECT_EQ(now[1].last_impulse.x(), 1);
}

TEST(WarmStart, FarPointsGiveNothing) {
    const BodyStorage bodies = twoBodies();
    std::vector<FoundContact> far = {foundAt(Vec3(1, 0.5, 0))};
    inherit(bodies, std::vector{contactAt(Vec3(1, 0, 0), Vec3(1, 0, 0))}, far);
    EXPECT_EQ(far[0].last_impulse, Vec3::Zero());
}

TEST(WarmStart, AContactRollsOnWithARoundBody) {
    BodyStorage bodies = twoBodies();
    const Vec3 way(0, 0.5, 0);
    bodies.position[0] += way;
    // Without slip the point of the ball that touched stays there for now.
    bodies.orientation[0] = Quat(Eigen::AngleAxisd(0.5, -Vec3::UnitZ()));
    const std::vector before = {contactAt(Vec3(1, 0, 0), Vec3(3, 0, 0))};
    const auto inherited = [&](const Vec3& point) {
        std::vector<FoundContact> now = {foundAt(point)};
        inherit(bodies, before, now);
        return now[0].last_impulse.x();
    };
    bodies.shape[0] = bodies.shape[1] = Box{Vec3(2, 2, 2)};
    EXPECT_EQ(inherited(Vec3(1, 0, 0) + way), 0) << "flat sides do not roll";
    bodies.shape[0] = Sphere{1};
    EXPECT_EQ(inherited(Vec3(1, 0, 0) + way), 3);
    EXPECT_EQ(inherited(Vec3(1, 0, 0) + 1.5 * way), 0) << "farther than it went";
}

TEST(WarmStart, WhatPushedAndHasNoHeirIsTold) {
    const BodyStorage bodies = twoBodies();
    const std::vector before = {contactAt(Vec3(1, 0, 0), Vec3(1, 0, 0)), contactAt(Vec3(1, 0.5, 0), Vec3(2, 0, 0)),
                                contactAt(Vec3(1, -0.5, 0), Vec3(0, 0, 0))};
    std::vector<FoundContact> now = {foundAt(Vec3(1, 0, 0))};
    EXPECT_EQ(inherit(bodies, before, now), std::vector{&before[1]});
    EXPECT_EQ(inherit(bodies, before, {}), (std::vector{&before[0], &before[1]}));
}

TEST(WarmStart, AContactIsForeseenAgainFromWhereItsBodiesWentBackTo) {
    BodyStorage bodies = twoBodies();
    // A comes from (−0.1, 0, 0.2): it closes by 0.1 and goes down by 0.2 until it touches.
    bodies.position[0] += Vec3(-0.1, 0, 0.2);
    Contact before = contactAt(Vec3(1, 0, 0), Vec3(3, 0, 0));
    before.normal = -Vec3::UnitX();
    before.distance = 0.01;
    const FoundContact again = foreseenAgain(bodies, before, 0.05, 0.5);
    EXPECT_DOUBLE_EQ(again.distance, 0.11);
    EXPECT_DOUBLE_EQ(again.allowed_closing, 0.22);
    EXPECT_EQ(again.allowed_overlap, 0.05);
    EXPECT_TRUE(again.point.isApprox(Vec3(0.95, 0, 0.1))) << "halfway between its places on both bodies";
    EXPECT_TRUE(again.slide.isApprox(Vec3(0, 0, 0.1)));
    EXPECT_EQ(again.last_impulse, before.last_impulse);
    EXPECT_EQ(again.reference_impulse, before.reference_impulse);
}

}  // namespace
}  // namespace cairn
