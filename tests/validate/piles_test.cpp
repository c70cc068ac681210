/// Piles come to rest: deep ones, at few steps per second, of tiny bodies and of awkward shapes.
#include "validate/piles.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

namespace cairn::validation {
namespace {

/// Energy never rises, nobody is lost, 98 % sleep in time, and nothing stays in each other.
void expectRest(const Pile& pile) {
    const PileResult result = runPile(
        pile, [](Settings&) {}, [](const World&) {});
    EXPECT_LE(result.gain, 1e-3) << nameOf(pile);
    EXPECT_EQ(result.lost, 0) << nameOf(pile);
    EXPECT_GE(result.rest_time, 0) << nameOf(pile);
    EXPECT_LE(result.rest_overlap, 0.02) << nameOf(pile);
}

TEST(Piles, OfBoxesComeToRest) {
    expectRest({.shape = PileShape::box, .count = 400});
    expectRest({.shape = PileShape::box, .count = 200, .depth = 30});
}

TEST(Piles, ComeToRestAtFewStepsPerSecond) {
    expectRest({.shape = PileShape::box, .count = 400, .step = 0.25});
}

TEST(Piles, OfConcaveBodiesComeToRest) {
    expectRest({.shape = PileShape::compound, .count = 200});
}

TEST(Piles, OfTinyAndOfLargeBodiesComeToRest) {
    expectRest({.shape = PileShape::hull, .count = 200, .extent = 1e-3});
    expectRest({.shape = PileShape::hull, .count = 200, .extent = 10});
}

TEST(Piles, ThatFallDownAShaftDoNotGetFarIntoEachOther) {
    const Pile boxes{.shape = PileShape::box,
                     .graded = true,
                     .depth = 1,
                     .impact = 40,
                     .step = 2,
                     .extent = 0.01,
                     .friction = 0.8,
                     .restitution = 0.5,
                     .seed = 84};
    const Pile rods{.shape = PileShape::rod, .depth = 1, .impact = 40, .extent = 10, .friction = 0.8, .seed = 119};
    for (const Pile& pile : {boxes, rods}) {
        const PileResult result = runPile(
            pile, [](Settings&) {}, [](const World&) {});
        // Without motion clamping 0.16 and 0.21.
        EXPECT_LE(result.fall_overlap, 0.1) << nameOf(pile);
        EXPECT_LE(result.rest_overlap, 0.02) << nameOf(pile);
        EXPECT_LE(result.gain, 1e-3) << nameOf(pile);
    }
}

TEST(Piles, ThatJamInAShaftCarryTheirWeightAndSleep) {
    // Each needs that contacts of flights that were denied go on carrying: without it half of each wakes the other half
    // in every step.
    const Pile plates{.shape = PileShape::plate, .depth = 1, .impact = 40, .step = 0.25, .seed = 92};
    const Pile mixed{.shape = PileShape::mixed, .depth = 1, .step = 0.25, .seed = 120};
    for (const Pile& pile : {plates, mixed}) expectRest(pile);
}

TEST(Piles, ThatJamAreNotLiftedForEver) {
    // What the correction lifted came down again, and sweeps went on: 0.45 to 0.8 slept.
    expectRest({.shape = PileShape::cylinder, .depth = 1, .impact = 10, .extent = 10, .restitution = 0.5, .seed = 901});
    expectRest({.shape = PileShape::cylinder, .depth = 1, .restitution = 0.5, .seed = 901});
}

TEST(Piles, ThatSinkInAShaftComeDownTogether) {
    // Who could only fly as far as the one below it flies, and is held for it, sinks by a few millimetres per second.
    expectRest({.shape = PileShape::cylinder, .depth = 1, .impact = 40, .step = 0.25, .seed = 104});
}

TEST(Piles, ThatJamGoOnBitForBitWhereTheyAreRestored) {
    // Most of the correction is taken back there, and who sleeps is woken and comes to rest again.
    const Pile pile{.shape = PileShape::cylinder, .count = 60, .depth = 1, .step = 0.25, .seed = 102};
    std::optional<World> restored;
    int steps = 0;
    std::int64_t woken = 0;
    const auto compare = [&](const World& world) {
        if (restored) {
            restored->step();
            ASSERT_EQ(restored->stateHash(), world.stateHash()) << "step " << steps;
        }
        restored.reset();
        woken += world.statistics().woken;
        if (++steps % 2 == 0) restored.emplace(World::restore(world.save()));
    };
    runPile(
        pile, [](Settings&) {}, compare);
    EXPECT_GT(woken, 500) << "they come to rest before they jam";
}

TEST(Piles, AreNamedByTheirFactors) {
    EXPECT_EQ(nameOf(Pile{.shape = PileShape::rod, .graded = true, .impact = 10}),
              "rod20_n200_deep10_v10_s1_d0.1_mu0.2_e0");
}

}  // namespace
}  // namespace cairn::validation
