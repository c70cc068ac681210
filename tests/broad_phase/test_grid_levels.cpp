#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "broad_phase/grid_levels.h"
#include "broad_phase/scenes.h"

namespace cairn {
namespace {

using broad_phase_tests::Bodies;
using broad_phase_tests::Random;

/// What the grids rely on: the cell of the upper corner is at most one behind that of the lower one, and coordinates
/// of cells are small enough for whole numbers of 64 bit and a precise fraction.
TEST(GridLevels, EveryBodyFitsItsCellAndEveryCoordinateItsNumber) {
    Random random(41);
    Bodies bodies;
    for (int i = 0; i < 20000; ++i) {
        const double far = random.logUniform(1e-9, 1e15);
        const double size = random.below(5) == 0 ? 0.0 : random.logUniform(1e-6, 1e3);
        bodies.add(random.inBox(far), 0.5 * size * Vec3(1, random.uniform(0, 1), random.uniform(0, 1)));
    }
    GridLevels levels;
    levels.choose(bodies.input());
    EXPECT_LE(levels.levels(), GridLevels::max_levels);
    int in_levels = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const std::int8_t level = levels.ofBodies()[i];
        if (level == GridLevels::apart) continue;
        ASSERT_GE(level, 0);
        ++in_levels;
        const double edge_inv = levels.edgeInv(static_cast<std::size_t>(level));
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            const double lower = bodies.bounds[i].lower[axis] * edge_inv;
            const double upper = bodies.bounds[i].upper[axis] * edge_inv;
            ASSERT_LE(std::abs(lower), 0x1p41);
            ASSERT_LE(std::floor(upper) - std::floor(lower), 1);
        }
    }
    EXPECT_GT(in_levels, 19000);
}

TEST(GridLevels, EdgesFitTheFrequentSizeAndArePowersOfTwoApart) {
    Bodies bodies;
    for (int i = 0; i < 1000; ++i) bodies.add(Vec3(i, 0, 0), Vec3::Constant(0.35));
    for (int i = 0; i < 20; ++i) bodies.add(Vec3(i, 0, 0), Vec3::Constant(0.9));
    for (int i = 0; i < 20; ++i) bodies.add(Vec3(i, 0, 0), Vec3::Constant(0.2));
    GridLevels levels;
    levels.choose(bodies.input());
    // 0.4 is more than half of 0.7, so it lies with the frequent ones; 1.8 is more than twice 0.7.
    ASSERT_EQ(levels.levels(), 2u);
    EXPECT_NEAR(1 / levels.edgeInv(0), 0.7, 0.002);
    EXPECT_EQ(levels.edgeInv(1), levels.edgeInv(0) / 4);
}

TEST(GridLevels, FewLargeBodiesInfiniteOnesAndHolesAreOutside) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    Bodies bodies;
    for (int i = 0; i < 100; ++i) bodies.add(Vec3(i, 0, 0), Vec3::Constant(0.5));
    bodies.add(Vec3::Zero(), Vec3::Constant(50));
    bodies.add(Bounds{Vec3::Zero(), Vec3(1, inf, 1)});
    bodies.add(Vec3::Zero(), Vec3::Ones(), BodyKind::hole);
    GridLevels levels;
    levels.choose(bodies.input());
    EXPECT_EQ(levels.levels(), 1u);
    EXPECT_EQ(levels.ofBodies()[0], 0);
    EXPECT_EQ(levels.ofBodies()[100], GridLevels::apart);
    EXPECT_EQ(levels.ofBodies()[101], GridLevels::apart);
    EXPECT_EQ(levels.ofBodies()[102], GridLevels::hole);
}

}  // namespace
}  // namespace cairn
