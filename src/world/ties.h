/// @file The springs and joints of each body, so that who removes a body need not ask all of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "integration/springs.h"
#include "joints/joint.h"

namespace cairn {

/// Slots of springs and joints by body, listed when they are asked for first. Lists stay while springs and joints
/// only go, and may then name some that are gone.
class TiesOfBodies {
  public:
    /// To be called where springs or joints come.
    void forget() { known_ = false; }
    /// @param slots of the bodies
    void list(std::span<const Spring> springs, std::span<const Joint> joints, std::size_t slots);

    /// @pre list() was called since forget(), with more slots than i
    std::span<const std::uint32_t> springsOf(BodyIndex i) const { return springs_[i]; }
    /// @pre as springsOf()
    std::span<const std::uint32_t> jointsOf(BodyIndex i) const { return joints_[i]; }

  private:
    /// Slots of one kind, grouped by body.
    struct Lists {
        std::vector<std::uint32_t> begin;  ///< [slots + 1] offsets into ties
        std::vector<std::uint32_t> ties;

        std::span<const std::uint32_t> operator[](BodyIndex i) const {
            if (i + 1 >= begin.size()) return {};
            return std::span(ties).subspan(begin[i], begin[i + 1] - begin[i]);
        }
    };

    template <class Tie>
    static void fill(std::span<const Tie> ties, std::size_t slots, Lists& lists);

    bool known_ = false;
    Lists springs_;
    Lists joints_;
};

}  // namespace cairn
