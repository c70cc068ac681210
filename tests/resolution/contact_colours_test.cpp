/// The order of a parallel sweep.
#include "resolution/contact_colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "resolution/batch_fixture.h"

namespace cairn {
namespace {

using test::randomEnds;

std::vector<std::uint32_t> sorted(std::span<const std::uint32_t> order) {
    std::vector<std::uint32_t> all(order.begin(), order.end());
    std::ranges::sort(all);
    return all;
}

std::vector<std::uint32_t> counted(std::size_t count) {
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

TEST(ContactColours, HoldEveryContactOnce) {
    const std::vector<ContactEnds> ends = randomEnds(1, 200, 700);
    ContactColours colours;
    colours.colour(ends, 180);
    EXPECT_EQ(sorted(colours.order()), counted(ends.size()));
}

TEST(ContactColours, NoTwoPairsOfAColourShareAMovingBody) {
    constexpr std::uint32_t moving = 150;
    const std::vector<ContactEnds> ends = randomEnds(2, 200, 900);
    ContactColours colours;
    colours.colour(ends, moving);
    EXPECT_LT(colours.colours(), 40U) << "as many as the busiest two bodies have neighbours at most";
    for (std::size_t c = 0; c < colours.colours(); ++c) {
        ASSERT_TRUE(colours.isShared(c));
        std::set<std::uint32_t> seen;
        for (std::size_t p = 0; p < colours.pairs(c); ++p) {
            const ContactEnds& pair = ends[colours.order()[colours.begin(c, p)]];
            for (const std::uint32_t body : {pair.a, pair.b}) {
                EXPECT_TRUE(body >= moving || seen.insert(body).second) << "body " << body << " in colour " << c;
            }
            for (std::size_t k = colours.begin(c, p); k < colours.begin(c, p + 1); ++k) {
                EXPECT_EQ(ends[colours.order()[k]], pair) << "a pair stays together";
            }
        }
    }
}

TEST(ContactColours, ABodyWithMoreNeighboursThanColoursIsLeftToOneThread) {
    std::vector<ContactEnds> ends;
    for (std::uint32_t i = 1; i <= 100; ++i) ends.push_back({0, i});
    ContactColours colours;
    colours.colour(ends, 101);
    ASSERT_EQ(colours.colours(), 65U);
    EXPECT_TRUE(colours.isShared(63));
    EXPECT_FALSE(colours.isShared(64));
    EXPECT_EQ(colours.pairs(64), 36U);
    EXPECT_EQ(sorted(colours.order()), counted(100));
}

TEST(ContactColours, FixedBodiesNeedNoColourOfTheirOwn) {
    std::vector<ContactEnds> ends;
    for (std::uint32_t i = 0; i < 100; ++i) ends.push_back({i, 100});
    ContactColours colours;
    colours.colour(ends, 100);
    EXPECT_EQ(colours.colours(), 1U);
}

TEST(ContactColours, NothingHasNoColours) {
    ContactColours colours;
    colours.colour({}, 10);
    EXPECT_EQ(colours.colours(), 0U);
}

}  // namespace
}  // namespace cairn
