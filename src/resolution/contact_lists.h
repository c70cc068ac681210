/// @file Which contacts a body has, within one batch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// A compressed table.
struct ContactLists {
    std::vector<std::uint32_t> begin;    ///< [bodies] offsets into contact
    std::vector<std::uint32_t> count;    ///< [bodies]
    std::vector<std::uint32_t> contact;  ///< by body, ascending; there may be room between two bodies

    std::size_t bodies() const { return count.size(); }
    std::span<const std::uint32_t> operator[](std::uint32_t body) const {
        return std::span(contact).subspan(begin[body], count[body]);
    }
};

}  // namespace cairn
