/// @file The correction on thousands of random worlds: against the literal reference, and for what must always hold.
#include <gtest/gtest.h>

#include <algorithm>

#include "correction/contact_scene.h"
#include "correction/random_scene.h"
#include "correction/reference_correction.h"

namespace cairn::test {
namespace {

constexpr std::uint64_t worlds = 10000;

/// Every eighth world is larger, so that pushes travel through more bodies.
ContactScene world(std::uint64_t seed) {
    return randomScene(seed, seed % 8 == 0 ? 30 : 11);
}

TEST(PropagatedCorrection, ChoosesAndMovesAsTheLiteralAlgorithmWithoutAbort) {
    const auto correction = makeCorrection(CorrectionKind::propagated);
    std::int64_t uncorrected = 0;
    ReferenceCorrection::Seen seen;
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
        ContactScene scene = world(seed);
        ContactScene expected = scene;
        const CorrectionCounts counts = scene.correctWith(*correction);
        ReferenceCorrection reference(expected);
        const CorrectionCounts wanted = reference.correct();
        ASSERT_EQ(counts.penetrating, wanted.penetrating) << "seed " << seed;
        ASSERT_EQ(counts.corrected, wanted.corrected) << "seed " << seed;
        ASSERT_EQ(counts.uncorrected, wanted.uncorrected) << "seed " << seed;
        ASSERT_EQ(counts.displaced, wanted.displaced) << "seed " << seed;
        for (std::size_t i = 0; i < scene.kind.size(); ++i) {
            ASSERT_TRUE(near(scene.position[i], expected.position[i])) << "seed " << seed << ", body " << i;
            ASSERT_EQ(scene.asleep[i], expected.asleep[i]) << "seed " << seed << ", body " << i;
            ASSERT_EQ(scene.woken[i], expected.woken[i]) << "seed " << seed << ", body " << i;
        }
        for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
            ASSERT_TRUE(near(scene.contacts[i].point, expected.contacts[i].point)) << "seed " << seed;
            ASSERT_NEAR(scene.contacts[i].distance, expected.contacts[i].distance, 1e-12) << "seed " << seed;
        }
        uncorrected += counts.uncorrected;
        seen.steps_back += reference.seen().steps_back;
        seen.handed_on += reference.seen().handed_on;
        seen.closed_gaps += reference.seen().closed_gaps;
        seen.chosen_tied += reference.seen().chosen_tied;
    }
    // The worlds must exercise all of it.
    EXPECT_GT(uncorrected, 1000);
    EXPECT_GT(seen.steps_back, 1000);
    EXPECT_GT(seen.handed_on, 1000);
    EXPECT_GT(seen.closed_gaps, 1000);
    EXPECT_GT(seen.chosen_tied, 50);
}

TEST(PropagatedCorrection, MakesNoContactDeeperThanItWasOrThanMayRemain) {
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
        ContactScene scene = world(seed);
        const std::vector<Contact> before = scene.contacts;
        scene.correct();
        for (std::size_t i = 0; i < before.size(); ++i) {
            const double allowed = std::min(before[i].distance, scene.remaining());
            ASSERT_GE(scene.contacts[i].distance, allowed - 1e-14) << "seed " << seed << ", contact " << i;
        }
    }
}

TEST(PropagatedCorrection, MovesPositionsOnlyAndOfBodiesInReachOnly) {
    std::uint64_t moved_bodies = 0;
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
        ContactScene scene = world(seed);
        // What a penetrating contact can reach, found by repeated passes over all contacts.
        std::vector<bool> reached(scene.kind.size(), false);
        for (std::size_t pass = 0; pass <= scene.kind.size(); ++pass) {
            for (const Contact& contact : scene.contacts) {
                const bool starts = contact.distance < -scene.settings.penetration_threshold;
                const bool either = starts || reached[contact.a] || reached[contact.b];
                for (const BodyIndex body : {contact.a, contact.b}) {
                    if (either && scene.kind[body] == BodyKind::dynamic) reached[body] = true;
                }
            }
        }
        const ContactScene before = scene;
        scene.correct();
        EXPECT_EQ(scene.v, before.v);
        EXPECT_EQ(scene.w, before.w);
        EXPECT_EQ(scene.linear_step, before.linear_step);
        for (std::size_t i = 0; i < scene.kind.size(); ++i) {
            if (!reached[i]) {
                ASSERT_EQ(scene.position[i], before.position[i]) << "seed " << seed << ", body " << i;
                ASSERT_EQ(scene.asleep[i], before.asleep[i]) << "seed " << seed << ", body " << i;
            }
            const bool moved = scene.position[i] != before.position[i];
            if (moved) ++moved_bodies;
            if (before.asleep[i] != 0) {
                ASSERT_EQ(scene.asleep[i] == 0, moved) << "seed " << seed;
            }
        }
        for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
            ASSERT_EQ(scene.contacts[i].normal, before.contacts[i].normal);
        }
    }
    EXPECT_GT(moved_bodies, worlds) << "more than one per world";
}

TEST(PropagatedCorrection, GivesTheSameBitsWithFreshAndWithUsedMemory) {
    const auto used = makeCorrection(CorrectionKind::propagated);
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
        ContactScene first = world(seed);
        ContactScene second = first;
        first.correctWith(*used);
        second.correct();
        ASSERT_EQ(first.position, second.position) << "seed " << seed;
        for (std::size_t i = 0; i < first.contacts.size(); ++i) {
            ASSERT_EQ(first.contacts[i].point, second.contacts[i].point);
            ASSERT_EQ(first.contacts[i].distance, second.contacts[i].distance);
        }
    }
}

}  // namespace
}  // namespace cairn::test
