/// @file Which parts of a compound another shape may touch.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/geometry.h"

namespace cairn {

/// Parts of a compound, ascending: all whose bounds another shape is near, and maybe more. Takes no memory.
class NearParts {
  public:
    /// @param compound, pose its frame in W @param other, other_pose what is near it @param bounds of that [W]
    NearParts(const Compound& compound, const Pose& pose, const Shape& other, const Pose& other_pose,
              const Bounds& bounds, double margin);

    std::size_t count() const { return count_; }
    std::size_t operator[](std::size_t i) const { return all_ ? i : parts_[i]; }

  private:
    static constexpr std::size_t most = 128;  ///< of more than these all parts are asked

    void add(std::uint32_t part);
    void findAt(const HalfSpace& ground, const Pose& ground_in_compound, const BoundsTree& tree, double margin);

    bool all_ = false;
    std::size_t count_ = 0;
    std::array<std::uint32_t, most> parts_;
};

}  // namespace cairn
