/// What bodies that turn meet at the end of a step.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "broad_phase/hash_grids.h"
#include "pairs/foreseen.h"
#include "pairs/pair_table.h"
#include "pairs/warm_start.h"

namespace cairn {
namespace {

constexpr double turn_step = 0.01;    ///< [s]
constexpr double rod_allowed = 0.01;  ///< [m]
constexpr double half_rod = 1;        ///< [m]
constexpr double thickness = 0.2;     ///< [m]

/// A rod that lies over a block, along x.
struct RodOverGround {
    BodyStorage bodies;
    MaterialTable materials;
    HashGrids broad_phase;
    DetectionRange range{.threshold = rod_allowed, .foresight = {.time = turn_step}};
    Executor executor;
    PairTable pairs;
    std::vector<Contact> contacts;
    BodyIndex ground, rod;

    explicit RodOverGround(double height) {
        materials.add({.name = "matter", .density = 1});
        ground = add(BodyKind::fixed, Vec3(8, 8, 2), -1);
        rod = add(BodyKind::dynamic, Vec3(2 * half_rod, thickness, thickness), height + thickness / 2);
    }
    BodyIndex add(BodyKind kind, const Vec3& lengths, double z) {
        const BodyIndex i = bodies.allocate(kind);
        bodies.shape[i] = Box{lengths};
        bodies.r_max[i] = lengths.norm() / 2;
        bodies.r_min[i] = lengths.minCoeff() / 2;
        bodies.position[i].z() = z;
        return i;
    }
    PairsInput input() { return {bodies, materials, broad_phase, {}, range, executor}; }
    /// Turns the end at +x down by an angle per step [rad].
    void turn(double angle) { bodies.w[rod].y() = angle / turn_step; }
};

TEST(AtEnd, ThePlaceThatIsMetBeganWhereItIsNow) {
    constexpr double angle = 0.5;
    constexpr double height = 0.45;
    RodOverGround scene(height);
    scene.turn(angle);
    std::vector<BodyAhead> ahead(scene.bodies.slots());
    for (const BodyIndex i : {scene.ground, scene.rod}) {
        ahead[i].now = boundsOf(scene.bodies.shape[i], scene.bodies.shapePose(i));
        lookAhead(scene.bodies, scene.range, i, ahead[i]);
    }
    int met = 0;
    Manifold manifold;
    const BodyPair pair{scene.ground, scene.rod};
    PairAhead(scene.bodies, scene.range, pair, ahead).forEachAtEnd(manifold, [&](const PairAhead::AtEnd& at_end) {
        ++met;
        EXPECT_LT(at_end.normal.z(), -0.999);
        // The lower edge of the end is as high as the rod now, and gets hardly deeper than it may. The chord of the
        // angle is by a twenty-fourth of its square shorter than the arc.
        EXPECT_NEAR(at_end.distance, height, half_rod * angle * angle * angle / 24 + rod_allowed / 4);
    });
    EXPECT_GT(met, 0);
}

TEST(AtEnd, WhoWentBackNowOrWhenItMovedLastIsFollowedHoweverSlowItIs) {
    const std::vector<std::uint8_t> nobody, rod{0, 1};
    for (const auto& [stopped, held] : {std::pair(nobody, nobody), std::pair(rod, nobody), std::pair(nobody, rod)}) {
        RodOverGround scene(rod_allowed / 2);
        scene.pairs.detect(scene.input(), scene.contacts);
        ASSERT_TRUE(scene.contacts.empty());
        // Deeper than it may, by a way that nobody is followed for otherwise.
        scene.turn(2 * rod_allowed);
        std::vector<std::uint32_t> added;
        scene.pairs.followStruck(scene.input(), {100, stopped, held, {}}, scene.contacts, added);
        EXPECT_EQ(added.empty(), stopped.empty() && held.empty());
    }
}

TEST(AtEnd, WhatPushesStaysForeseenAsLongAsNobodyMoves) {
    RodOverGround scene(rod_allowed / 2);
    // So little that they do not touch, but their bounds do.
    scene.bodies.orientation[scene.ground] = Quat(Eigen::AngleAxisd(0.002, Vec3::UnitY()));
    scene.pairs.detect(scene.input(), scene.contacts);
    scene.turn(2 * rod_allowed);
    const std::vector<std::uint8_t> rod{0, 1};
    std::vector<std::uint32_t> added;
    scene.pairs.followStruck(scene.input(), {100, rod, {}, {}}, scene.contacts, added);
    ASSERT_FALSE(scene.contacts.empty());
    scene.turn(0);
    const auto detectAgain = [&](double push) {
        for (Contact& contact : scene.contacts) contact.impulse = push * contact.normal;
        beginContacts(scene.contacts, {}, Executor());
        scene.pairs.detect(scene.input(), scene.contacts);
    };
    const double distance = scene.contacts.front().distance;
    for (int n = 0; n < 2; ++n) {
        detectAgain(3);
        ASSERT_FALSE(scene.contacts.empty());
        EXPECT_EQ(scene.contacts.front().distance, distance);
        EXPECT_EQ(scene.contacts.front().last_impulse, 3 * scene.contacts.front().normal);
    }
    detectAgain(0);
    EXPECT_TRUE(scene.contacts.empty()) << "it pushes no more";
}

}  // namespace
}  // namespace cairn
