/// How far bodies go back that got too deep into each other on their ways.
#include "pairs/way_back.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "broad_phase/hash_grids.h"
#include "pairs/pair_table.h"

namespace cairn {
namespace {

constexpr double allowed = 0.03;        ///< [m]
constexpr double most = 1.3 * allowed;  ///< [m] how deep bodies may be in each other after a flight

/// Two balls of radius 1, of which the second may have moved.
struct TwoBalls {
    BodyStorage bodies;
    MaterialTable materials;
    HashGrids broad_phase;
    DetectionRange range{.threshold = allowed, .foresight = {.time = 1e-9}};
    Executor executor;
    PairTable pairs;
    std::vector<Contact> contacts;
    std::vector<BodyWay> ways;
    std::vector<std::uint8_t> jointed;

    TwoBalls() {
        materials.add({.name = "matter", .density = 1});
        add(Vec3::Zero());
    }
    BodyIndex add(const Vec3& position) {
        const BodyIndex i = bodies.allocate(BodyKind::dynamic);
        bodies.shape[i] = Sphere{1};
        bodies.r_max[i] = bodies.r_min[i] = 1;
        bodies.position[i] = position;
        ways.push_back({{position, Quat::Identity()}});
        return i;
    }
    /// A ball that began to fly at one place and is at another now, along x.
    void addOnWay(double begun, double now) {
        const BodyIndex i = add(Vec3(now, 0, 0));
        ways[i].begin.position = Vec3(begun, 0, 0);
        bodies.linear_step[i] = Vec3(now - begun, 0, 0);
    }
    WaysInput input() { return {bodies, pairs.pairs(), contacts, range, ways, jointed, {}, {}, executor}; }
    std::vector<TooDeep> find() {
        pairs.detect({bodies, materials, broad_phase, {}, range, executor}, contacts);
        Flights flights;
        measureFlights(input(), flights);
        std::vector<std::vector<TooDeep>> found;
        findTooDeep(input(), flights, found);
        std::vector<TooDeep> all;
        for (const std::vector<TooDeep>& part : found) all.insert(all.end(), part.begin(), part.end());
        return all;
    }
};

TEST(WayBack, LeadsToWhereBodiesWereAsDeepAsTheyMayBe) {
    TwoBalls balls;
    balls.addOnWay(2.4, 1.6);
    const std::vector<TooDeep> found = balls.find();
    ASSERT_EQ(found.size(), 1);
    const double x = 2.4 - 0.8 * found[0].part;
    EXPECT_GE(x, 2 - most);
    EXPECT_LE(x, 2);
}

TEST(WayBack, LeavesBodiesThatAreHardlyInEachOther) {
    TwoBalls balls;
    balls.addOnWay(3.1, 2 - 0.99 * most);
    EXPECT_TRUE(balls.find().empty());
}

TEST(WayBack, LeadsSlowBodiesAsFarBack) {
    TwoBalls balls;
    balls.addOnWay(2 - 0.5 * allowed, 2 - 1.5 * allowed);
    const std::vector<TooDeep> found = balls.find();
    ASSERT_EQ(found.size(), 1);
    EXPECT_NEAR(found[0].part, 0.8, 0.1);
}

TEST(WayBack, LeavesItToBallsToSpin) {
    TwoBalls balls;
    balls.addOnWay(2 - 0.5 * allowed, 2 - 1.5 * allowed);
    balls.bodies.orientation[1] = Quat(Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()));
    const std::vector<TooDeep> found = balls.find();
    ASSERT_EQ(found.size(), 1);
    EXPECT_NEAR(found[0].part, 0.8, 0.1);
}

TEST(WayBack, NoPointOfASurfaceTurnsFartherThanSaid) {
    TwoBalls balls;
    BodyStorage& b = balls.bodies;
    const double angle = 0.4;
    const double far = 2 * 3.2 * std::sin(angle / 2);
    b.r_max[0] = 3.2;
    b.orientation[0] = Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
    const auto turned = [&] { return turnedWay(b, 0, Quat::Identity()); };
    EXPECT_EQ(turned(), 0);
    b.p_BS[0] = Vec3(1, 0, 0);
    EXPECT_NEAR(turned(), far, 1e-12);
    for (const Shape& round : {Shape{Capsule{0.2, 6}}, Shape{Cylinder{0.2, 6}}}) {
        b.shape[0] = round;
        b.p_BS[0] = Vec3::Zero();
        b.R_BS[0] = Quat::Identity();
        EXPECT_EQ(turned(), 0);
        b.R_BS[0] = Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));
        EXPECT_NEAR(turned(), far, 1e-12);
    }
    b.shape[0] = Box{Vec3(2, 2, 6)};
    EXPECT_NEAR(turned(), far, 1e-12);
}

TEST(WayBack, LeavesBodiesThatSlideApartFast) {
    TwoBalls balls;
    balls.addOnWay(2 - 0.99 * most, 2 - 0.99 * most);
    balls.bodies.position[1].y() = balls.bodies.linear_step[1].y() = 1.5;
    EXPECT_TRUE(balls.find().empty());
}

TEST(WayBack, LeadsToBeforeTheBodyThatWasFlownThrough) {
    TwoBalls balls;
    balls.addOnWay(5, -5);
    const std::vector<TooDeep> found = balls.find();
    ASSERT_EQ(found.size(), 1);
    const double x = 5 - 10 * found[0].part;
    EXPECT_GE(x, 2 - most - 1e-12);
    EXPECT_LE(x, 2);
}

TEST(WayBack, LeadsToBeforeTheBodyThatStoppedOnItsWay) {
    TwoBalls balls;
    balls.addOnWay(5, -5);
    // It went back before, to the first tenth of its flight, and stands there while the other comes.
    balls.ways[0].begin.position = Vec3(-8, 0, 0);
    balls.ways[0].part = 0.1;
    const std::vector<TooDeep> found = balls.find();
    ASSERT_EQ(found.size(), 1);
    const double x = 5 - 10 * found[0].part;
    EXPECT_GE(x, 2 - most - 1e-12);
    EXPECT_LE(x, 2);
}

TEST(WayBack, LeadsToBeforeWhatATurningBodySweeps) {
    TwoBalls balls;
    balls.addOnWay(3, 3);
    // A rod along y turned through x, where the ball is, and beyond.
    balls.bodies.shape[0] = Capsule{0.2, 6};
    balls.bodies.r_max[0] = 3.2;
    balls.bodies.r_min[0] = 0.2;
    const auto along = [](double angle) {
        return Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ())) *
               Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));
    };
    balls.ways[0].begin.orientation = along(0);
    balls.bodies.orientation[0] = along(-0.75 * std::numbers::pi);
    const std::vector<TooDeep> found = balls.find();
    ASSERT_EQ(found.size(), 1);
    EXPECT_GT(found[0].part, 0.45);
    EXPECT_LT(found[0].part, 0.52);
}

TEST(WayBack, LeavesWhoWasDeepBeforeAndGetsNoDeeper) {
    TwoBalls balls;
    balls.addOnWay(1.8, 1.81);
    EXPECT_TRUE(balls.find().empty());
    TwoBalls deeper;
    deeper.addOnWay(1.8, 1.79);
    const std::vector<TooDeep> found = deeper.find();
    ASSERT_EQ(found.size(), 1);
    EXPECT_EQ(found[0].part, 0);
}

TEST(WayBack, IsNotForJointedBodies) {
    TwoBalls balls;
    balls.addOnWay(2.4, 1.6);
    balls.jointed = {1, 1};
    EXPECT_TRUE(balls.find().empty());
}

TEST(WayBack, LeavesThoseWhoBeganFarInEachOther) {
    TwoBalls balls;
    balls.addOnWay(1.6, 1.5);
    std::vector<std::uint8_t> stuck;
    balls.find();
    findStuck(balls.input(), stuck);
    EXPECT_EQ(stuck, (std::vector<std::uint8_t>{1, 1}));
    TwoBalls fallen;
    fallen.addOnWay(2.4, 1.5);
    fallen.find();
    findStuck(fallen.input(), stuck);
    EXPECT_EQ(stuck, (std::vector<std::uint8_t>{0, 0}));
}

TEST(WayBack, LeadsToWhereTheCorrectionPressesNobodyIntoOthers) {
    TwoBalls balls;
    balls.addOnWay(2.01, 1.9);
    balls.find();
    std::vector<std::vector<TooDeep>> found;
    const auto pressed = [&](double deepest) -> std::vector<TooDeep> {
        const std::vector<MovedBody> moved{{}, {.way = 0.11, .deepest = deepest}};
        findPressed(balls.input(), moved, found);
        return found.at(0);
    };
    const auto depth = [](const TooDeep& pair) { return 2 - (2.01 - 0.11 * pair.part); };
    // As deep as the correction leaves others, and not as deep as it was in somebody else.
    ASSERT_EQ(pressed(0).size(), 1);
    EXPECT_NEAR(depth(pressed(0)[0]), 1.35 * allowed, 0.05 * 1.35 * allowed);
    ASSERT_EQ(pressed(3).size(), 1);
    EXPECT_NEAR(depth(pressed(3)[0]), 0.9 * 3 * allowed, 0.05 * 0.9 * 3 * allowed);
    EXPECT_TRUE(pressed(4).empty());
}

TEST(WayBack, LimitsNoDepthOfBodiesThatAreBackWhereTheyWereFound) {
    TwoBalls balls;
    balls.addOnWay(1.9, 1.9);
    balls.find();
    ASSERT_EQ(balls.contacts.size(), 1);
    // Deeper than balls so far apart are, as to first order the correction may have it.
    balls.contacts[0].distance = -0.2;
    const std::vector<MovedBody> moved{{}, {.way = 0.01}};
    limitToDepths(balls.input(), moved, balls.contacts);
    EXPECT_EQ(balls.contacts[0].distance, -0.2);
    balls.bodies.position[1].x() += 0.01;
    limitToDepths(balls.input(), moved, balls.contacts);
    EXPECT_NEAR(balls.contacts[0].distance, -0.09, 0.01);
}

TEST(WayBack, IsAPoseOnTheWay) {
    BodyWay way;
    way.begin.position = Vec3(1, 0, 0);
    const Pose now{Vec3(1, 2, 0), Quat::Identity()};
    EXPECT_EQ(poseOnWay(now, way, 0).position, Vec3(1, 0, 0));
    EXPECT_EQ(poseOnWay(now, way, 0.5).position, Vec3(1, 1, 0));
    EXPECT_EQ(poseOnWay(now, way, 1).position, Vec3(1, 2, 0));
    // It flew half of its flight only.
    way.part = 0.5;
    EXPECT_EQ(poseOnWay(now, way, 0.25).position, Vec3(1, 1, 0));
    EXPECT_EQ(poseOnWay(now, way, 1).position, Vec3(1, 2, 0));
}

}  // namespace
}  // namespace cairn
