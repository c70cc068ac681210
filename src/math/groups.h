/// @file Which of many things hang together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace cairn {

/// Groups of numbers that are joined one pair after the other; a group is named by its lowest member.
class Groups {
  public:
    explicit Groups(std::size_t count = 0) { grow(count); }

    /// New numbers are joined to none.
    void grow(std::size_t count) {
        const std::size_t before = parent_.size();
        if (count <= before) return;
        parent_.resize(count);
        std::iota(parent_.begin() + static_cast<std::ptrdiff_t>(before), parent_.end(),
                  static_cast<std::uint32_t>(before));
    }
    /// Parts one from its group. @pre all others of the group are parted, too, before the next find() or join()
    void part(std::uint32_t i) { parent_[i] = i; }

    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace cairn
