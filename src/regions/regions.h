/// @file Which rank a place belongs to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/ranks.h"
#include "cairn/types.h"

namespace cairn {

/// All space, cut into one region per rank by planes across the axes, such that each has about as many of some places.
class Regions {
  public:
    /// @param places where bodies are [m, W], finite; the same on all ranks, and so are the regions
    /// @pre requirePartition() does not throw
    Regions(const Partition& partition, int ranks, std::vector<Vec3> places);
    /// The rank of a place, 0 to ranks − 1.
    int ownerOf(const Vec3& place) const;

  private:
    /// A cut, or a region of a rank.
    struct Node {
        int axis = -1;           ///< that the plane cuts; −1 = a region
        double plane = 0;        ///< places below it are in the next node [m]
        std::size_t second = 0;  ///< node of the others
        int rank = 0;            ///< of a region
    };

    void cut(const Partition& partition, std::span<Vec3> places, int first, int ranks);

    std::vector<Node> nodes_;  ///< each before those that it is cut into
};

/// @throws InputError if a grid has another number of parts than there are ranks
void requirePartition(const Partition& partition, int ranks);

}  // namespace cairn
