#include "parallel/executor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace cairn {
namespace {

class ExecutorOnThreads : public testing::TestWithParam<int> {};

TEST_P(ExecutorOnThreads, BlocksCoverEveryItemOnceInAscendingOrder) {
    const Executor executor(GetParam());
    for (const std::size_t count : {0UL, 1UL, 63UL, 64UL, 1000UL}) {
        std::vector<int> visits(count);
        std::vector<std::size_t> begins(static_cast<std::size_t>(GetParam()));
        executor.forBlocks(
            count,
            [&](std::size_t begin, std::size_t end, int thread) {
                begins[static_cast<std::size_t>(thread)] = begin;
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            },
            8);
        EXPECT_TRUE(std::ranges::all_of(visits, [](int n) { return n == 1; }));
        if (count >= 64) {
            EXPECT_TRUE(std::ranges::is_sorted(begins));
        }
    }
}

TEST_P(ExecutorOnThreads, DynamicLoopVisitsEveryItemOnce) {
    const Executor executor(GetParam());
    std::vector<int> visits(500);
    executor.forEachDynamic(visits.size(), [&](std::size_t i, int thread) {
        ASSERT_GE(thread, 0);
        ASSERT_LT(thread, GetParam());
        ++visits[i];
    });
    EXPECT_TRUE(std::ranges::all_of(visits, [](int n) { return n == 1; }));
}

TEST_P(ExecutorOnThreads, ExceptionsOfWorkReachTheCaller) {
    const Executor executor(GetParam());
    EXPECT_THROW(
        executor.forBlocks(1000, [](std::size_t, std::size_t, int) { throw std::runtime_error("work failed"); }),
        std::runtime_error);
    EXPECT_THROW(executor.forEachDynamic(1000,
                                         [](std::size_t i, int) {
                                             if (i == 700) throw std::runtime_error("work failed");
                                         }),
                 std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(Threads, ExecutorOnThreads, testing::Values(1, 2, 3, 8));

}  // namespace
}  // namespace cairn
