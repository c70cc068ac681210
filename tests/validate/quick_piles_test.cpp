/// The quick piles of the suite, each by its bounds.
#include <gtest/gtest.h>

#include "validate/pile_suite.h"

namespace cairn::validation {
namespace {

class QuickPiles : public testing::TestWithParam<std::size_t> {};

TEST_P(QuickPiles, MeetTheirBounds) {
    const Pile pile = quickPiles().at(GetParam());
    const PileResult result = runPile(
        pile, [](Settings&) {}, [](const World&) {});
    EXPECT_TRUE(missedBy(pile, result).empty()) << lineOf(pile, result);
}

INSTANTIATE_TEST_SUITE_P(All, QuickPiles, testing::Range<std::size_t>(0, 24));

}  // namespace
}  // namespace cairn::validation
