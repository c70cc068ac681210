/// @file One step of Newton's method for all contacts of a batch that hold: their impulses at once instead of one by
/// one.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "resolution/block_cholesky.h"
#include "resolution/local_batch.h"
#include "resolution/pgs_contact.h"

namespace cairn {

/// Some of the bodies of a batch, by their local indices.
struct BodyRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// Sweeps pass on an impulse by one body a time, so a tower of n bodies needs of the order of n² of them. This step
/// takes the contacts that push and stick as welded (those that slide as welded along their normals) and solves for the
/// changes of all their impulses with a sparse factorization. Whether the contacts still push and stick afterwards is
/// for the next sweep to find out.
///
/// In stacks the contacts are redundant (four corners under a box). Each is therefore a little soft, by a part of its
/// own K; that picks the smallest change of the impulses, and as only changes are softened, nothing sinks.
class DirectStep {
  public:
    /// Computes the change of each contact's impulse [N·s, W]. @param moving which of the bodies can move
    /// @return false if there is nothing to solve or the factorization fails
    bool compute(std::span<const LocalBody> bodies, BodyRange moving, std::span<const PgsContact> pgs);
    std::span<const Vec3> changes() const { return changes_; }

  private:
    /// How a contact takes part.
    enum class Hold : std::uint8_t { none, normal, all };

    void assemble(std::span<const PgsContact> pgs);
    void solve(std::span<const PgsContact> pgs);
    /// What a contact's velocity lacks after motion_ is added [m/s, W].
    Vec3 missing(const PgsContact& contact, std::size_t i) const;
    bool moves(std::uint32_t body) const { return body >= moving_.begin && body < moving_.end; }
    /// Its place among those that move.
    std::uint32_t placeOf(std::uint32_t body) const { return body - moving_.begin; }

    std::span<const LocalBody> bodies_;
    BodyRange moving_;

    BlockCholesky matrix_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> couplings_;
    std::vector<Hold> holds_;        ///< [contacts]
    std::vector<double> stiffness_;  ///< [contacts] s of impulse = s·velocity [kg]
    std::vector<Mat6> inertia_;      ///< [bodies that move]
    std::vector<Vec6> force_;        ///< [bodies that move] right-hand side [N·s, N·m·s; W]
    std::vector<Vec6> motion_;       ///< [bodies that move] change of the velocities [m/s, rad/s; W]
    std::vector<Vec3> changes_;      ///< [contacts]
};

}  // namespace cairn
