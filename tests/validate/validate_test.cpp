#include "validate/validate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cairn/types.h"

namespace cairn::validation {
namespace {

/// The cases whose quick form must meet every target; the others are too long for a test or are known to miss some.
const std::vector<std::string> required = {
    "parabola",
    "tumbling-box",
    "dzhanibekov",
    "symmetric-top",
    "incline-threshold",
    "incline-slide",
    "incline-creep",
    "static-over-kinetic",
    "slide-to-roll",
    "rolling-down",
    "bouncing",
    "oblique-impact",
    "cue-ball",
    "cradle",
    "tipping",
    "overhang",
    "seesaw",
    "catapult",
    "towers",
    "mass-ratios",
    "cube-toss",
};

class RequiredCase : public testing::TestWithParam<std::string> {};

TEST_P(RequiredCase, MeetsAllItsTargets) {
    ValidateOptions options;
    options.only = {GetParam()};
    options.extent = Extent::quick;
    const ValidateOutcome outcome = runValidation(options);
    EXPECT_EQ(outcome.cases, 1U);
    for (const std::string& missed : outcome.missed) ADD_FAILURE() << missed;
}

INSTANTIATE_TEST_SUITE_P(Validation, RequiredCase, testing::ValuesIn(required), [](const auto& one) {
    std::string name = one.param;
    std::erase(name, '-');
    return name;
});

TEST(Validation, RefusesAnUnknownCaseAndNamesTheKnownOnes) {
    ValidateOptions options;
    options.only = {"perpetuum-mobile"};
    try {
        runValidation(options);
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("perpetuum-mobile"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("parabola"), std::string::npos);
    }
}

TEST(Validation, NamesEveryCaseOnce) {
    std::set<std::string_view> names;
    for (const Case& c : allCases()) EXPECT_TRUE(names.insert(c.name).second) << c.name;
}

TEST(Quantity, MissesItsTargetWhenTheErrorIsTooLargeOrNotANumber) {
    Quantity q{"speed", "m/s", Rule::relative, 2.0, 2.02, 0.011, "", ""};
    EXPECT_TRUE(q.passed());
    q.allowed = 0.009;
    EXPECT_FALSE(q.passed());
    q.measured = std::nan("");
    EXPECT_FALSE(q.passed());
    Quantity least{"time", "s", Rule::at_least, {}, 1.9, 2, "", ""};
    EXPECT_FALSE(least.passed());
    least.measured = 2;
    EXPECT_TRUE(least.passed());
}

TEST(Convergence, FindsTheOrderOfAnErrorThatFallsQuadratically) {
    const Convergence c{"", "", {0.1, 0.01}, {1e-2, 1e-4}};
    ASSERT_TRUE(c.order());
    EXPECT_NEAR(*c.order(), 2, 1e-12);
}

TEST(Convergence, HasNoOrderWhereTheErrorIsRounding) {
    EXPECT_FALSE((Convergence{"", "", {0.1, 0.01}, {1e-15, 1e-16}}.order()));
}

}  // namespace
}  // namespace cairn::validation
