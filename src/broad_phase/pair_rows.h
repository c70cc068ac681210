/// @file Collecting pairs in any order and bringing them into ascending order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broad_phase/broad_phase.h"

namespace cairn {

/// The pairs one worker found, in any order. Keeps its memory between steps.
class PairBuffer {
  public:
    void clear() {
        size_ = 0;
        offered_ = 0;
    }
    std::span<const BodyPair> pairs() const { return std::span(storage_).first(size_); }

    /// Room for `count` more pairs behind those already kept; commit() says how many of them were written.
    BodyPair* reserve(std::size_t count) {
        offered_ += count;
        if (storage_.size() < size_ + count) grow(size_ + count);
        return storage_.data() + size_;
    }
    void commit(std::size_t count) { size_ += count; }
    /// For how many pairs there was room since clear(): the number of tests.
    std::uint64_t offered() const { return offered_; }

  private:
    void grow(std::size_t needed);

    std::vector<BodyPair> storage_;
    std::size_t size_ = 0;
    std::uint64_t offered_ = 0;
};

/// Sorts pairs by (a, b): a counting sort by a, then each row (the partners of one a) by b. Linear as long as rows are
/// short or arrive in order.
class PairRows {
  public:
    /// @param parts buffers whose pairs are taken in the given order @param slots all indices are below it
    /// @param pairs replaced @throws std::length_error beyond 2³² − 1 pairs
    void sort(std::span<const PairBuffer> parts, std::size_t slots, const Executor& executor,
              std::vector<BodyPair>& pairs);

  private:
    void count(std::span<const PairBuffer> parts, std::size_t slots, const Executor& executor);
    std::size_t placeRows(std::size_t parts, std::size_t slots);

    std::vector<std::vector<std::uint32_t>> cursor_;  ///< [parts][slots] pairs per row, later the next free place
    std::vector<std::uint32_t> row_begin_;            ///< [slots + 1] offsets into pairs
};

}  // namespace cairn
