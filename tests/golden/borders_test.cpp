/// The golden scenes show what they are kept for: those at borders are on their sides of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "golden/scene_names.h"

namespace cairn::golden {
namespace {

class Borders : public testing::TestWithParam<Kind> {};

TEST_P(Borders, LargestBatchesHaveTheContactsThatTheTableSays) {
    std::size_t counted = 0;
    for (const GoldenScene& scene : goldenScenes()) {
        if (scene.contacts == 0) continue;
        ++counted;
        GoldenRun run(scene, GetParam(), 1);
        // Later a corner of a rocking box may lift off.
        run.stepUntil(scene.hashSteps(GetParam()).front());
        EXPECT_EQ(run.world().statistics().largest_batch, scene.contacts) << scene.name;
    }
    EXPECT_EQ(counted, 6U);
}

/// Contacts whose bodies move along or away from each other faster than contacts at rest do.
std::int64_t slidingContacts(const World& world) {
    const double threshold = world.settings().resolution.restitution_threshold;
    const auto velocity = [&](BodyId id, const Vec3& point) -> Vec3 {
        if (world.isFixed(id)) return Vec3::Zero();
        return world.linearVelocity(id) + world.angularVelocity(id).cross(point - world.centreOfMass(id));
    };
    return std::ranges::count_if(world.contacts(), [&](const ContactInfo& contact) {
        return (velocity(contact.a, contact.point) - velocity(contact.b, contact.point)).norm() > threshold;
    });
}

TEST_P(Borders, ThreeAndFourOfAHundredContactsSlide) {
    for (const std::int64_t sliding : {3, 4}) {
        const GoldenScene& scene = goldenScene("sliding" + std::to_string(sliding));
        GoldenRun run(scene, GetParam(), 1);
        for (const std::int64_t step : {scene.hashSteps(GetParam())[0], scene.hashSteps(GetParam())[1]}) {
            run.stepUntil(step);
            EXPECT_EQ(run.world().contacts().size(), 100U) << scene.name << ", step " << step;
            EXPECT_EQ(slidingContacts(run.world()), sliding) << scene.name << ", step " << step;
        }
    }
}

/// With the presets only: the thesis's resolution wakes whatever it touches.
TEST(HeldBodies, SleepOnAlsoWhereTooFewSleepToBeHeld) {
    for (const Kind kind : {Kind::performance, Kind::accuracy}) {
        for (const std::int64_t asleep : {30, 31}) {
            const GoldenScene& scene = goldenScene("held" + std::to_string(asleep) + "of40");
            GoldenRun run(scene, kind, 1);
            for (const std::int64_t step : scene.hashSteps(kind)) {
                SCOPED_TRACE(std::string(scene.name) + ", step " + std::to_string(step));
                run.stepUntil(step);
                const std::vector<BatchInfo> batches = run.world().batches();
                ASSERT_EQ(batches.size(), 1U);
                EXPECT_EQ(batches.front().bodies.size(), 40U);
                EXPECT_EQ(run.world().statistics().asleep, asleep);
                EXPECT_EQ(run.world().statistics().woken, 0);
            }
        }
    }
}

TEST_P(Borders, ThePileIsLargeWithItsJointAndWithout) {
    for (const auto& [name, joints] : {std::pair("pile", 0U), std::pair("pile_with_joint", 1U)}) {
        const GoldenScene& scene = goldenScene(name);
        GoldenRun run(scene, GetParam(), 1);
        run.stepUntil(scene.hashSteps(GetParam()).front());
        EXPECT_EQ(run.world().statistics().largest_batch, 580) << name;
        EXPECT_EQ(run.world().joints().size(), joints) << name;
        EXPECT_EQ(run.world().statistics().asleep, 0) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(Settings, Borders, testing::ValuesIn(kinds_of_all),
                         [](const auto& test) { return std::string(nameOf(test.param)); });

class Events : public testing::TestWithParam<Kind> {};

TEST_P(Events, OneJointOfTheMechanismBreaks) {
    const GoldenScene& scene = goldenScene("mechanism");
    GoldenRun run(scene, GetParam(), 1);
    EXPECT_EQ(run.world().joints().size(), 21U);
    run.stepUntil(scene.hashSteps(GetParam()).back());
    EXPECT_EQ(run.world().joints().size(), 20U);
}

TEST_P(Events, TheThrownBallWakesOneStackAfterAnother) {
    const GoldenScene& scene = goldenScene("waking_by_ball");
    const std::span<const std::int64_t> steps = scene.hashSteps(GetParam());
    GoldenRun run(scene, GetParam(), 1);
    run.stepUntil(steps[0]);
    EXPECT_EQ(run.world().statistics().asleep, 30);
    run.stepUntil(steps[1]);
    const std::int64_t after_first = run.world().statistics().asleep;
    EXPECT_LT(after_first, 30);
    run.stepUntil(steps[2]);
    EXPECT_LT(run.world().statistics().asleep, after_first);
}

TEST_P(Events, TheScenesOfTheThesisGoBeyondTheirImpact) {
    for (const auto& [name, boxes] : {std::pair("stacks5", 275), std::pair("stacks8", 440)}) {
        const GoldenScene& scene = goldenScene(name);
        GoldenRun run(scene, GetParam(), 1);
        run.stepUntil(1);
        EXPECT_EQ(run.world().statistics().asleep, boxes) << name;
        run.stepUntil(scene.hashSteps(GetParam()).back());
        EXPECT_LT(run.world().statistics().asleep, boxes - 100) << name;
    }
    for (const std::string_view name : {"well324", "well392", "cage384", "cage2816"}) {
        const GoldenScene& scene = goldenScene(name);
        GoldenRun run(scene, GetParam(), 1);
        run.stepUntil(1);
        EXPECT_EQ(run.world().statistics().contacts, 0) << name;
        run.stepUntil(scene.hashSteps(GetParam()).back());
        EXPECT_GT(run.world().statistics().contacts, 100) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(Settings, Events, testing::ValuesIn(kinds_of_all),
                         [](const auto& test) { return std::string(nameOf(test.param)); });

}  // namespace
}  // namespace cairn::golden
