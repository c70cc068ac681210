#include <gtest/gtest.h>

#include "broad_phase/hash_grids.h"
#include "broad_phase/scenes.h"
#include "counted_new.h"

namespace cairn {
namespace {

using namespace broad_phase_tests;

TEST(HashGridsMemory, AWarmStepAllocatesNothing) {
    Random random(31);
    Bodies bodies = allSizes(random, 3000, 0.01, Vec3::Zero());
    for (int i = 0; i < 4; ++i) bodies.add(Bounds{}, BodyKind::fixed);
    HashGrids grids;
    const Executor executor(1);
    std::vector<BodyPair> pairs;
    const std::size_t before_first = test::allocations;
    grids.findPairs(bodies.input(), executor, pairs);
    EXPECT_GT(test::allocations, before_first) << "the counter must work";
    grids.findPairs(bodies.input(), executor, pairs);
    const std::size_t before = test::allocations;
    grids.findPairs(bodies.input(), executor, pairs);
    EXPECT_EQ(test::allocations, before);
    EXPECT_GT(pairs.size(), 5000u);
}

}  // namespace
}  // namespace cairn
