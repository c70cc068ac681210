/// @file Which level of the hierarchy each body belongs to, and how large the cells of each level are.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "broad_phase/broad_phase.h"

namespace cairn {

/// Chooses the levels anew in every step. Cell edges are β·2^k for integers k, one β ∈ [1, 2) for all levels, chosen so
/// that the cells fit the sizes that are frequent in the scene. A body belongs to the level with the smallest edge that
/// is at least the largest extent of its bounds.
///
/// Apart from the hierarchy are bodies whose bounds are infinite, not a number or turned inside out, and oversized
/// ones: those of levels (but for the finest) with so few bodies that testing them against everything is cheaper than
/// having everybody look for them.
class GridLevels {
  public:
    static constexpr std::int8_t apart = -1;
    static constexpr std::int8_t hole = -2;
    /// Bodies smaller than the finest of the coarsest 32 levels share that one; it bounds the cost per body.
    static constexpr std::size_t max_levels = 32;

    void choose(const BroadPhaseInput& input);

    std::size_t levels() const { return edge_inv_.size(); }
    /// Finest first. [1/m]
    double edgeInv(std::size_t level) const { return edge_inv_[level]; }
    /// Per slot: its level, `apart` or `hole`.
    std::span<const std::int8_t> ofBodies() const { return level_; }

  private:
    static constexpr std::size_t exponents = 2048;
    static constexpr std::size_t bins = 16;

    /// Sizes whose mantissa falls into the same sixteenth of an octave.
    struct Bin {
        std::uint32_t count = 0;
        std::uint64_t largest = 0;  ///< mantissa bits
    };

    void measure(const BroadPhaseInput& input);
    std::uint64_t bestMantissa() const;
    void pickLevels(std::uint64_t mantissa);

    std::vector<double> size_;                      ///< smallest edge a body needs [m]; infinite = apart, 0 = hole
    std::vector<std::int8_t> level_;                ///< per slot
    std::vector<double> edge_inv_;                  ///< per level [1/m]
    std::array<Bin, bins> bins_{};                  ///< of the mantissas of the sizes
    std::array<std::uint32_t, exponents> count_{};  ///< bodies per biased exponent of the edge
    std::array<std::int8_t, exponents> level_of_exponent_{};
};

}  // namespace cairn
