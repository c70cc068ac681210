#include "validate/validate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cairn/types.h"
#include "temporary_folder.h"

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
    "pulled-plate",
    "bouncing",
    "elastic-balls",
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
    EXPECT_FALSE(names.empty());
}

std::vector<std::string> namesIn(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::vector<std::string> names;
    const Json report = Json::parse(stream);
    for (const Json& c : report.at("cases")) names.push_back(c.at("name"));
    return names;
}

TEST(Validation, OfSingleCasesKeepsWhatIsStoredOfTheOthers) {
    const test::TemporaryFolder folder;
    ValidateOptions options;
    options.out = folder.path();
    options.extent = Extent::quick;
    options.only = {"slide-to-roll"};
    const ValidateOutcome first = runValidation(options);
    options.only = {"parabola"};
    const ValidateOutcome second = runValidation(options);
    EXPECT_EQ(second.cases, 1U);
    EXPECT_EQ(namesIn(second.json), (std::vector<std::string>{"parabola", "slide-to-roll"})) << "in the page's order";
    EXPECT_EQ(second.report.at("cases").at(1), first.report.at("cases").at(0));
    // Figures of another extent would not fit beside these.
    options.extent = Extent::full;
    EXPECT_EQ(namesIn(runValidation(options).json), std::vector<std::string>{"parabola"});
    std::ofstream(second.json) << "{}";
    EXPECT_THROW(runValidation(options), IoError);
}

std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Validation, WritesAnOverviewThatLeadsToAPageOfEachCase) {
    const test::TemporaryFolder folder;
    ValidateOptions options;
    options.out = folder.path();
    options.extent = Extent::quick;
    options.only = {"parabola", "slide-to-roll"};
    runValidation(options);
    const std::string overview = textOf(folder.path() / "validation.md");
    EXPECT_NE(overview.find("| [`parabola`](validation/parabola.md) | Free flight | "), std::string::npos) << overview;
    EXPECT_NE(overview.find("(validation/slide-to-roll.md)"), std::string::npos) << overview;
    const std::string page = textOf(folder.path() / "validation" / "parabola.md");
    EXPECT_TRUE(page.starts_with("# A thrown ball follows the parabola (`parabola`)\n\n")) << page;
    EXPECT_NE(page.find("| largest \\|Δx\\| / \\|x\\|, exact flight | Δt = 1/240 s | at most 1e-12 | "),
              std::string::npos)
        << page;
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "validation" / "slide-to-roll.md"));
}

TEST(Validation, JudgesStacksWithEverythingComputed) {
    ValidateOptions options;
    options.extent = Extent::quick;
    options.only = {"mass-ratios"};
    const ValidateOutcome outcome = runValidation(options);
    std::map<std::string, double> resolutions;
    for (const Json& q : outcome.report.at("cases").at(0).at("quantities")) {
        if (q.at("what") == "resolutions per step") resolutions[q.at("setup")] = q.at("measured");
    }
    EXPECT_GT(resolutions.at("ratio 1000, performance, Δt = 1/240 s, accelerated_sweeps"), 1);
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
    EXPECT_EQ(c.orderText(), "2.0");
}

TEST(Convergence, HasNoOrderWhereTheErrorIsRounding) {
    const Convergence c{"", "", {0.1, 0.01}, {1e-15, 1e-16}};
    EXPECT_FALSE(c.order());
    EXPECT_EQ(c.orderText(), "rounding");
}

}  // namespace
}  // namespace cairn::validation
