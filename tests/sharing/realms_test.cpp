#include "sharing/realms.h"

#include <gtest/gtest.h>

#include <random>

namespace cairn {
namespace {

Bounds boxFrom(double x, double to) {
    return {Vec3(x, 0, 0), Vec3(to, 1, 1)};
}

Bounds placeAt(const Vec3& middle) {
    return Bounds{middle, middle}.grown(0.01);
}

TEST(Realms, MeetInTheMiddleOfAGap) {
    const std::vector<Reach> reach{{boxFrom(0, 1), 0.1}, {boxFrom(3, 4), 0.1}};
    const Realms realms(reach, 0, 5);
    EXPECT_EQ(realms.all()[0].upper.x(), 2);
    EXPECT_EQ(realms.all()[1].lower.x(), 2);
    EXPECT_TRUE(realms.isFree(placeAt(Vec3(1.98, 0.5, 0.5))));
    EXPECT_FALSE(realms.isFree(placeAt(Vec3(2, 0.5, 0.5))));
    // Where nobody is: as far as was asked for, and a quarter of the box.
    EXPECT_TRUE(realms.isFree(placeAt(Vec3(-5.2, 0.5, -5.2))));
    EXPECT_FALSE(realms.isFree(placeAt(Vec3(-5.3, 0.5, 0.5))));
    EXPECT_FALSE(realms.reachesOthers(placeAt(Vec3(1.9, 0.5, 0.5))));
    EXPECT_TRUE(realms.reachesOthers(placeAt(Vec3(2.1, 0.5, 0.5))));
}

TEST(Realms, OverlapALittleMoreWhereTheyOverlap) {
    const std::vector<Reach> reach{{boxFrom(0, 2), 0.1}, {boxFrom(1.5, 4), 0.25}};
    const Realms realms(reach, 1, 5);
    EXPECT_EQ(realms.all()[0].upper.x(), 2.25);
    EXPECT_EQ(realms.all()[1].lower.x(), 1.25);
    EXPECT_FALSE(realms.isFree(placeAt(Vec3(2.2, 0.5, 0.5))));
    EXPECT_TRUE(realms.reachesOthers(placeAt(Vec3(2.2, 0.5, 0.5))));
    EXPECT_TRUE(realms.isFree(placeAt(Vec3(2.3, 0.5, 0.5))));
}

TEST(Realms, OfRanksWithoutBodiesAreNowhere) {
    const std::vector<Reach> reach{{}, {boxFrom(0, 1), 0.1}};
    const Realms none(reach, 0, 1);
    EXPECT_FALSE(none.isFree(placeAt(Vec3(0.5, 0.5, 0.5))));
    const Realms alone(reach, 1, 1);
    EXPECT_TRUE(alone.isFree(placeAt(Vec3(0.5, 0.5, 0.5))));
    EXPECT_FALSE(alone.reachesOthers(placeAt(Vec3(0.5, 0.5, 0.5))));
    EXPECT_FALSE(Realms().isFree(placeAt(Vec3(0.5, 0.5, 0.5))));
}

TEST(Realms, WhatIsFreeIsSoForOneRankAlone) {
    std::mt19937 random(5);
    const auto draw = [&](double most) {
        return most * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
    };
    const auto drawPoint = [&](double most) { return Vec3(draw(most), draw(most), draw(most)); };
    int free = 0;
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Reach> reach;
        for (int r = 0; r < 5; ++r) {
            const Vec3 corner = drawPoint(10);
            reach.push_back({{corner, corner + drawPoint(3)}, 0.2});
        }
        std::vector<Realms> realms;
        for (std::size_t r = 0; r < reach.size(); ++r) realms.emplace_back(reach, r, 0.5);
        for (std::size_t r = 0; r < reach.size(); ++r) {
            EXPECT_TRUE(realms[r].all()[r].contains(reach[r].box));
        }
        for (int n = 0; n < 200; ++n) {
            const Bounds place = placeAt(drawPoint(13));
            int of = 0;
            for (const Realms& one : realms) {
                of += one.isFree(place) ? 1 : 0;
                EXPECT_TRUE(one.isFree(place) || !one.core().contains(place));
            }
            EXPECT_LE(of, 1);
            free += of;
        }
    }
    EXPECT_GT(free, 1000);
}

}  // namespace
}  // namespace cairn
