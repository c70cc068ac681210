#include "resolution/block_cholesky.h"

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <iterator>

namespace cairn {

void BlockCholesky::reset(std::size_t size, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    order(size, couplings);
    pattern_.resize(size);
    for (std::vector<std::uint32_t>& rows : pattern_) rows.clear();
    for (const auto& [i, j] : couplings) {
        const auto [column, row] = std::minmax(place_[i], place_[j]);
        pattern_[column].push_back(row);
    }
    findFill();
    begin_.resize(size + 1);
    rows_.clear();
    for (std::size_t column = 0; column < size; ++column) {
        begin_[column] = rows_.size();
        rows_.push_back(static_cast<std::uint32_t>(column));
        rows_.insert(rows_.end(), pattern_[column].begin(), pattern_[column].end());
    }
    begin_[size] = rows_.size();
    blocks_.assign(rows_.size(), Mat6::Zero());
    permuted_.resize(size);
}

void BlockCholesky::order(std::size_t size, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    const auto n = static_cast<Eigen::Index>(size);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(size + 2 * couplings.size());
    // Eigen leaves rows without a diagonal where they are.
    for (int i = 0; i < static_cast<int>(size); ++i) entries.emplace_back(i, i, 1);
    for (const auto& [i, j] : couplings) {
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j), 1);
        entries.emplace_back(static_cast<int>(j), static_cast<int>(i), 1);
    }
    Eigen::SparseMatrix<double> graph(n, n);
    graph.setFromTriplets(entries.begin(), entries.end());
    Eigen::AMDOrdering<int>::PermutationType permutation;
    Eigen::AMDOrdering<int>()(graph, permutation);
    place_.resize(size);
    // The permutation gives for every place the row that stands there.
    for (Eigen::Index k = 0; k < n; ++k) {
        place_[static_cast<std::size_t>(permutation.indices()[k])] = static_cast<std::uint32_t>(k);
    }
}

/// Eliminating a column couples all rows below its diagonal; it is enough to hand them on to the first of them.
void BlockCholesky::findFill() {
    for (std::vector<std::uint32_t>& rows : pattern_) {
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        if (rows.size() < 2) continue;
        std::vector<std::uint32_t>& parent = pattern_[rows.front()];
        parent.insert(parent.end(), rows.begin() + 1, rows.end());
    }
}

std::size_t BlockCholesky::find(std::uint32_t row, std::uint32_t column) const {
    const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(begin_[column]);
    const auto last = rows_.begin() + static_cast<std::ptrdiff_t>(begin_[column + 1]);
    return static_cast<std::size_t>(std::lower_bound(first, last, row) - rows_.begin());
}

void BlockCholesky::add(std::uint32_t i, std::uint32_t j, const Mat6& block) {
    if (place_[i] > place_[j]) {
        blocks_[find(place_[i], place_[j])] += block;
    } else {
        blocks_[find(place_[j], place_[i])] += block.transpose();
    }
}

bool BlockCholesky::factorize() {
    const std::size_t size = place_.size();
    for (std::size_t column = 0; column < size; ++column) {
        const std::size_t begin = begin_[column];
        const std::size_t end = begin_[column + 1];
        const Eigen::LLT<Mat6> diagonal(blocks_[begin]);
        if (diagonal.info() != Eigen::Success || !blocks_[begin].allFinite()) return false;
        blocks_[begin] = diagonal.matrixL();
        const auto lower = blocks_[begin].triangularView<Eigen::Lower>();
        for (std::size_t i = begin + 1; i < end; ++i) {
            Mat6 transposed = blocks_[i].transpose();
            lower.solveInPlace(transposed);
            blocks_[i] = transposed.transpose();
        }
        for (std::size_t j = begin + 1; j < end; ++j) {
            // The rows from j on are all among those of column rows_[j], in the same order.
            std::size_t target = begin_[rows_[j]];
            for (std::size_t i = j; i < end; ++i) {
                while (rows_[target] != rows_[i]) ++target;
                blocks_[target].noalias() -= blocks_[i].lazyProduct(blocks_[j].transpose());
            }
        }
    }
    return true;
}

void BlockCholesky::solve(std::span<Vec6> x) {
    const std::size_t size = place_.size();
    for (std::size_t i = 0; i < size; ++i) permuted_[place_[i]] = x[i];
    for (std::size_t column = 0; column < size; ++column) {
        const std::size_t begin = begin_[column];
        blocks_[begin].triangularView<Eigen::Lower>().solveInPlace(permuted_[column]);
        for (std::size_t i = begin + 1; i < begin_[column + 1]; ++i) {
            permuted_[rows_[i]].noalias() -= blocks_[i] * permuted_[column];
        }
    }
    for (std::size_t column = size; column-- > 0;) {
        const std::size_t begin = begin_[column];
        for (std::size_t i = begin + 1; i < begin_[column + 1]; ++i) {
            permuted_[column].noalias() -= blocks_[i].transpose() * permuted_[rows_[i]];
        }
        blocks_[begin].triangularView<Eigen::Lower>().transpose().solveInPlace(permuted_[column]);
    }
    for (std::size_t i = 0; i < size; ++i) x[i] = permuted_[place_[i]];
}

}  // namespace cairn
