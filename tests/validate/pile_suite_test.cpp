/// The piles that are judged: every two values of two factors together, the same in every run.
#include "validate/pile_suite.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>

namespace cairn::validation {
namespace {

std::array<std::string, 9> valuesOf(const Pile& p) {
    return {nameOf(p.shape),          p.graded ? "20" : "1",      std::to_string(p.count),
            std::to_string(p.depth),  std::to_string(p.impact),   std::to_string(p.step),
            std::to_string(p.extent), std::to_string(p.friction), std::to_string(p.restitution)};
}

TEST(PileSuite, HasEveryTwoValuesOfTwoFactors) {
    constexpr std::array<std::size_t, 9> levels = {8, 2, 4, 4, 3, 4, 4, 3, 2};
    const std::vector<Pile> piles = pileSuite();
    EXPECT_GE(piles.size(), 120U);
    for (std::size_t f = 0; f < levels.size(); ++f) {
        for (std::size_t h = f + 1; h < levels.size(); ++h) {
            std::set<std::string> pairs;
            for (const Pile& pile : piles) pairs.insert(valuesOf(pile)[f] + " " + valuesOf(pile)[h]);
            // Only 200 bodies stand in a shaft one body wide.
            const std::size_t impossible = f == 2 && h == 3 ? 3 : 0;
            EXPECT_EQ(pairs.size(), levels[f] * levels[h] - impossible) << f << ", " << h;
        }
    }
}

TEST(PileSuite, IsTheSameInEveryRunAndHasFewLargePiles) {
    const std::vector<Pile> piles = pileSuite();
    const std::vector<Pile> again = pileSuite();
    ASSERT_EQ(piles.size(), again.size());
    std::size_t large = 0;
    for (std::size_t i = 0; i < piles.size(); ++i) {
        EXPECT_EQ(nameOf(piles[i]), nameOf(again[i]));
        EXPECT_EQ(piles[i].seed, i + 1);
        EXPECT_TRUE(piles[i].depth != 1 || piles[i].count == 200);
        large += piles[i].count == 8000 ? 1 : 0;
    }
    EXPECT_LE(large, 12U);
    EXPECT_EQ(quickPiles().size(), 24U);
}

TEST(PileSuite, PartsAreTheWhole) {
    const std::vector<Pile> piles = pileSuite();
    std::set<std::uint64_t> seeds;
    for (std::size_t part = 1; part <= 3; ++part) {
        for (const Pile& pile : partOf(piles, part, 3)) EXPECT_TRUE(seeds.insert(pile.seed).second);
    }
    EXPECT_EQ(seeds.size(), piles.size());
    EXPECT_THROW(partOf(piles, 0, 3), InputError);
    EXPECT_THROW(partOf(piles, 4, 3), InputError);
}

std::vector<Pile> smallPiles() {
    std::vector<Pile> piles(5);
    for (std::size_t i = 0; i < piles.size(); ++i) {
        piles[i].count = 10 + 5 * (i % 3);
        piles[i].depth = 3;
        piles[i].seed = i + 1;
    }
    return piles;
}

TEST(PileSuite, SideBySideIsAsOneAfterTheOther) {
    const std::vector<Pile> piles = smallPiles();
    std::vector<std::size_t> alone;
    std::vector<PileResult> results(piles.size());
    runPiles(
        piles, 1, [] {},
        [&](std::size_t i, const PileResult& result) {
            alone.push_back(i);
            results[i] = result;
        });
    EXPECT_EQ(alone, (std::vector<std::size_t>{2, 1, 4, 0, 3})) << "the largest first";
    std::multiset<std::size_t> together;
    runPiles(
        piles, 3, [] {},
        [&](std::size_t i, const PileResult& result) {
            together.insert(i);
            EXPECT_EQ(result.rest_time, results[i].rest_time);
            EXPECT_EQ(result.rest_overlap, results[i].rest_overlap);
            EXPECT_EQ(result.steps, results[i].steps);
        });
    EXPECT_EQ(together, (std::multiset<std::size_t>{0, 1, 2, 3, 4}));
    EXPECT_NO_THROW(runPiles(
        {}, 2, [] {}, [](std::size_t, const PileResult&) { FAIL(); }));
}

TEST(PileSuite, WhatOneThrowsEndsAll) {
    std::size_t ended = 0;
    const auto done = [&](std::size_t, const PileResult&) {
        ++ended;
        throw InputError("a disk is full");
    };
    for (const std::size_t threads : {1U, 3U}) {
        ended = 0;
        EXPECT_THROW(runPiles(
                         smallPiles(), threads, [] {}, done),
                     InputError);
        EXPECT_EQ(ended, 1U) << "nobody goes on";
    }
}

TEST(PileSuite, NamesWhatIsMissed) {
    const Pile pile{.friction = 0.2};
    PileResult good;
    good.rest_time = 1;
    good.allowed_time = 2;
    EXPECT_TRUE(missedBy(pile, good).empty());
    PileResult bad = good;
    bad.gain = 0.1;
    bad.rest_time = -1;
    bad.lost = 1;
    bad.rest_overlap = bad.fall_overlap = 0.5;
    EXPECT_EQ(missedBy(pile, bad).size(), 5U);
    EXPECT_EQ(rowOf(pile, bad)["missed"].size(), 5U);
    EXPECT_NE(lineOf(pile, bad).find("missed: gain, rest"), std::string::npos);
    const Pile slippery{.friction = 0};
    bad.motion = 1;
    EXPECT_EQ(missedBy(slippery, bad)[1], "motion");
}

}  // namespace
}  // namespace cairn::validation
