/// Bodies that stand inside many others are loosened: they move apart a little in every step.
#include <gtest/gtest.h>

#include "contact_scene.h"

namespace cairn {
namespace {

using test::ContactScene;

/// Balls of 1 m side by side along x, so close that every two touch.
ContactScene crowd(int bodies, double spacing) {
    ContactScene scene;
    scene.settings = {};
    for (int i = 0; i < bodies; ++i) scene.addBody(Vec3(spacing * i, 0, 0));
    for (BodyIndex a = 0; a < scene.position.size(); ++a) {
        for (BodyIndex b = a + 1; b < scene.position.size(); ++b) {
            scene.touch(a, b, -Vec3::UnitX(), spacing * (b - a) - 1);
        }
    }
    return scene;
}

TEST(Loosening, MovesTheOuterBodiesOutwardsAndKeepsTheMiddle) {
    ContactScene scene = crowd(40, 1e-3);
    const FieldArray<Vec3> before = scene.position;
    const CorrectionCounts counts = scene.correct();
    EXPECT_EQ(counts.displaced, 40);
    // The first body is asked by 39 others to go half of each overlap: on average (1 − 20·0.001)/2 m.
    EXPECT_NEAR(scene.position[0].x() - before[0].x(), -0.49, 1e-12);
    EXPECT_NEAR(scene.position[39].x() - before[39].x(), 0.49, 1e-12);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < before.size(); ++i) sum += scene.position[i] - before[i];
    EXPECT_LT(sum.norm(), 1e-12);
    for (const Contact& contact : scene.contacts) {
        const double apart = scene.position[contact.b].x() - scene.position[contact.a].x();
        EXPECT_NEAR(contact.distance, apart - 1, 1e-12) << "contacts follow their bodies";
        EXPECT_NEAR(contact.point.x(), 0.5 * (scene.position[contact.a] + scene.position[contact.b]).x(), 1e-12);
    }
    EXPECT_EQ(counts.corrected + counts.uncorrected, counts.penetrating);
}

TEST(Loosening, LeavesFixedBodiesWhereTheyAre) {
    ContactScene scene = crowd(40, 0);
    const BodyIndex wall = scene.addFixed();
    scene.touch(0, wall, Vec3::UnitZ(), -0.5);
    scene.correct();
    EXPECT_EQ(scene.position[wall], Vec3(0, 0, 0));
    EXPECT_NEAR(scene.position[0].z(), 0.5 / 40, 1e-12) << "the mean of 40 ways, one of them all of 0.5 m";
}

TEST(Loosening, IsForCrowdsOnlyAndNotForTheThesis) {
    ContactScene few = crowd(31, 1e-3);
    EXPECT_EQ(few.correct().uncorrected, 0) << "one step of pushes corrects them";
    ContactScene as_in_the_thesis = crowd(40, 1e-3);
    as_in_the_thesis.settings.spread_levels = 0;
    EXPECT_EQ(as_in_the_thesis.correct().uncorrected, 0);
    // Overlaps that are shallow beside the distance of the centres are pushed apart, however many there are.
    ContactScene row;
    row.settings = {};
    for (int i = 0; i < 40; ++i) row.addBody(Vec3(0.9 * i, 0, 0));
    for (BodyIndex i = 1; i < 40; ++i) row.touch(i - 1, i, -Vec3::UnitX(), -0.1);
    EXPECT_EQ(row.correct().uncorrected, 0);
}

TEST(Loosening, TakesAHeapApartInTheEnd) {
    ContactScene scene = crowd(40, 0);
    double deepest = -1;
    for (int step = 0; step < 2000 && deepest < -scene.settings.penetration_threshold; ++step) {
        scene.correct();
        deepest = 0;
        for (const Contact& contact : scene.contacts) deepest = std::min(deepest, contact.distance);
    }
    EXPECT_GE(deepest, -scene.settings.penetration_threshold);
}

}  // namespace
}  // namespace cairn
