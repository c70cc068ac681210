#include <gtest/gtest.h>

#include "broad_phase/block_table.h"
#include "broad_phase/neighbourhood.h"
#include "broad_phase/scenes.h"

namespace cairn {
namespace {

using broad_phase_tests::Random;

TEST(BlockTable, NumbersBlocksInOrderAndFindsThemWhileItGrows) {
    BlockTable table;
    for (int round = 0; round < 2; ++round) {
        table.reset();
        Random random(1);
        std::vector<BlockKey> keys;
        for (std::uint32_t i = 0; i < 5000; ++i) {
            const auto coordinate = [&] { return static_cast<std::int64_t>(random.bits()) >> (round == 0 ? 40 : 2); };
            keys.push_back({coordinate(), coordinate(), coordinate(), static_cast<std::int64_t>(i % 32)});
            ASSERT_EQ(table.enter(keys.back()), i);
        }
        for (std::uint32_t i = 0; i < 5000; ++i) {
            ASSERT_EQ(table.enter(keys[i]), i);
            ASSERT_EQ(table.find(keys[i]), &table.blocks()[i]);
            keys[i].level += 32;
            ASSERT_EQ(table.find(keys[i]), nullptr);
        }
    }
}

TEST(BlockTable, KeepsBlocksOfEqualHashApart) {
    // The hash multiplies x and y by these numbers and adds: swapping them in the coordinates cancels modulo 2⁶⁴.
    const auto x = static_cast<std::int64_t>(0xc2b2ae3d27d4eb4fu);
    const auto y = static_cast<std::int64_t>(0x9e3779b97f4a7c15u);
    std::vector<BlockKey> keys;
    for (std::int64_t i = 0; i < 100; ++i) {
        // Unsigned products, since they are meant to overflow.
        keys.push_back({static_cast<std::int64_t>(static_cast<std::uint64_t>(x) * static_cast<std::uint64_t>(i)),
                        static_cast<std::int64_t>(static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(-i)), 7,
                        1});
        ASSERT_EQ(keys.back().hash(), keys.front().hash());
    }
    BlockTable table;
    table.reset();
    for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(table.enter(keys[i]), i);
    for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(table.find(keys[i]), &table.blocks()[i]);
}

TEST(Block, NumbersItsCellsByPosition) {
    Block block;
    block.first_cell = 10;
    for (const unsigned position : {0u, 5u, 31u, 32u, 63u}) block.occupied |= std::uint64_t{1} << position;
    EXPECT_EQ(block.cell(0), 10u);
    EXPECT_EQ(block.cell(5), 11u);
    EXPECT_EQ(block.cell(31), 12u);
    EXPECT_EQ(block.cell(32), 13u);
    EXPECT_EQ(block.cell(63), 14u);
    EXPECT_TRUE(block.has(63));
    EXPECT_FALSE(block.has(62));
}

TEST(Neighbourhood, HasEachPairOfNeighbouringCellsOnce) {
    // Absolute coordinates of cells around block (0, 0, 0).
    const auto coordinates = [](int block, int position) {
        return Eigen::Vector3i(4 * (block % 3 - 1) + position % 4, 4 * (block / 3 % 3 - 1) + position / 4 % 4,
                               4 * (block / 9 - 1) + position / 16);
    };
    for (int position = 0; position < 64; ++position) {
        const Eigen::Vector3i own = coordinates(own_block, position);
        std::vector<std::array<int, 3>> steps;
        for (const RelativeCell& cell : half_neighbourhood[static_cast<std::size_t>(position)]) {
            const Eigen::Vector3i step = coordinates(cell.block, cell.position) - own;
            EXPECT_EQ(step.cwiseAbs().maxCoeff(), 1);
            steps.push_back({step.x(), step.y(), step.z()});
            steps.push_back({-step.x(), -step.y(), -step.z()});
            EXPECT_NE(needed_blocks[static_cast<std::size_t>(position)] >> cell.block & 1u, 0u);
        }
        std::sort(steps.begin(), steps.end());
        EXPECT_EQ(std::unique(steps.begin(), steps.end()) - steps.begin(), 26);
    }
}

TEST(Neighbourhood, PositionsInARange) {
    EXPECT_EQ(positionsIn({-5, 9}, {0, 3}, {-1, 3}), ~std::uint64_t{0});
    EXPECT_EQ(positionsIn({1, 2}, {0, 0}, {0, 0}), 0b0110u);
    EXPECT_EQ(positionsIn({3, 7}, {-2, 0}, {2, 2}), std::uint64_t{1} << 35);
    EXPECT_EQ(positionsIn({4, 6}, {0, 3}, {0, 3}), 0u);
    EXPECT_EQ(positionsIn({0, 0}, {1, 1}, {0, 3}), 0x0010001000100010u);
}

}  // namespace
}  // namespace cairn
