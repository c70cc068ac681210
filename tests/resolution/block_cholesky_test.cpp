/// The sparse factorization against Eigen's dense one.
#include "resolution/block_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>

#include "resolution/batch_fixture.h"

namespace cairn {
namespace {

using Couplings = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Mat6 randomBlock(test::Random& random) {
    Mat6 block;
    for (Eigen::Index i = 0; i < 36; ++i) block(i / 6, i % 6) = random.uniform(-1, 1);
    return block;
}

/// The same matrix, sparse and dense.
struct Both {
    BlockCholesky sparse;
    Eigen::MatrixXd dense;

    Both(std::size_t size, const Couplings& couplings, std::uint64_t seed) {
        test::Random random(seed);
        const auto n = static_cast<Eigen::Index>(6 * size);
        dense = Eigen::MatrixXd::Zero(n, n);
        sparse.reset(size, couplings);
        for (std::uint32_t i = 0; i < size; ++i) {
            const Mat6 root = randomBlock(random);
            const Mat6 block = root * root.transpose() + 40 * Mat6::Identity();
            sparse.addDiagonal(i, block);
            dense.block<6, 6>(6 * i, 6 * i) += block;
        }
        for (const auto& [i, j] : couplings) {
            const Mat6 block = randomBlock(random);
            sparse.add(i, j, block);
            dense.block<6, 6>(6 * i, 6 * j) += block;
            dense.block<6, 6>(6 * j, 6 * i) += block.transpose();
        }
    }

    /// Largest difference of the two solutions, relative to the largest number of the dense one.
    double difference() {
        const std::size_t size = static_cast<std::size_t>(dense.rows()) / 6;
        test::Random random(99);
        std::vector<Vec6> x(size);
        Eigen::VectorXd right(dense.rows());
        for (std::size_t i = 0; i < size; ++i) {
            for (Eigen::Index k = 0; k < 6; ++k) x[i][k] = random.uniform(-1, 1);
            right.segment<6>(static_cast<Eigen::Index>(6 * i)) = x[i];
        }
        EXPECT_TRUE(sparse.factorize());
        sparse.solve(x);
        const Eigen::VectorXd expected = dense.llt().solve(right);
        double largest = 0;
        for (std::size_t i = 0; i < size; ++i) {
            largest =
                std::max(largest, (x[i] - expected.segment<6>(static_cast<Eigen::Index>(6 * i))).cwiseAbs().maxCoeff());
        }
        return largest / expected.cwiseAbs().maxCoeff();
    }
};

TEST(BlockCholesky, SolvesAChain) {
    Couplings couplings;
    for (std::uint32_t i = 0; i + 1 < 30; ++i) couplings.emplace_back(i, i + 1);
    EXPECT_LT(Both(30, couplings, 1).difference(), 1e-12);
}

TEST(BlockCholesky, SolvesARandomGraphWithFillIn) {
    test::Random random(5);
    Couplings couplings;
    for (int i = 0; i < 60; ++i) {
        const auto a = static_cast<std::uint32_t>(random.uniform(0, 40));
        const auto b = static_cast<std::uint32_t>(random.uniform(0, 40));
        if (a != b) couplings.emplace_back(a, b);
    }
    EXPECT_LT(Both(40, couplings, 2).difference(), 1e-12);
}

TEST(BlockCholesky, SolvesBodiesThatNothingCouples) {
    EXPECT_LT(Both(7, {}, 3).difference(), 1e-12);
}

TEST(BlockCholesky, EliminatesTheMiddleOfAStarLast) {
    constexpr std::uint32_t size = 200;
    Couplings star;
    for (std::uint32_t i = 1; i < size; ++i) star.emplace_back(0, i);
    BlockCholesky matrix;
    matrix.reset(size, star);
    EXPECT_EQ(matrix.blocks(), 2 * size - 1) << "nothing is filled in";
}

TEST(BlockCholesky, KeepsNothingOfTheLastMatrix) {
    Couplings ring;
    for (std::uint32_t i = 0; i < 20; ++i) ring.emplace_back(i, (i + 1) % 20);
    Both both(20, ring, 4);
    EXPECT_LT(both.difference(), 1e-12);
    both.sparse.reset(1, {});
    both.sparse.addDiagonal(0, 4 * Mat6::Identity());
    ASSERT_TRUE(both.sparse.factorize());
    std::vector<Vec6> x = {Vec6::Ones()};
    both.sparse.solve(x);
    EXPECT_EQ(x[0], 0.25 * Vec6::Ones());
}

TEST(BlockCholesky, RefusesWhatIsNotPositiveDefiniteOrNotFinite) {
    BlockCholesky matrix;
    matrix.reset(1, {});
    matrix.addDiagonal(0, -Mat6::Identity());
    EXPECT_FALSE(matrix.factorize());
    matrix.reset(1, {});
    matrix.addDiagonal(0, std::numeric_limits<double>::infinity() * Mat6::Identity());
    EXPECT_FALSE(matrix.factorize());
}

}  // namespace
}  // namespace cairn
