#include "pairs/pair_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "broad_phase/hash_grids.h"

namespace cairn {
namespace {

/// Balls of radius 1 in a row, which overlap their neighbours by 0.1.
struct Row {
    BodyStorage bodies;
    MaterialTable materials;
    HashGrids broad_phase;
    std::vector<BodyPair> excluded;
    DetectionRange range{.threshold = 1};
    Executor executor;
    PairTable pairs;
    std::vector<Contact> contacts;

    explicit Row(int count, int threads = 1) : executor(threads) {
        materials.add({.name = "matter", .density = 1});
        for (int i = 0; i < count; ++i) add();
    }

    /// Puts a ball into the lowest free slot and to the place in the row that is the slot's.
    BodyIndex add() {
        const BodyIndex b = bodies.allocate(BodyKind::dynamic);
        bodies.shape[b] = Sphere{1};
        bodies.r_max[b] = 1;
        bodies.position[b] = Vec3(1.9 * b, 0, 0);
        return b;
    }

    PairsInput input() { return {bodies, materials, broad_phase, excluded, range, executor}; }
    void detect() { pairs.detect(input(), contacts); }
    void beginStep(std::span<const std::uint32_t> generation) { pairs.beginStep(bodies, generation); }
    void moveTo(BodyIndex i, const Vec3& position) { bodies.position[i] = position; }
    /// What the contacts that stay are known by, and those that are found anew inherit.
    void mark() {
        for (Contact& contact : contacts) {
            contact.angular_impulse = Vec3::Ones();
            contact.last_impulse = Vec3(contact.a + 1, 0, 0);
        }
    }
    bool isMarked(std::size_t contact) const { return contacts[contact].angular_impulse == Vec3::Ones(); }
};

TEST(PairTable, ContactsAreFoundAnewWhereABodyMoved) {
    Row row(4);
    row.detect();
    ASSERT_EQ(row.contacts.size(), 3);
    row.mark();
    row.detect();
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(row.isMarked(i)) << "nobody moved";
    row.moveTo(0, Vec3(0.05, 0, 0));
    row.detect();
    ASSERT_EQ(row.contacts.size(), 3);
    EXPECT_FALSE(row.isMarked(0));
    EXPECT_NEAR(row.contacts[0].distance, -0.15, 1e-12);
    EXPECT_EQ(row.contacts[0].last_impulse.x(), 1) << "inherited";
    EXPECT_TRUE(row.isMarked(1));
    EXPECT_TRUE(row.isMarked(2));
}

TEST(PairTable, PairsKnowTheirContacts) {
    for (const int threads : {1, 3}) {
        Row row(2000, threads);
        for (int n = 0; n < 3; ++n) {
            row.detect();
            std::size_t touching = 0;
            for (const ContactPair& pair : row.pairs.pairs()) {
                if (!pair.touches()) continue;
                ASSERT_EQ(pair.first, touching++);
                ASSERT_EQ(row.contacts[pair.first].a, pair.a);
                ASSERT_EQ(row.contacts[pair.first].b, pair.b);
            }
            ASSERT_EQ(touching, row.contacts.size());
            row.moveTo(900 + 10 * static_cast<BodyIndex>(n), Vec3(0, 100, 0));
        }
    }
}

TEST(PairTable, AnotherMarginAndForgottenContactsFindAllAnew) {
    Row row(3);
    row.detect();
    row.mark();
    row.range.margin = 0.01;
    row.detect();
    EXPECT_FALSE(row.isMarked(0));
    row.mark();
    row.pairs.forgetContacts();
    row.detect();
    EXPECT_FALSE(row.isMarked(0));
    EXPECT_FALSE(row.isMarked(1));
}

/// A cube that stands on another one with an edge, and whose opposite edge is just too slow to get down in a step.
struct TiltedCube : Row {
    TiltedCube() : Row(2) {
        range = {.threshold = 0.03, .foresight = {.time = 1}};
        const double tilt = 0.05;
        for (BodyIndex i = 0; i < 2; ++i) {
            bodies.shape[i] = Box{Vec3::Constant(2)};
            bodies.r_min[i] = 1;
            bodies.r_max[i] = std::sqrt(3.0);
        }
        bodies.orientation[1] = Quat(Eigen::AngleAxisd(tilt, Vec3::UnitY()));
        bodies.position[1] = Vec3(0, 0, 1 + std::cos(tilt) + std::sin(tilt) - 0.01);
    }
};

TEST(PairTable, WhoFellAsleepIsNotSeenToMoveAsItDidBefore) {
    TiltedCube cubes;
    cubes.bodies.v[0] = Vec3(0, 0, 0.009);
    cubes.detect();
    cubes.bodies.asleep[0] = 1;
    cubes.bodies.v[0].setZero();
    const double gap = 2 * std::sin(0.05) - 0.01;
    for (const double speed : {gap - 0.005, gap + 0.005}) {
        cubes.bodies.v[1] = Vec3(0, 0, -speed);
        cubes.detect();
        EXPECT_EQ(cubes.contacts.size(), speed < gap ? 2 : 4);
    }
}

TEST(PairTable, PairsThatJointsKeepApartDoNotTouchUntilTheJointsAreGone) {
    Row row(3);
    row.detect();
    row.excluded = {{0, 1}};
    row.detect();
    ASSERT_EQ(row.contacts.size(), 1);
    EXPECT_EQ(row.contacts[0].a, 1);
    row.excluded.clear();
    row.detect();
    EXPECT_EQ(row.contacts.size(), 2);
}

TEST(PairTable, WhoIsDisplacedMeetsOthersInTheSameStep) {
    Row row(4);
    row.moveTo(3, Vec3(0, 0, 9));
    row.detect();
    row.mark();
    row.moveTo(3, Vec3(1.9 * 2, 1.9, 0));
    row.detect();
    ASSERT_EQ(row.contacts.size(), 3);
    EXPECT_EQ(row.contacts[2].b, 3);
    EXPECT_TRUE(row.isMarked(0));
    EXPECT_TRUE(row.isMarked(1));
}

TEST(PairTable, PairsEndWithTheBoundsThatTheyWereSearchedWith) {
    Row row(3);
    row.beginStep({});
    row.detect();
    ASSERT_EQ(row.pairs.pairs().size(), 2);
    EXPECT_TRUE(row.pairs.pairs()[0].touches());
    row.beginStep(std::vector<std::uint32_t>(3, 0));
    row.moveTo(0, Vec3(0, 0, 50));
    row.detect();
    EXPECT_EQ(row.pairs.pairs().size(), 1);
}

TEST(PairTable, AnotherBodyInASlotInheritsNothing) {
    Row row(3);
    row.detect();
    row.mark();
    const std::vector<std::uint32_t> generation(3, 0);
    row.bodies.release(1);
    ASSERT_EQ(row.add(), 1);
    row.beginStep(generation);
    row.detect();
    ASSERT_EQ(row.contacts.size(), 2);
    for (const Contact& contact : row.contacts) EXPECT_EQ(contact.last_impulse, Vec3::Zero());
    row.bodies.release(1);
    row.beginStep(std::vector<std::uint32_t>(3, 1));
    row.detect();
    EXPECT_TRUE(row.contacts.empty());
}

TEST(PairTable, BodiesThatAreFixedBothDoNotTouch) {
    Row row(3);
    row.detect();
    row.bodies.kind[0] = row.bodies.kind[1] = BodyKind::fixed;
    row.detect();
    ASSERT_EQ(row.contacts.size(), 1);
    EXPECT_EQ(row.contacts[0].a, 1);
}

TEST(PairTable, AdoptedContactsLeaveTheirImpulses) {
    Row row(4);
    row.detect();
    row.mark();
    Row other(0);
    other.bodies = row.bodies;
    other.contacts = row.contacts;
    other.pairs.adopt(other.contacts);
    other.detect();
    ASSERT_EQ(other.contacts.size(), 3);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(other.contacts[i].last_impulse, row.contacts[i].last_impulse);
}

TEST(PairTable, WhatComesBringsItsContactsAndAllElseStays) {
    Row here(6);
    Row there(6);
    here.detect();
    there.detect();
    here.mark();
    // Bodies 2 and 3 leave with their contacts, and come back.
    const auto leave = [&](Row& row, std::initializer_list<BodyIndex> bodies) {
        std::vector<std::uint8_t> left(6, 0);
        for (const BodyIndex i : bodies) {
            left[i] = 1;
            row.bodies.kind[i] = BodyKind::hole;
        }
        row.pairs.change({left, {}, {}}, row.contacts);
    };
    leave(here, {2, 3});
    ASSERT_EQ(here.contacts.size(), 2U);
    EXPECT_EQ(here.contacts[0].a, 0U);
    EXPECT_EQ(here.contacts[1].a, 4U);
    here.detect();
    ASSERT_EQ(here.contacts.size(), 2U);
    EXPECT_TRUE(here.isMarked(0) && here.isMarked(1)) << "what stays is known";

    const std::vector<Contact> brought{there.contacts[1], there.contacts[2], there.contacts[3]};
    const std::vector<BodyIndex> came{2, 3};
    const std::vector<std::uint8_t> nobody(6, 0);
    for (const BodyIndex i : came) here.bodies.kind[i] = BodyKind::dynamic;
    here.pairs.change({nobody, came, brought}, here.contacts);
    ASSERT_EQ(here.contacts.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(here.contacts[i].a, i);
    for (Contact& contact : here.contacts) contact.last_impulse = Vec3(contact.a + 1, 0, 0);
    here.detect();
    ASSERT_EQ(here.contacts.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(here.isMarked(i), i == 0 || i == 4) << "contacts of what came are found anew";
        EXPECT_EQ(here.contacts[i].last_impulse.x(), static_cast<double>(i + 1)) << "with their impulses";
    }
}

}  // namespace
}  // namespace cairn
