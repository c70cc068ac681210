#include "regions/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

/// Places in a box of 4 × 2 × 1 m, denser at one end.
std::vector<Vec3> somePlaces() {
    std::vector<Vec3> places;
    for (int i = 0; i < 1000; ++i) {
        const double t = i / 1000.0;
        places.emplace_back(4 * t * t, 2 * std::fmod(7.3 * t, 1), std::fmod(31.7 * t, 1));
    }
    return places;
}

std::vector<int> countsOf(const Regions& regions, int ranks) {
    std::vector<int> counts(static_cast<std::size_t>(ranks), 0);
    for (const Vec3& place : somePlaces()) ++counts[static_cast<std::size_t>(regions.ownerOf(place))];
    return counts;
}

TEST(Regions, HaveAsManyPlacesEach) {
    for (const auto kind : {PartitionKind::boxes, PartitionKind::x, PartitionKind::y, PartitionKind::z}) {
        for (const int ranks : {1, 2, 3, 4, 7, 8}) {
            for (const int count : countsOf(Regions({.kind = kind}, ranks, somePlaces()), ranks)) {
                EXPECT_NEAR(count, 1000 / ranks, 3);
            }
        }
    }
}

TEST(Regions, AreSlabsAlongAnAxis) {
    const Regions regions({.kind = PartitionKind::y}, 4, somePlaces());
    int last = 0;
    for (double y = -1; y < 3; y += 0.01) {
        const int owner = regions.ownerOf({3, y, -5});
        EXPECT_GE(owner, last);
        last = owner;
    }
    EXPECT_EQ(last, 3);
}

TEST(Regions, OfAGridAreCutAxisByAxis) {
    const Regions regions({.kind = PartitionKind::grid, .parts = {3, 2, 2}}, 12, somePlaces());
    for (const int count : countsOf(regions, 12)) EXPECT_NEAR(count, 1000 / 12, 4);
    // The slabs along x are four ranks each.
    for (double x = 0; x < 4; x += 0.1) {
        EXPECT_EQ(regions.ownerOf({x, 0.1, 0.1}) / 4, regions.ownerOf({x, 1.9, 0.9}) / 4);
    }
}

TEST(Regions, CutTheLongestExtentFirst) {
    const Regions regions({}, 2, somePlaces());
    EXPECT_EQ(regions.ownerOf({0, 0, 0}), 0);
    EXPECT_EQ(regions.ownerOf({0, 2, 1}), 0);
    EXPECT_EQ(regions.ownerOf({4, 0, 0}), 1);
}

TEST(Regions, DoNotDependOnTheOrderOfPlaces) {
    std::vector<Vec3> turned = somePlaces();
    std::ranges::reverse(turned);
    const Regions one({}, 7, somePlaces());
    const Regions other({}, 7, turned);
    for (const Vec3& place : turned) EXPECT_EQ(one.ownerOf(place), other.ownerOf(place));
}

TEST(Regions, AreOfUseWithoutPlacesAndWithEqualOnes) {
    EXPECT_EQ(Regions({}, 4, {}).ownerOf({-1, -1, -1}), 0);
    const std::vector<Vec3> equal(10, Vec3(1, 2, 3));
    const int owner = Regions({}, 4, equal).ownerOf({1, 2, 3});
    EXPECT_GE(owner, 0);
    EXPECT_LT(owner, 4);
}

TEST(Regions, AreCutWhereNobodyIs) {
    std::vector<Vec3> places;
    for (int i = 0; i < 1000; ++i) places.emplace_back(0.01 * i + (i < 512 ? 0 : 1), 0, 0);
    const Regions regions({}, 2, places);
    EXPECT_EQ(regions.ownerOf({5.4, 0, 0}), 0);
    EXPECT_EQ(regions.ownerOf({5.7, 0, 0}), 1);
    for (int i = 0; i < 1000; ++i) places[static_cast<std::size_t>(i)].x() = 0.01 * i + (i < 700 ? 0 : 1);
    EXPECT_EQ(Regions({}, 2, places).ownerOf({5.1, 0, 0}), 1) << "too far from the middle";
    for (int i = 0; i < 1000; ++i) places[static_cast<std::size_t>(i)].x() = i / 10;
    EXPECT_EQ(Regions({}, 2, places).ownerOf({49, 0, 0}), 0) << "of all gaps the one in the middle";
    EXPECT_EQ(Regions({}, 2, places).ownerOf({50, 0, 0}), 1);
}

TEST(Regions, RefuseGridsOfOtherNumbers) {
    EXPECT_NO_THROW(requirePartition({.kind = PartitionKind::grid, .parts = {2, 3, 1}}, 6));
    EXPECT_THROW(requirePartition({.kind = PartitionKind::grid, .parts = {2, 3, 1}}, 5), InputError);
    EXPECT_THROW(requirePartition({.kind = PartitionKind::grid, .parts = {-2, -3, 1}}, 6), InputError);
}

}  // namespace
}  // namespace cairn
