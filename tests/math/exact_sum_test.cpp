/// Sums that are rounded once.
#include "math/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace cairn {
namespace {

double sumOf(const std::vector<double>& terms) {
    ExactSum sum;
    for (const double term : terms) sum.add(term);
    return sum.rounded();
}

constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

TEST(ExactSum, IsTheDoubleNextToTheSum) {
    EXPECT_EQ(sumOf({}), 0);
    EXPECT_EQ(sumOf({-1.5}), -1.5);
    EXPECT_EQ(sumOf({0.1, 0.2, -0.3}), 0x1p-55) << "what these doubles add up to";
    EXPECT_EQ(sumOf({1e300, 1, -1e300}), 1);
    EXPECT_EQ(sumOf({1, 0x1p-53}), 1) << "half way goes to the even one";
    EXPECT_EQ(sumOf({1, 0x1p-53, smallest}), 1 + 0x1p-52) << "more than half way goes up";
    EXPECT_EQ(sumOf({1 + 0x1p-52, 0x1p-53}), 1 + 0x1p-51);
    EXPECT_EQ(sumOf({-1, -0x1p-53, -smallest}), -1 - 0x1p-52);
    EXPECT_EQ(sumOf({smallest, smallest}), 2 * smallest);
    EXPECT_EQ(sumOf({largest, largest, -largest}), largest) << "on the way it is more than any double";
    EXPECT_EQ(sumOf({largest, largest}), std::numeric_limits<double>::infinity());
    EXPECT_EQ(sumOf({1, -std::numeric_limits<double>::infinity()}), -std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(sumOf({1, std::numeric_limits<double>::quiet_NaN()})));
}

TEST(ExactSum, AgreesWithIntegers) {
    std::mt19937_64 random(7);
    std::vector<double> terms;
    std::int64_t expected = 0;
    for (int i = 0; i < 100000; ++i) {
        const auto term = static_cast<std::int64_t>(random()) >> (11 + random() % 50);
        expected += term >> 8;
        terms.push_back(std::ldexp(static_cast<double>(term >> 8), -20));
    }
    EXPECT_EQ(sumOf(terms), std::ldexp(static_cast<double>(expected), -20));
}

TEST(ExactSum, DependsNeitherOnTheOrderNorOnWhoAdds) {
    std::mt19937_64 random(11);
    std::vector<double> terms;
    for (int i = 0; i < 3000; ++i) {
        const double mantissa = std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -63);
        terms.push_back(std::ldexp(mantissa, static_cast<int>(random() % 200) - 100));
    }
    const double expected = sumOf(terms);
    for (int round = 0; round < 20; ++round) {
        std::shuffle(terms.begin(), terms.end(), random);
        ASSERT_EQ(sumOf(terms), expected);
        std::vector<ExactSum> parts(1 + random() % 7);
        for (const double term : terms) parts[random() % parts.size()].add(term);
        ExactSum sum;
        ExactSum sent;
        for (const ExactSum& part : parts) {
            sum.add(part);
            sent.add(part.digits());
        }
        ASSERT_EQ(sum.rounded(), expected);
        ASSERT_EQ(sent.rounded(), expected);
    }
}

TEST(ExactVectorSum, SumsEachAxis) {
    ExactVectorSum sum;
    sum.add(Vec3(1e300, 1, 0));
    ExactVectorSum other;
    other.add(Vec3(1, 2, smallest));
    other.add(Vec3(-1e300, 0, 0));
    sum.add(other);
    EXPECT_EQ(sum.rounded(), Vec3(1, 3, smallest));
}

}  // namespace
}  // namespace cairn
