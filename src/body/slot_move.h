/// @file What becomes of arrays with one entry per slot when slots come and go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cairn {

/// Stands for no slot.
inline constexpr std::uint32_t no_slot = UINT32_MAX;

/// Where each slot was and where it is. Slots keep their order.
struct SlotMove {
    std::vector<std::uint32_t> from;  ///< [slots now] slot before; no_slot = it is new
    std::vector<std::uint32_t> to;    ///< [slots before] slot now; no_slot = it is gone

    /// The slot now of one before. @param slot may be beyond all slots, as what is no body, and stays so then
    std::uint32_t operator()(std::uint32_t slot) const { return slot < to.size() ? to[slot] : slot; }
};

/// Brings the entries of an array to where their slots are now. Where it has none of the slots before, it gets none.
/// @param values may have fewer entries than there were slots @param blank for what had none
template <class Array>
void rearrange(Array& values, const SlotMove& move, const typename Array::value_type& blank) {
    if (values.empty() && !move.to.empty()) return;
    Array moved;
    moved.resize(move.from.size());
    for (std::size_t i = 0; i < move.from.size(); ++i) {
        moved[i] = move.from[i] < values.size() ? values[move.from[i]] : blank;
    }
    values = std::move(moved);
}

}  // namespace cairn
