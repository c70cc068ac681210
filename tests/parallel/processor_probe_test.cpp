#include "parallel/processor_probe.h"

#include <gtest/gtest.h>

#ifdef __linux__
#include <sched.h>
#endif

namespace cairn {
namespace {

using Clock = std::chrono::steady_clock;

/// Asks until there was time to find out, keeping the processor all the while. @return whether they were ever free
bool wereFree(ProcessorProbe& probe) {
    const Clock::time_point begin = Clock::now();
    bool free = false;
    while (Clock::now() - begin < std::chrono::milliseconds(100)) free = probe.areFree() || free;
    return free;
}

TEST(ProcessorProbe, KnowsNothingAtFirst) {
    ProcessorProbe probe(1);
    EXPECT_FALSE(probe.areFree());
}

TEST(ProcessorProbe, EndsWhileItIsAsking) {
    for (int i = 0; i < 20; ++i) EXPECT_FALSE(ProcessorProbe(3).areFree());
}

#ifdef __linux__
TEST(ProcessorProbe, SeesThatTheCallerIsOnTheOnlyProcessor) {
    cpu_set_t before;
    ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++i) {
        if (CPU_ISSET(i, &before)) CPU_SET(i, &one);
    }
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    // Where other programs are at work, too, the processor is at times the asking thread's all of the few milliseconds.
    constexpr int askings = 15;
    int free = 0;
    for (int i = 0; i < askings; ++i) {
        ProcessorProbe probe(1);
        free += wereFree(probe) ? 1 : 0;
    }
    sched_setaffinity(0, sizeof before, &before);
    EXPECT_LT(free, 2 * askings / 3);
}
#endif

}  // namespace
}  // namespace cairn
