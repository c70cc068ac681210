/// @file What becomes of arrays with one entry per slot when slots come and go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "math/arrays.h"

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

/// Brings the entries of an array to where their slots are now, in its place where that leaves no large part of it
/// unused. Where it has none of the slots before, it gets none.
/// @param values may have fewer entries than there were slots @param blank for what had none @pre slots only come, or
/// only go
template <class Array>
void rearrange(Array& values, const SlotMove& move, const typename Array::value_type& blank) {
    const std::size_t before = values.size();
    const std::size_t now = move.from.size();
    if (before == 0 && !move.to.empty()) return;
    const auto take = [&](Array& to, std::size_t i) {
        to[i] = move.from[i] < before ? std::move(values[move.from[i]]) : blank;
    };
    if (now >= move.to.size()) {
        if constexpr (requires { values.capacity(); }) {
            resizeTightly(values, now);
        } else {
            values.resize(now);
        }
        // From behind, so that nothing is written over before its turn.
        for (std::size_t i = now; i-- > 0 && (move.from[i] != i || i >= before);) take(values, i);
    } else if (now > before / 2) {
        for (std::size_t i = 0; i < now; ++i) {
            if (move.from[i] != i || i >= before) take(values, i);
        }
        values.resize(now);
    } else {
        Array moved;
        moved.resize(now);
        for (std::size_t i = 0; i < now; ++i) take(moved, i);
        values = std::move(moved);
    }
}

}  // namespace cairn
