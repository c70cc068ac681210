#include "parallel/help_choice.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

/// Does something so often. @return how often with help
int helped(HelpChoice& choice, int times, double with_help, double alone, double growth = 1) {
    int count = 0;
    double scale = 1;
    for (int i = 0; i < times; ++i) {
        const bool help = choice.next();
        count += help ? 1 : 0;
        choice.record(scale * (help ? with_help : alone));
        scale *= growth;
    }
    return count;
}

TEST(HelpChoice, AsksForHelpThatHelpsAndSeldomTriesWithout) {
    HelpChoice choice;
    EXPECT_GE(helped(choice, 1000, 1, 1.8), 985);
}

TEST(HelpChoice, StopsAskingForHelpThatCosts) {
    HelpChoice choice;
    EXPECT_LE(helped(choice, 1000, 2, 1), 60);
    EXPECT_LE(helped(choice, 1000, 2, 1), 10);
}

TEST(HelpChoice, AsksAgainWhenHelpHelpsAgain) {
    HelpChoice choice;
    helped(choice, 1000, 2, 1);
    EXPECT_GE(helped(choice, 1000, 1, 2), 650);
    EXPECT_GE(helped(choice, 1000, 1, 2), 990);
}

TEST(HelpChoice, IsNotMisledByWorkThatGrowsOrShrinks) {
    HelpChoice growing;
    EXPECT_GE(helped(growing, 1000, 1, 1.8, 1.01), 950);
    HelpChoice shrinking;
    EXPECT_GE(helped(shrinking, 1000, 1, 1.8, 0.99), 950);
}

TEST(HelpChoice, LeavesWhatMakesNoDifferenceAsItIs) {
    HelpChoice choice;
    EXPECT_GE(helped(choice, 1000, 1, 0.95), 850);
}

TEST(HelpChoice, TakesTimesThatAreZero) {
    HelpChoice choice;
    EXPECT_GE(helped(choice, 100, 0, 0), 80);
}

}  // namespace
}  // namespace cairn
