/// @file Boxes that the bodies of ranks stay in for some time, so that most need not be compared with those of others.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "geometry/geometry.h"

namespace cairn {

/// Bounds around nothing.
inline Bounds emptyBounds() {
    constexpr double far = std::numeric_limits<double>::infinity();
    return {Vec3::Constant(far), Vec3::Constant(-far)};
}

/// Makes bounds large enough for others, too.
inline void include(Bounds& bounds, const Bounds& other) {
    bounds.lower = bounds.lower.cwiseMin(other.lower);
    bounds.upper = bounds.upper.cwiseMax(other.upper);
}

/// Where the bodies of a rank may be for some time.
struct Reach {
    Bounds box = emptyBounds();  ///< around all of them; empty if there are none [m, W]
    double beside = 0;           ///< how far the box goes into that of another rank which it overlaps anyway [m, ≥ 0]
};

/// One box per rank. As long as all that a body of a rank reaches is in the box of its rank and in that of no other, it
/// cannot meet bodies of other ranks for which the same is true.
class Realms {
  public:
    /// Boxes of which nothing is known: no place is free.
    Realms() = default;
    /// @param reach of each rank, the same on all of them @param own this rank
    /// @param ahead how much farther the boxes go where no other rank is [m, ≥ 0]
    Realms(std::span<const Reach> reach, std::size_t own, double ahead);

    /// Whether a place is in the box of this rank and in no other.
    bool isFree(const Bounds& place) const;
    /// Whether a place is in the box of another rank, too.
    bool reachesOthers(const Bounds& place) const;
    /// A part of what is free, as large as is easily found: places within it are free. [m, W]
    const Bounds& core() const { return core_; }
    /// The boxes [ranks, m, W].
    std::span<const Bounds> all() const { return all_; }

  private:
    std::vector<Bounds> all_;
    std::vector<Bounds> beside_;  ///< those of other ranks that overlap that of this one
    Bounds own_ = emptyBounds();
    Bounds core_ = emptyBounds();
};

}  // namespace cairn
