/// @file The contacts that a change of a body affects, with what is needed to update their δ.
/// A contact's list of affected contacts (thesis §3.8) is the list of its body A followed by that of B. Kept per body
/// it is built once per batch in linear time and memory, and one resolution reads two unbroken stretches of memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "resolution/contact_lists.h"
#include "resolution/impulse.h"
#include "resolution/local_batch.h"

namespace cairn {

/// ∂δ/∂(v, w) of one body at two contacts, one per lane, so that one instruction works on both:
/// δ = n·(vA − vB) + (rA × n)·ωA − (rB × n)·ωB. @source thesis (3.4.1), (3.4.2)
struct NormalRowPair {
    using Lanes = Eigen::Array2d;

    Lanes linear_x, linear_y, linear_z;     ///< n for A, −n for B
    Lanes angular_x, angular_y, angular_z;  ///< rA × n for A, −rB × n for B [m]
};

/// Compressed table of the rows of every dynamic body. Fixed bodies have none: nothing changes them. The rows of a body
/// are built when it changes first: in a batch that rests nearly all never do.
class NormalRows {
  public:
    /// @param batch must outlive the calls of update()
    void begin(const LocalBatch& batch);

    /// Contacts of a body, ascending.
    std::span<const std::uint32_t> contactsOf(std::uint32_t body) const { return lists_[body]; }
    const ContactLists& lists() const { return lists_; }

    /// δ += change by the new velocities of one body, for all its contacts; a NaN becomes +∞.
    /// @param delta [contacts + 1] the last entry belongs to no contact
    void update(std::uint32_t body, const VelocityChange& change, std::span<double> delta) {
        if (packed_[body] == 0) pack(body);
        const auto& [v, w] = change;
        update(body, v.x(), v.y(), v.z(), w.x(), w.y(), w.z(), delta.data());
    }

  private:
    /// Gets the change in registers: what was written one by one just now would be read in pairs here (triple.h).
    void update(std::uint32_t body, double v_x, double v_y, double v_z, double w_x, double w_y, double w_z,
                double* delta) const;
    void count();
    void pack(std::uint32_t body);

    const LocalBatch* batch_ = nullptr;
    /// Every list begins with a new pair; an odd one is filled up with "contact" contacts.size().
    ContactLists lists_;
    std::vector<NormalRowPair> pair_;   ///< [lists_.contact / 2] rows in the same order
    std::vector<std::uint8_t> packed_;  ///< [bodies] 1 = its rows are built
};

}  // namespace cairn
