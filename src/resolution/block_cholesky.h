/// @file Sparse Cholesky factorization of symmetric positive definite matrices made of 6×6 blocks, one row of blocks
/// per rigid body. Fill-in is kept small by Eigen's approximate minimum degree ordering.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "math/six.h"

namespace cairn {

/// A = L·Lᵀ. Keeps its memory between matrices.
class BlockCholesky {
  public:
    /// Makes room for a matrix and its factor and sets it to zero.
    /// @param size number of rows of blocks
    /// @param couplings (i, j), i ≠ j, of the blocks off the diagonal that are not zero, one of each symmetric two; may
    ///        hold repeated entries
    void reset(std::size_t size, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings);
    /// A(i, i) += block
    void addDiagonal(std::uint32_t i, const Mat6& block) { blocks_[begin_[place_[i]]] += block; }
    /// A(i, j) += block and A(j, i) += blockᵀ. @pre (i, j) or (j, i) is among the couplings
    void add(std::uint32_t i, std::uint32_t j, const Mat6& block);
    /// @return false if the matrix is not positive definite (or not finite)
    bool factorize();
    /// x := A⁻¹·x. @param x [size]
    void solve(std::span<Vec6> x);
    /// Blocks of the factor.
    std::size_t blocks() const { return rows_.size(); }

  private:
    void order(std::size_t size, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings);
    void findFill();
    std::size_t find(std::uint32_t row, std::uint32_t column) const;

    std::vector<std::uint32_t> place_;                 ///< [size] where a row of A stands in the factor
    std::vector<std::vector<std::uint32_t>> pattern_;  ///< [size] rows below the diagonal, ascending
    std::vector<std::size_t> begin_;                   ///< [size + 1] first block (the diagonal's) of each column
    std::vector<std::uint32_t> rows_;                  ///< [blocks]
    std::vector<Mat6, Eigen::aligned_allocator<Mat6>> blocks_;  ///< by column
    std::vector<Vec6> permuted_;                                ///< [size]
};

}  // namespace cairn
