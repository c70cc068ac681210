#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "broad_phase/scenes.h"

namespace {

std::atomic<std::size_t> allocations{0};  // counted by the operators below, which replace those of the whole program

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
    ++allocations;
    if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace cairn {
namespace {

using namespace broad_phase_tests;

TEST(HashGridsMemory, AWarmStepAllocatesNothing) {
    Random random(31);
    Bodies bodies = allSizes(random, 3000, 0.01, Vec3::Zero());
    for (int i = 0; i < 4; ++i) bodies.add(Bounds{}, BodyKind::fixed);
    const auto grids = makeBroadPhase(BroadPhaseKind::hash_grids);
    const Executor executor(1);
    std::vector<BodyPair> pairs;
    const std::size_t before_first = allocations;
    grids->findPairs(bodies.input(), executor, pairs);
    EXPECT_GT(allocations, before_first) << "the counter must work";
    grids->findPairs(bodies.input(), executor, pairs);
    const std::size_t before = allocations;
    grids->findPairs(bodies.input(), executor, pairs);
    EXPECT_EQ(allocations, before);
    EXPECT_GT(pairs.size(), 5000u);
}

}  // namespace
}  // namespace cairn
