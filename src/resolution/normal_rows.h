/// @file The contacts that a change of a body affects, with what is needed to update their δ.
/// A contact's list of affected contacts (thesis §3.8) is the list of its body A followed by that of B. Kept per body
/// it is built once per batch in linear time and memory, and one resolution reads two unbroken stretches of memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "resolution/impulse.h"
#include "resolution/local_batch.h"

namespace cairn {

/// ∂δ/∂(v, w) of one body at one contact: δ = n·(vA − vB) + (rA × n)·ωA − (rB × n)·ωB. @source thesis (3.4.1), (3.4.2)
struct NormalRow {
    Vec3 linear;   ///< n for A, −n for B
    Vec3 angular;  ///< rA × n for A, −rB × n for B [m]

    double changeOf(const VelocityChange& change) const { return linear.dot(change.v) + angular.dot(change.w); }
};

/// Compressed table of the rows of every dynamic body. Fixed bodies have none: nothing changes them.
class NormalRows {
  public:
    void build(const LocalBatch& batch);

    /// Contacts of a body, ascending.
    std::span<const std::uint32_t> contactsOf(std::uint32_t body) const { return slice(contact_, body); }
    /// Their rows, in the same order.
    std::span<const NormalRow> rowsOf(std::uint32_t body) const { return slice(row_, body); }

  private:
    template <class T>
    std::span<const T> slice(const std::vector<T>& values, std::uint32_t body) const {
        return std::span(values).subspan(begin_[body], begin_[body + 1] - begin_[body]);
    }

    std::vector<std::uint32_t> begin_;    ///< [bodies + 1] offsets
    std::vector<std::uint32_t> contact_;  ///< [Σ contacts of bodies]
    std::vector<NormalRow> row_;          ///< [Σ contacts of bodies]
};

}  // namespace cairn
