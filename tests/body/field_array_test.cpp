/// Views of a field's block stay valid when the array grows or goes.
#include "body/field_array.h"

#include <gtest/gtest.h>

#include <string>

namespace cairn {
namespace {

TEST(FieldArray, AViewSeesTheArrayUntilItGrowsAndStaysValidAfterwards) {
    std::shared_ptr<const double[]> view;
    {
        FieldArray<double> array;
        array.assign(8, 1.5);
        view = array.share();
        array[3] = 2;
        EXPECT_EQ(view[3], 2) << "no copy was made";
        array.resize(9);
        EXPECT_EQ(view.get(), array.data()) << "the block had room for one more";
        array.resize(1000);
        ASSERT_NE(view.get(), array.data());
        EXPECT_EQ(array[3], 2);
        EXPECT_EQ(array[999], 0);
        array[3] = 7;
    }
    EXPECT_EQ(view[3], 2);
    EXPECT_EQ(view[7], 1.5);
}

TEST(FieldArray, CopiesIntoItsOwnBlock) {
    FieldArray<std::string> from, to;
    from.assign(5, "a name that is too long for the string itself");
    to.assign(6, "");
    const auto view = to.share();
    to = from;
    EXPECT_EQ(view.get(), to.data());
    EXPECT_EQ(to, from);
    EXPECT_EQ(to.size(), 5U);
    from[0] = "other";
    EXPECT_NE(to, from);
    const FieldArray<std::string> moved = std::move(to);
    EXPECT_EQ(view.get(), moved.data());
}

}  // namespace
}  // namespace cairn
