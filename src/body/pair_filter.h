/// @file Groups of bodies that do not touch, and exceptions of single pairs.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "body/body_fields.h"
#include "body/slot_move.h"
#include "cairn/filter.h"

namespace cairn {

/// An exception of one pair of bodies.
struct PairException {
    BodyIndex a, b;  ///< a < b
    Touch touch;
};

/// Decides which bodies may touch. A body may be in several groups: it touches another unless one of its groups never
/// touches one of the other's. A body in no group touches all.
class PairFilter {
  public:
    /// @throws InputError for an empty or used name, or beyond most_groups
    GroupId addGroup(const std::string& name);
    std::span<const std::string> groups() const { return names_; }
    /// @throws InputError for an unknown group
    void setGroups(GroupId a, GroupId b, Touch touch);
    /// @throws InputError as above
    Touch ofGroups(GroupId a, GroupId b) const;
    /// The groups as the bits of a number. @throws InputError as above
    std::uint64_t maskOf(std::span<const GroupId> groups) const;

    /// None = as their groups say.
    void setPair(BodyIndex a, BodyIndex b, std::optional<Touch> touch);
    std::optional<Touch> ofPair(BodyIndex a, BodyIndex b) const;
    /// Takes back the exceptions of a body that leaves its slot.
    void forget(BodyIndex body);
    /// Lets exceptions name the slots that bodies have now. @pre none of their slots is gone
    void rename(const SlotMove& move);
    std::span<const PairException> exceptions() const { return exceptions_; }

    /// @param groups_a, groups_b of the bodies, as bits
    bool keepsApart(BodyIndex a, BodyIndex b, std::uint64_t groups_a, std::uint64_t groups_b) const {
        if (!exceptions_.empty()) {
            if (const std::optional<Touch> own = ofPair(a, b)) return *own == Touch::never;
        }
        for (std::uint64_t left = groups_b != 0 ? groups_a : 0; left != 0; left &= left - 1) {
            if ((apart_[static_cast<std::size_t>(std::countr_zero(left))] & groups_b) != 0) return true;
        }
        return false;
    }

  private:
    std::size_t indexOf(GroupId group) const;

    std::vector<std::string> names_;
    std::array<std::uint64_t, most_groups> apart_{};  ///< [group] bits of the groups that it never touches; symmetric
    std::vector<PairException> exceptions_;           ///< by (a, b)
};

}  // namespace cairn
