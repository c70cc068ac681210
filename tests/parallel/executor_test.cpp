#include "parallel/executor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
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

TEST_P(ExecutorOnThreads, ManyLoopsDoEveryShareOnce) {
    const Executor executor(GetParam());
    constexpr int loops = 3000;
    std::vector<int> visits(64);
    for (int loop = 0; loop < loops; ++loop) {
        executor.forBlocks(
            visits.size(),
            [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            },
            1);
        executor.forEachDynamic(visits.size() / 2, [&](std::size_t i, int) { ++visits[i]; });
    }
    for (std::size_t i = 0; i < visits.size(); ++i) EXPECT_EQ(visits[i], i < visits.size() / 2 ? 2 * loops : loops);
}

TEST_P(ExecutorOnThreads, LoopsWorkAgainAfterHelpersFellAsleep) {
    const Executor executor(GetParam());
    for (int round = 0; round < 3; ++round) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        std::vector<int> visits(100);
        executor.forBlocks(
            visits.size(),
            [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            },
            1);
        EXPECT_TRUE(std::ranges::all_of(visits, [](int n) { return n == 1; }));
    }
}

TEST_P(ExecutorOnThreads, MayEndAtAnyTime) {
    for (int round = 0; round < 50; ++round) {
        const Executor unused(GetParam());
        const Executor executor(GetParam());
        std::atomic<int> calls = 0;
        executor.forEachDynamic(4, [&](std::size_t, int) { ++calls; });
        EXPECT_EQ(calls, 4);
    }
}

TEST_P(ExecutorOnThreads, OfSeveralExceptionsTheLowestIsThrown) {
    const Executor executor(GetParam());
    for (int round = 0; round < 50; ++round) {
        try {
            executor.forBlocks(
                64, [](std::size_t begin, std::size_t, int) { throw static_cast<int>(begin); }, 1);
            FAIL() << "no exception";
        } catch (int begin) {
            EXPECT_EQ(begin, 0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Threads, ExecutorOnThreads, testing::Values(1, 2, 3, 8));

}  // namespace
}  // namespace cairn
